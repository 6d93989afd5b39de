#include "core/netlist/toml_scan.hpp"

#include <fmt/format.h>

namespace rheonet {

namespace {

// Longer than any path of this format; each part takes stack in the parser and its tables.
constexpr int longest_key = 32;

/// Length of the UTF-8 character at the start of `text`; 0 if invalid (overlong forms and surrogates included).
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  if ((first == 0xE0 && byte(1) < 0xA0) || (first == 0xED && byte(1) > 0x9F)) return 0;
  if ((first == 0xF0 && byte(1) < 0x90) || (first == 0xF4 && byte(1) > 0x8F)) return 0;
  return length;
}

/// Steps through the text by characters, and keeps track of line and column.
class Scan {
 public:
  Scan(std::string_view text, int file, DiagnosticList& diagnostics) : rest_(text), diagnostics_(diagnostics), spot_{file, 1, 1} {}

  bool run() {
    int dots = 0;
    while (!rest_.empty()) {
      const char c = rest_.front();
      if (c == '#') {
        while (!rest_.empty() && rest_.front() != '\n')
          if (!step()) return false;
      } else if (c == '"' || c == '\'') {
        if (!string()) return false;
      } else {
        if (c == '.' && ++dots > longest_key) {
          diagnostics_.error(spot_, fmt::format("a key has at most {} parts, this one has more", longest_key));
          return false;
        }
        if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) dots = 0;
        if (!step()) return false;
      }
    }
    return true;
  }

 private:
  bool step() {
    const std::size_t length = character_length(rest_);
    if (length == 0) {
      diagnostics_.error(spot_, fmt::format("byte 0x{:02X} is not UTF-8", static_cast<unsigned char>(rest_.front())),
                      "a netlist is UTF-8 text: save the file in that encoding");
      return false;
    }
    if (rest_.front() == '\n') {
      ++spot_.line;
      spot_.column = 1;
    } else {
      ++spot_.column;
    }
    rest_.remove_prefix(length);
    return true;
  }

  bool string() {
    const Spot opening = spot_;
    const char quote = rest_.front();
    const std::string_view long_quote = quote == '"' ? "\"\"\"" : "'''";
    const bool long_string = rest_.starts_with(long_quote);
    for (int i = 0; i < (long_string ? 3 : 1); ++i) step();
    while (!rest_.empty()) {
      if (!long_string && (rest_.front() == '\n' || rest_.starts_with("\r\n"))) break;
      if (long_string ? rest_.starts_with(long_quote) : rest_.front() == quote) {
        for (int i = 0; i < (long_string ? 3 : 1); ++i) step();
        // Up to two more quotes belong to the text of a long string.
        while (long_string && !rest_.empty() && rest_.front() == quote) step();
        return true;
      }
      if (quote == '"' && rest_.front() == '\\' && rest_.size() > 1 && !step()) return false;
      if (!step()) return false;
    }
    diagnostics_.error(opening, long_string ? "this string is never closed" : "this string is not closed on its line",
                    fmt::format("close it with {}", long_string ? long_quote : long_quote.substr(0, 1)));
    return false;
  }

  std::string_view rest_;
  DiagnosticList& diagnostics_;
  Spot spot_;
};

}  // namespace

bool scan_toml(std::string_view text, int file, DiagnosticList& diagnostics) { return Scan(text, file, diagnostics).run(); }

}  // namespace rheonet
