#pragma once

#include <httplib.h>

#include <chrono>
#include <cstddef>
#include <string>

namespace rheonet::serve {

/// A connection that no client can hold for ever, however slowly it sends or takes what it gets.
class Connection final : public httplib::Stream {
 public:
  using Clock = std::chrono::steady_clock;

  explicit Connection(int socket) : socket_(socket) {}

  /// Waits for the first byte of a request; false if none comes.
  bool wait_for_request(std::chrono::milliseconds patience);
  /// From now on the request has this long to come, and no more bytes than that.
  void begin_request(std::chrono::milliseconds time, std::size_t bytes);

  bool is_readable() const override;
  /// False also if the client has gone.
  bool is_writable() const override;
  ssize_t read(char* data, std::size_t size) override;
  /// Writes all, as long as the client takes some every few seconds and is done in time.
  ssize_t write(const char* data, std::size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  int socket() const override { return socket_; }

 private:
  bool wait(short event, Clock::time_point until) const;

  int socket_;
  char buffer_[4096];
  std::size_t begin_ = 0, end_ = 0;  ///< of what is in the buffer
  Clock::time_point until_{};        ///< when the request must be there
  std::size_t left_ = 0;             ///< bytes that it may still have
};

}  // namespace rheonet::serve
