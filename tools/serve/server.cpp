#include "tools/serve/server.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <functional>
#include <thread>

#include "tools/serve/connection.hpp"

namespace rheonet::serve {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t threads = 400;   // Largest number of connections served at a time.
constexpr int most_waiting = 512;      // Largest number of accepted connections that wait for a thread, and of pending ones.
constexpr auto idle = 100ms;           // Interval at which an idle thread checks whether the server ends.
constexpr int idle_times = 50;         // Intervals that a connection may be idle if no other connection waits.
constexpr int first_times = 10;        // The same before its first request while others wait: a busy client connects long before it writes.
constexpr auto request_time = 10s;     // Time in which a request must arrive.
constexpr auto hurried_time = 1s;      // The same while other connections wait.
constexpr int most_requests = 1000;    // Largest number of requests on one connection.

thread_local bool ends = false;

/// Thread pool for the connections. While too many connections wait for a thread, no more are accepted.
class Crew final : public httplib::ThreadPool {
 public:
  explicit Crew(std::atomic<int>& waiting) : ThreadPool(threads), waiting_(waiting) {}

  void enqueue(std::function<void()> serve) override {
    while (waiting_ >= most_waiting) std::this_thread::sleep_for(idle);
    ++waiting_;
    ThreadPool::enqueue([this, serve = std::move(serve)] {
      --waiting_;
      serve();
    });
  }

 private:
  std::atomic<int>& waiting_;
};

}  // namespace

Server::Server() {
  new_task_queue = [this] { return new Crew(waiting_); };
  // Do not share a port with another server.
  set_socket_options([](int socket) {
    const int on = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  });
}

int Server::bind(const std::string& host, int port) {
  const int bound = port == 0 ? bind_to_any_port(host) : bind_to_port(host, port) ? port : -1;
  // The library limits the backlog to five.
  if (bound > 0 && ::listen(svr_sock_, most_waiting) != 0) return -1;
  return bound;
}

void Server::end_connection() { ends = true; }

bool Server::process_and_close_socket(int socket) {
  const int on = 1;
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  Connection connection(socket);
  for (int k = 0; k < most_requests; ++k) {
    int waited = 0;
    const auto patience = [this, k] { return waiting_ == 0 ? idle_times : k == 0 ? first_times : 1; };
    while (svr_sock_ != INVALID_SOCKET && waited < patience() && !connection.wait_for_request(idle)) ++waited;
    if (svr_sock_ == INVALID_SOCKET || waited >= patience()) break;
    connection.begin_request(waiting_ > 0 ? hurried_time : request_time, most_bytes);
    bool closed = false;
    ends = false;
    // Ignore ranges: the library would send a range as often as a client repeats it.
    const auto whole = [](httplib::Request& request) { request.ranges.clear(); };
    if (!process_request(connection, k + 1 == most_requests, closed, whole) || closed || ends) break;
  }
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  return true;
}

}  // namespace rheonet::serve
