#include "tools/serve/connection.hpp"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace rheonet::serve {
namespace {

using namespace std::chrono_literals;

constexpr auto slowest_write = 5s;    // Longest time in which the client reads no byte.
constexpr auto longest_write = 120s;  // Longest time for one call of `write`.

int milliseconds_until(Connection::Clock::time_point until) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Connection::Clock::now());
  return static_cast<int>(std::max<std::chrono::milliseconds::rep>(left.count(), 0));
}

void address_of(const sockaddr_storage& address, std::string& ip, int& port) {
  char text[INET6_ADDRSTRLEN] = "";
  if (address.ss_family == AF_INET) {
    sockaddr_in four;
    std::memcpy(&four, &address, sizeof four);
    inet_ntop(AF_INET, &four.sin_addr, text, sizeof text);
    port = ntohs(four.sin_port);
  } else if (address.ss_family == AF_INET6) {
    sockaddr_in6 six;
    std::memcpy(&six, &address, sizeof six);
    inet_ntop(AF_INET6, &six.sin6_addr, text, sizeof text);
    port = ntohs(six.sin6_port);
  }
  ip = text;
}

}  // namespace

bool Connection::wait(short event, Clock::time_point until) const {
  for (;;) {
    pollfd item{socket_, event, 0};
    const int ready = ::poll(&item, 1, milliseconds_until(until));
    if (ready < 0 && errno == EINTR) continue;
    return ready > 0 && (item.revents & event) != 0;
  }
}

bool Connection::wait_for_request(std::chrono::milliseconds patience) {
  return begin_ < end_ || wait(POLLIN, Clock::now() + patience);
}

void Connection::begin_request(std::chrono::milliseconds time, std::size_t bytes) {
  until_ = Clock::now() + time;
  left_ = bytes;
}

bool Connection::is_readable() const { return begin_ < end_ || wait(POLLIN, until_); }

bool Connection::is_writable() const {
  pollfd item{socket_, POLLOUT | POLLRDHUP, 0};
  return ::poll(&item, 1, 0) >= 0 && (item.revents & (POLLHUP | POLLERR | POLLRDHUP)) == 0;
}

ssize_t Connection::read(char* data, std::size_t size) {
  if (begin_ == end_) {
    if (!wait(POLLIN, until_)) return -1;
    const ssize_t got = ::recv(socket_, buffer_, sizeof buffer_, 0);
    if (got <= 0) return got;
    begin_ = 0;
    end_ = static_cast<std::size_t>(got);
  }
  const std::size_t count = std::min(size, end_ - begin_);
  if (count > left_) return -1;
  left_ -= count;
  std::memcpy(data, buffer_ + begin_, count);
  begin_ += count;
  return static_cast<ssize_t>(count);
}

ssize_t Connection::write(const char* data, std::size_t size) {
  const Clock::time_point last = Clock::now() + longest_write;
  std::size_t written = 0;
  while (written < size) {
    if (!wait(POLLOUT, std::min(last, Clock::now() + slowest_write))) return -1;
    const ssize_t count = ::send(socket_, data + written, size - written, MSG_DONTWAIT | MSG_NOSIGNAL);
    if (count > 0)
      written += static_cast<std::size_t>(count);
    else if (errno != EAGAIN && errno != EINTR)
      return -1;
  }
  return static_cast<ssize_t>(written);
}

void Connection::get_remote_ip_and_port(std::string& ip, int& port) const {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (::getpeername(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0) address_of(address, ip, port);
}

void Connection::get_local_ip_and_port(std::string& ip, int& port) const {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size) == 0) address_of(address, ip, port);
}

}  // namespace rheonet::serve
