#pragma once

#include <httplib.h>

#include <string>

namespace rheonet::serve {

/// The secrets that a request must show, because other users of the machine and other pages in the browser can reach the server
/// too.
///
/// The printed address has a token in it. The page keeps the token in the storage of its own origin, and sends it with each
/// request to /api/. A cookie is not safe enough for that: browsers send it to every port of the machine, and a port may belong
/// to another user. The cookie that is set with the page therefore holds another key, which only loads the page again.
class Keys {
 public:
  /// For the server at a port: of several servers on a machine each has a cookie of its own. Throws std::system_error.
  explicit Keys(int port);

  /// "?token=...", which follows the address of the page.
  std::string query() const { return "?token=" + token_; }
  /// Whether a request may be answered. One that brings the token in its address gets the cookie.
  bool admit(const httplib::Request& request, httplib::Response& response) const;

 private:
  std::string token_, page_key_, cookie_;
};

/// Whether a host is reached from this machine alone.
bool is_this_machine(const std::string& host);

/// Why a request is refused before anything of it is looked at; "" if it is not. A page of another origin must not
/// reach a server that listens at this machine only: neither by name (a name that its owner lets point here) nor by a
/// request across origins. `host` is the address that is listened at.
std::string refusal(const httplib::Request& request, const std::string& host);

}  // namespace rheonet::serve
