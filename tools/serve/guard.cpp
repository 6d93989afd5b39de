#include "tools/serve/guard.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <string_view>
#include <system_error>

namespace rheonet::serve {
namespace {

bool is_address(const std::string& text) {
  unsigned char address[sizeof(in6_addr)];
  return inet_pton(AF_INET, text.c_str(), address) == 1 || inet_pton(AF_INET6, text.c_str(), address) == 1;
}

using Random = std::array<unsigned char, 16>;

/// 128 random bits.
Random random_bytes() {
  Random bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::system_error(errno, std::generic_category(), "no random numbers");
  return bytes;
}

std::string random_word() { return fmt::format("{:02x}", fmt::join(random_bytes(), "")); }

constexpr std::string_view letters = "abcdefghijkmnpqrstuvwxyz23456789";  // 32 characters, without l, o, 0 and 1.
constexpr std::size_t code_length = 8;

std::string random_code() {
  const Random bytes = random_bytes();
  std::string code;
  for (std::size_t k = 0; k < code_length; ++k) code += letters[bytes[k] % letters.size()];
  return code;
}

/// The code in a path such as "/ABCD-EFGH", in upper or lower case; "" if the path has no code.
std::string code_in(const std::string& path) {
  std::string code;
  for (const char c : path.substr(1))
    if (c != '-') code += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return code.size() == code_length && code.find_first_not_of(letters) == std::string::npos ? code : "";
}

/// Compares in constant time, so that the duration does not reveal where the strings differ.
bool is_same(const std::string& given, const std::string& key) {
  if (given.size() != key.size()) return false;
  unsigned char different = 0;
  for (std::size_t k = 0; k < key.size(); ++k) different = static_cast<unsigned char>(different | (given[k] ^ key[k]));
  return different == 0;
}

/// The value of a cookie; "" if there is none.
std::string cookie_of(const httplib::Request& request, const std::string& name) {
  const std::string all = "; " + request.get_header_value("Cookie");
  const std::string begin = "; " + name + '=';
  const std::size_t at = all.find(begin);
  if (at == std::string::npos) return "";
  const std::size_t value = at + begin.size();
  return all.substr(value, all.find(';', value) - value);
}

}  // namespace

std::string without_port(const std::string& host) {
  if (host.starts_with('[')) {
    const std::size_t end = host.find(']');
    return end == std::string::npos ? "" : host.substr(1, end - 1);
  }
  return host.substr(0, host.find(':'));
}

Keys::Keys(int port, bool framed)
    : token_(random_word()), guest_(random_word()), page_key_(random_word()), cookie_(fmt::format("rheonet-{}", port)), code_(random_code()), framed_(framed) {}

bool Keys::admit(const httplib::Request& request, httplib::Response& response) const {
  if (is_same(request.get_param_value("token"), token_) || (!request.path.starts_with("/api/") && is_same(request.get_param_value("guest"), guest_))) {
    // SameSite=Lax: the browser also sends the cookie when a link of another site opens the page. The cookie alone gives no access to the
    // folder.
    response.set_header("Set-Cookie", fmt::format("{}={}; Path=/; HttpOnly; SameSite=Lax", cookie_, page_key_));
    return true;
  }
  if (is_owner(request) || is_same(request.get_header_value("Authorization"), "Bearer " + guest_)) return true;
  if (framed_ && (request.path == "/playground.js" || request.path == "/playground.css")) return true;
  return !request.path.starts_with("/api/") && is_same(cookie_of(request, cookie_), page_key_);
}

bool Keys::is_owner(const httplib::Request& request) const {
  return is_same(request.get_header_value("Authorization"), "Bearer " + token_) || is_same(request.get_param_value("token"), token_);
}

bool Keys::may_try() {
  constexpr double rate = 5, most = 20;  // Tries a second, and tries without delay.
  const std::lock_guard lock(mutex_);
  const auto now = std::chrono::steady_clock::now();
  tries_ = std::min(most, tries_ + rate * std::chrono::duration<double>(now - last_try_).count());
  last_try_ = now;
  if (tries_ < 1) return false;
  tries_ -= 1;
  return true;
}

bool Keys::lead_in(const httplib::Request& request, httplib::Response& response) {
  const std::string code = request.method == "GET" && request.path.starts_with('/') ? code_in(request.path) : "";
  if (code.empty()) return false;
  if (!may_try()) {
    response.status = 429;
    response.set_content("Too many addresses were tried. Wait a few seconds, and load this page again.\n", "text/plain; charset=utf-8");
  } else if (is_same(code, code_)) {
    response.set_redirect("/" + guest_query());
  } else {
    response.status = 404;
    response.set_content("This address is not the one that `rheonet serve` has printed. Compare the letters.\n", "text/plain; charset=utf-8");
  }
  return true;
}

bool is_this_machine(const std::string& host) { return host == "localhost" || host == "127.0.0.1" || host == "::1"; }

std::string refusal(const httplib::Request& request, const std::string& listening) {
  const std::string host = request.get_header_value("Host");
  const std::string name = without_port(host);
  // A server that listens at all addresses accepts any numeric address, but no other name: anyone can point a name here.
  const bool open = !is_this_machine(listening);
  if (!is_this_machine(name) && name != listening && !(open && is_address(name))) return "this host name is not served";
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
