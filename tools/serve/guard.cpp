#include "tools/serve/guard.hpp"

#include <arpa/inet.h>

namespace rheonet::serve {
namespace {

/// "localhost" of "localhost:8017", "::1" of "[::1]:8017".
std::string without_port(const std::string& host) {
  if (host.starts_with('[')) {
    const std::size_t end = host.find(']');
    return end == std::string::npos ? "" : host.substr(1, end - 1);
  }
  return host.substr(0, host.find(':'));
}

bool is_address(const std::string& text) {
  unsigned char address[sizeof(in6_addr)];
  return inet_pton(AF_INET, text.c_str(), address) == 1 || inet_pton(AF_INET6, text.c_str(), address) == 1;
}

}  // namespace

std::string refusal(const httplib::Request& request, const std::string& listening) {
  const std::string host = request.get_header_value("Host");
  const std::string name = without_port(host);
  const bool local = name == "localhost" || name == "127.0.0.1" || name == "::1";
  // Who listens at all addresses is reached by any of them; a name could be anyone's.
  const bool open = listening != "127.0.0.1" && listening != "localhost" && listening != "::1";
  if (!local && name != listening && !(open && is_address(name))) return "this host name is not served";
  if (const std::string origin = request.get_header_value("Origin"); !origin.empty() && origin != "http://" + host)
    return "requests from other pages are not served";
  if (const std::string site = request.get_header_value("Sec-Fetch-Site");
      request.path.starts_with("/api/") && (site == "cross-site" || site == "same-site"))
    return "requests from other pages are not served";
  if (request.has_header("Content-Encoding") || request.has_header("Range")) return "compressed bodies and ranges are not served";
  if (request.method == "POST" && !request.get_header_value("Content-Type").starts_with("application/json"))
    return "bodies must be application/json";
  return "";
}

}  // namespace rheonet::serve
