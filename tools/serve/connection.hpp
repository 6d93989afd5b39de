#pragma once

#include <httplib.h>

#include <chrono>
#include <cstddef>
#include <string>

namespace rheonet::serve {

/// A connection with time limits, so that a client that sends or reads slowly cannot hold it forever.
class Connection final : public httplib::Stream {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Connection(int socket) : socket_(socket) {}

  /// Waits for the first byte of a request. Returns false if none arrives in time.
  bool wait_for_request(std::chrono::milliseconds patience);
  /// Limits the time in which the request must arrive, and its size.
  void begin_request(std::chrono::milliseconds time, std::size_t bytes);

  bool is_readable() const override;
  /// False also if the client has closed the connection.
  bool is_writable() const override;
  ssize_t read(char* data, std::size_t size) override;
  /// Writes all bytes, unless the client reads nothing for some seconds or the write takes too long.
  ssize_t write(const char* data, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  int socket() const override { return socket_; }

 private:
  bool wait(short event, Clock::time_point until) const;

  int socket_;
  char buffer_[4096];
  std::size_t begin_ = 0, end_ = 0;  ///< Range of unread bytes in the buffer.
  Clock::time_point until_{};        ///< Deadline of the request.
  std::size_t left_ = 0;             ///< Number of bytes that the request may still have.
};

}  // namespace rheonet::serve
