#pragma once

#include <httplib.h>

#include <chrono>
#include <mutex>
#include <string>

namespace rheonet::serve {

/// The secrets that a request must contain, because other users of the machine and other pages in the browser can also reach the server.
///
/// The printed address has a token in it. The page keeps the token in the storage of its own origin, and sends it with each
/// request to /api/. A cookie is not safe enough for that: browsers send it to every port of the machine, and a port may belong
/// to another user. The cookie that is set with the page therefore holds another key, which only loads the page again.
///
/// Links for others contain the key of guests in place of the token. It opens the page, the netlists and the runs, but saves nothing: a
/// class that has the link of a lesson cannot change the files of the teacher.
///
/// For typing on another machine there is a shorter address, with a code of 8 letters and digits (40 random bits), which redirects to the
/// address with the key of guests. Wrong codes are answered at a limited rate, so that the code cannot be guessed: half of all codes take 3500 years
/// at 5 tries a second.
class Keys {
 public:
  /// The name of the cookie contains `port`, so that several servers on a machine have separate cookies. `framed`: other pages may embed the
  /// page in a frame, where a browser sends no cookie; script and style sheet, which contain no secret, then need no cookie. Throws
  /// std::system_error.
  explicit Keys(int port, bool framed = false);

  /// The query string of the page's address: "?token=...".
  std::string query() const { return "?token=" + token_; }
  /// The query string of a page for guests: "?guest=...".
  std::string guest_query() const { return "?guest=" + guest_; }
  /// Whether a request may be answered. A request with the token or the key of guests in its address gets the cookie.
  bool admit(const httplib::Request& request, httplib::Response& response) const;
  /// Whether a request to /api/ has the token itself, and may write.
  bool is_owner(const httplib::Request& request) const;

  /// "abcd-efgh", the path of the short address.
  std::string short_path() const { return code_.substr(0, 4) + '-' + code_.substr(4); }
  /// Answers a request for a short address. Returns false if the path is not a short address.
  bool lead_in(const httplib::Request& request, httplib::Response& response);

 private:
  bool may_try();

  std::string token_, guest_, page_key_, cookie_, code_;
  bool framed_;
  std::mutex mutex_;
  double tries_ = 20;  ///< Number of tries that are answered without delay.
  std::chrono::steady_clock::time_point last_try_ = std::chrono::steady_clock::now();
};

/// The host without its port: "localhost" of "localhost:8017", "::1" of "[::1]:8017".
std::string without_port(const std::string& host);

/// Whether a host can be reached only from this machine.
bool is_this_machine(const std::string& host);

/// Why a request must be refused unread; "" if it may be answered. A page of another origin must not reach a server that listens only at
/// this machine, neither through a host name that its owner points here (DNS rebinding) nor by a cross-origin request. `host` is the
/// address that the server listens at.
std::string refusal(const httplib::Request& request, const std::string& host);

}  // namespace rheonet::serve
