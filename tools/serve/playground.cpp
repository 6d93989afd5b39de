#include "tools/serve/playground.hpp"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "core/netlist/characters.hpp"
#include "tools/rheonet/interrupt.hpp"
#include "tools/rheonet/library.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/serve/api.hpp"
#include "tools/web/assets.hpp"

extern char** environ;

namespace rheonet::serve {
namespace {

namespace fs = std::filesystem;
using namespace rheonet::tool;
using namespace std::chrono_literals;

/// Each connection takes a descriptor, each run two.
void allow_many_files() {
  rlimit most{};
  if (::getrlimit(RLIMIT_NOFILE, &most) != 0) return;
  most.rlim_cur = std::min<rlim_t>(most.rlim_max, 1u << 14);
  ::setrlimit(RLIMIT_NOFILE, &most);
}

void open_in_browser(std::string address) {
  char name[] = "xdg-open";
  char* const words[] = {name, address.data(), nullptr};
  pid_t process = 0;
  if (::posix_spawnp(&process, name, nullptr, nullptr, words, environ) != 0)
    say("note: there is no `xdg-open` to open the page with; open it by hand\n");
}

std::string address_of(const std::string& host, int port) {
  return fmt::format("http://{}:{}/", host.find(':') != std::string::npos ? "[" + host + "]" : host, port);
}

ExitStatus listen(const ServeArguments& wanted, Folder& folder) {
  allow_many_files();
  const Limits limits{wanted.seconds, wanted.megabytes};
  Pool pool(limits, std::max(2u, std::thread::hardware_concurrency()));
  Server server;
  Api api(folder, pool);
  api.attach(server, wanted.host);
  const int port = server.bind(wanted.host, wanted.port);
  if (port < 0) {
    say("error: cannot listen at {}: {}\n", address_of(wanted.host, wanted.port),
        wanted.port == 0 ? "the address is not this machine's\n  without `--host` it is this machine's own alone, 127.0.0.1"
                         : "the address is not this machine's, or the port is in use\n  `--port 0` takes any that is free");
    return not_simulated;
  }
  const std::atomic<bool>& interrupted = end_on_signals();
  // A server that does not listen yet takes no notice of being stopped.
  std::atomic<bool> ended = false;
  std::thread ending([&] {
    while (!ended && !(interrupted && server.is_running())) std::this_thread::sleep_for(50ms);
    server.stop();
  });
  fmt::print("{} (Ctrl-C ends it): the netlists of {}\n", address_of(wanted.host, port), printable(folder.path().string()));
  std::fflush(stdout);
  if (wanted.open) open_in_browser(address_of(wanted.host, port));
  const bool listened = server.listen_after_bind();
  ended = true;
  ending.join();
  return listened ? done : not_simulated;
}

}  // namespace

ExitStatus play(const ServeArguments& wanted) {
  if (wanted.worker) std::_Exit(work({wanted.seconds, wanted.megabytes}));
  if (!web::are_built()) {
    say("error: `serve` cannot begin: {}\n", web::why_not_built());
    return not_simulated;
  }
  const bool own = !wanted.folder.empty();
  const std::vector<fs::path> library = library_folders();
  if (!own && library.empty()) {
    say("error: the netlists that come with rheonet are not there\n  name a folder: `rheonet serve FOLDER`\n");
    return wrong_input;
  }
  try {
    Folder folder(own ? fs::path(wanted.folder) : library.front(), own);
    return listen(wanted, folder);
  } catch (const fs::filesystem_error& error) {
    say("error: cannot serve `{}`: {}\n", printable(wanted.folder), error.code().message());
    return wrong_input;
  }
}

}  // namespace rheonet::serve
