#include "tools/serve/playground.hpp"

#include <fmt/format.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <spawn.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <thread>

#include "core/netlist/characters.hpp"
#include "tools/rheonet/interrupt.hpp"
#include "tools/rheonet/library.hpp"
#include "tools/rheonet/replacement.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/serve/api.hpp"
#include "tools/web/assets.hpp"

extern char** environ;

namespace rheonet::serve {
namespace {

namespace fs = std::filesystem;
using namespace rheonet::tool;
using namespace std::chrono_literals;

/// Raises the limit on open files: each connection takes a descriptor, each run two.
void allow_many_files() {
  rlimit most{};
  if (::getrlimit(RLIMIT_NOFILE, &most) != 0) return;
  most.rlim_cur = std::min<rlim_t>(most.rlim_max, 1u << 14);
  ::setrlimit(RLIMIT_NOFILE, &most);
}

/// A temporary page that redirects to an address. The browser is started with the name of this file, because all users can read the
/// arguments of a process, and the address contains the token.
class Signpost {
 public:
  explicit Signpost(const std::string& address) {
    const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
    std::error_code failed;
    const fs::path folder = runtime != nullptr && *runtime != '\0' ? fs::path(runtime) : fs::temp_directory_path(failed);
    std::string name = (folder / "rheonet-XXXXXX.html").string();
    const int file = ::mkstemps(name.data(), 5);  // Readable by its owner only.
    if (file < 0) return;
    path_ = name;
    if (tool::write_text(file, fmt::format("<!doctype html><meta charset=\"utf-8\"><meta http-equiv=\"refresh\" content=\"0;url={}\">\n",
                                           address)) != 0)
      say("note: the page that leads to the playground could not be written\n");
    ::close(file);
  }
  ~Signpost() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  Signpost(const Signpost&) = delete;
  Signpost& operator=(const Signpost&) = delete;

  void open() {
    char name[] = "xdg-open";
    char* const words[] = {name, path_.data(), nullptr};
    pid_t process = 0;
    if (path_.empty() || ::posix_spawnp(&process, name, nullptr, nullptr, words, environ) != 0)
      say("note: there is no `xdg-open` to open the page with; open it by hand\n");
  }

 private:
  std::string path_;
};

std::string address_of(const std::string& host, int port) {
  return fmt::format("http://{}:{}/", host.find(':') != std::string::npos ? "[" + host + "]" : host, port);
}

/// The network addresses of this machine.
std::vector<std::string> addresses_of_machine() {
  std::vector<std::string> found;
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return found;
  for (const ifaddrs* each = all; each != nullptr; each = each->ifa_next) {
    if (each->ifa_addr == nullptr || (each->ifa_flags & IFF_LOOPBACK) != 0 || (each->ifa_flags & IFF_UP) == 0) continue;
    char text[NI_MAXHOST] = "";
    const socklen_t size = each->ifa_addr->sa_family == AF_INET ? sizeof(sockaddr_in) : each->ifa_addr->sa_family == AF_INET6 ? sizeof(sockaddr_in6) : 0;
    if (size == 0 || ::getnameinfo(each->ifa_addr, size, text, sizeof text, nullptr, 0, NI_NUMERICHOST) != 0) continue;
    // An address with a zone (fe80::1%eth0) is valid on this machine only.
    if (std::string_view(text).find('%') == std::string_view::npos) found.emplace_back(text);
  }
  ::freeifaddrs(all);
  return found;
}

/// The hosts in the printed addresses. A wildcard address (0.0.0.0, ::) is replaced by the addresses of this machine.
std::vector<std::string> hosts_of(const std::string& host) {
  if (host != "0.0.0.0" && host != "::") return {host};
  std::vector<std::string> hosts{"127.0.0.1"};
  for (std::string& address : addresses_of_machine())
    if (host == "::" || address.find(':') == std::string::npos) hosts.push_back(std::move(address));
  return hosts;
}

/// The address of the page for other machines; "" if there is none.
std::string shared_address(const std::string& host, int port) {
  for (const std::string& each : hosts_of(host))
    if (!is_this_machine(each)) return address_of(each, port);
  return "";
}

/// Prints the addresses of the playground and who can reach it.
void announce(const ServeArguments& wanted, const Folder& folder, const Keys& keys, int port) {
  const std::vector<std::string> hosts = hosts_of(wanted.host);
  fmt::print("{}{} (Ctrl-C ends it): the netlists of {}\n", address_of(hosts.front(), port), keys.query(),
             printable(folder.path().string()));
  for (const std::string& host : hosts)
    if (!is_this_machine(host)) fmt::print("  from other machines, to type: {}{} (saves nothing here)\n", address_of(host, port), keys.short_path());
  std::fflush(stdout);
  if (!is_this_machine(wanted.host))
    say("warning: `--host {}` lets other machines in: whoever has an address can run scenes here{}, and who listens "
        "in the network can read them, for nothing is encrypted\n",
        printable(wanted.host), folder.may_be_written() ? ", who has the one with the token can change the netlists of the folder" : "");
}

ExitStatus listen(const ServeArguments& wanted, Folder& folder) {
  allow_many_files();
  const Limits limits{wanted.seconds, wanted.megabytes};
  Pool pool(limits, std::max(2u, std::thread::hardware_concurrency()), folder.descriptor());
  Server server;
  const int port = server.bind(wanted.host, wanted.port);
  if (port < 0) {
    say("error: cannot listen at {}: {}\n", address_of(wanted.host, wanted.port),
        wanted.port == 0 ? "the address is not this machine's\n  without `--host` it is this machine's own alone, 127.0.0.1"
                         : "the address is not this machine's, or the port is in use\n  `--port 0` takes any that is free");
    return not_simulated;
  }
  Keys keys(port, !wanted.framed_by.empty());
  Api api(folder, pool, keys);
  api.attach(server, wanted.host, shared_address(wanted.host, port), wanted.framed_by);
  const std::atomic<bool>& interrupted = end_on_signals(/*status_when_late=*/done);
  // A server that does not listen yet ignores `stop`.
  std::atomic<bool> ended = false;
  std::thread ending([&] {
    while (!ended && !(interrupted && server.is_running())) std::this_thread::sleep_for(50ms);
    server.stop();
  });
  announce(wanted, folder, keys, port);
  std::optional<Signpost> signpost;
  if (wanted.open) signpost.emplace(address_of(hosts_of(wanted.host).front(), port) + keys.query()).open();
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
