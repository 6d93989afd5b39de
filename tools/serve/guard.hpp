#pragma once

#include <httplib.h>

#include <chrono>
#include <mutex>
#include <string>

namespace rheonet::serve {

/// The secrets that a request must show, because other users of the machine and other pages in the browser can reach the server
/// too.
///
/// The printed address has a token in it. The page keeps the token in the storage of its own origin, and sends it with each
/// request to /api/. A cookie is not safe enough for that: browsers send it to every port of the machine, and a port may belong
/// to another user. The cookie that is set with the page therefore holds another key, which only loads the page again.
///
/// Who types an address on another machine gets a shorter one, with a code of 8 letters and digits (40 random bits), which leads to the
/// address with the token. Wrong codes are answered at a limited rate, so that nobody guesses it: 5 tries a second take 3500 years
/// for half of all codes.
class Keys {
 public:
  /// For the server at a port: of several servers on a machine each has a cookie of its own. `framed`: other pages may show the
  /// page in a frame, where a browser sends no cookie; script and style sheet, which hold no secret, then need none. Throws
  /// std::system_error.
  explicit Keys(int port, bool framed = false);

  /// "?token=...", which follows the address of the page.
  std::string query() const { return "?token=" + token_; }
  /// Whether a request may be answered. One that brings the token in its address gets the cookie.
  bool admit(const httplib::Request& request, httplib::Response& response) const;

  /// "abcd-efgh", the path of the short address.
  std::string short_path() const { return code_.substr(0, 4) + '-' + code_.substr(4); }
  /// Answers a request for a short address. False if the path is none.
  bool lead_in(const httplib::Request& request, httplib::Response& response);

 private:
  bool may_try();

  std::string token_, page_key_, cookie_, code_;
  bool framed_;
  std::mutex mutex_;
  double tries_ = 20;  ///< wrong codes that are answered at once
  std::chrono::steady_clock::time_point last_try_ = std::chrono::steady_clock::now();
};

/// Whether a host is reached from this machine alone.
bool is_this_machine(const std::string& host);

/// Why a request is refused before anything of it is looked at; "" if it is not. A page of another origin must not
/// reach a server that listens at this machine only: neither by name (a name that its owner lets point here) nor by a
/// request across origins. `host` is the address that is listened at.
std::string refusal(const httplib::Request& request, const std::string& host);

}  // namespace rheonet::serve
