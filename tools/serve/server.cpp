#include "tools/serve/server.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <chrono>

#include "tools/serve/connection.hpp"

namespace rheonet::serve {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t threads = 400;   // as many connections at once
constexpr int waiting = 512;           // as many more
constexpr auto idle = 100ms;           // after which a thread looks whether the server is to end
constexpr int idle_times = 50;         // for so long a connection may stay open without a request
constexpr auto request_time = 10s;     // that a request may take to come
constexpr int most_requests = 1000;    // on one connection

thread_local bool ends = false;

}  // namespace

Server::Server() {
  new_task_queue = [] { return new httplib::ThreadPool(threads); };
  // A port that another server has is not shared with it.
  set_socket_options([](int socket) {
    const int on = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  });
}

int Server::bind(const std::string& host, int port) {
  const int bound = port == 0 ? bind_to_any_port(host) : bind_to_port(host, port) ? port : -1;
  // The library lets no more than five wait.
  if (bound > 0 && ::listen(svr_sock_, waiting) != 0) return -1;
  return bound;
}

void Server::end_connection() { ends = true; }

bool Server::process_and_close_socket(int socket) {
  const int on = 1;
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  Connection connection(socket);
  for (int k = 0; k < most_requests; ++k) {
    int waited = 0;
    while (svr_sock_ != INVALID_SOCKET && waited < idle_times && !connection.wait_for_request(idle)) ++waited;
    if (svr_sock_ == INVALID_SOCKET || waited == idle_times) break;
    connection.begin_request(request_time, most_bytes);
    bool closed = false;
    ends = false;
    if (!process_request(connection, k + 1 == most_requests, closed, nullptr) || closed || ends) break;
  }
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  return true;
}

}  // namespace rheonet::serve
