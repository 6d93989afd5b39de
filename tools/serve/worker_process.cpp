#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>
#include <thread>

#include "tools/rheonet/library.hpp"
#include "tools/serve/below.hpp"
#include "tools/serve/tasks.hpp"
#include "tools/serve/worker.hpp"

namespace rheonet::serve {
namespace {

void print_line(const std::string& message) {
  std::fwrite(message.data(), 1, message.size(), stdout);
  std::fputc('\n', stdout);
  std::fflush(stdout);
}

/// The sources of included files and tables: the served folder, which the server has opened, and the library.
const std::vector<const FileOffer*>& offers() {
  static const std::vector<const FileOffer*> all = [] {
    std::vector<const FileOffer*> made{new OfferedFolder(Descriptor(folder_descriptor))};
    for (const std::filesystem::path& library : tool::library_folders()) made.push_back(new OfferedFolder(library));
    return made;  // Never destroyed.
  }();
  return all;
}

void limit(int resource, rlim_t most) {
  const rlimit both{most, most};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/// The address space that this process uses so far [bytes].
rlim_t address_space() {
  std::ifstream pages("/proc/self/statm");
  rlim_t count = 0;
  pages >> count;
  return count * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

/// Ends the process when the server has ended, even during a task.
void end_with_the_server() {
  for (;;) {
    pollfd input{STDIN_FILENO, 0, 0};
    if (::poll(&input, 1, -1) > 0 && (input.revents & (POLLHUP | POLLERR)) != 0) ::_exit(0);
  }
}

}  // namespace

int work(const Limits& limits) {
  std::thread(end_with_the_server).detach();
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 0);
#ifndef __SANITIZE_ADDRESS__  // The sanitizer reserves the whole address space.
  limit(RLIMIT_AS, address_space() + static_cast<rlim_t>(limits.megabytes) * (1u << 20));
#endif
  for (std::string line; std::getline(std::cin, line);) {
    try {
      carry_out(nlohmann::json::parse(line), offers(), print_line);
    } catch (const std::bad_alloc&) {
      return out_of_memory;  // The server reports it.
    }
    print_line("");
  }
  return 0;
}

}  // namespace rheonet::serve
