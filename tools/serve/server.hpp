#pragma once

#include <httplib.h>

#include <atomic>
#include <cstddef>

namespace rheonet::serve {

/// An HTTP server that answers many at once and that no client can block.
class Server final : public httplib::Server {
 public:
  static constexpr std::size_t most_bytes = 2u << 20;  ///< of a request

  Server();
  /// Binds to an address; port 0: any that is free. The port, -1 if it cannot.
  int bind(const std::string& host, int port);
  /// After the answer to this request the connection ends: what else it holds is not read.
  static void end_connection();

 private:
  bool process_and_close_socket(int socket) override;

  std::atomic<int> waiting_ = 0;  ///< connections that no thread serves yet
};

}  // namespace rheonet::serve
