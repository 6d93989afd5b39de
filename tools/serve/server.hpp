#pragma once

#include <httplib.h>

#include <atomic>
#include <cstddef>

namespace rheonet::serve {

/// An HTTP server that answers many clients at a time and that no client can block.
class Server final : public httplib::Server {
 public:
  static constexpr std::size_t most_bytes = 2u << 20;  ///< Largest size of a request.

  Server();
  /// Binds to an address; port 0: any free port. Returns the port, or -1 on failure.
  int bind(const std::string& host, int port);
  /// Closes the connection after the answer to this request; further data are not read.
  static void end_connection();

 private:
  bool process_and_close_socket(int socket) override;

  std::atomic<int> waiting_ = 0;  ///< Connections that wait for a thread.
};

}  // namespace rheonet::serve
