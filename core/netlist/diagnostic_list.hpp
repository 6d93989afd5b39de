#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/netlist/diagnostic.hpp"

namespace rheonet {

struct TomlValue;

/// Thrown to end the reading of a scene that has more errors than anyone reads.
struct TooManyDiagnostics {};

/// Collects the mistakes of a scene while it is read. A mistake that repeats (in each member of a `repeat`, in each
/// instance of a model) is listed once.
class DiagnosticList {
 public:
  explicit DiagnosticList(const Sources& sources) : sources_(sources) {}

  /// Throws TooManyDiagnostics once the limit of listed errors is exceeded.
  void error(Spot spot, std::string message, std::string hint = {});
  void warning(Spot spot, std::string message, std::string hint = {});
  /// Number of errors so far. A reader compares the number before and after a part to see whether that part is sound.
  std::size_t errors() const { return errors_; }
  const std::vector<Diagnostic>& all() const { return all_; }

  /// The place of character `offset` of the string `value`; quotes and escapes are taken into account.
  Spot inside(const TomlValue& value, std::size_t offset) const;

  /// During its lifetime messages end in "(in `path`)", the instance or member for which a place in a model or `repeat` is
  /// wrong. `path` must outlive it.
  class Within {
   public:
    Within(DiagnosticList& diagnostics, const std::string& path) : diagnostics_(diagnostics), before_(diagnostics.path_) {
      diagnostics.path_ = &path;
    }
    ~Within() { diagnostics_.path_ = before_; }
    Within(const Within&) = delete;
    Within& operator=(const Within&) = delete;

   private:
    DiagnosticList& diagnostics_;
    const std::string* before_;
  };

  /// The mistakes in the order of files and lines, those of the command line last; then a note if more were found than are
  /// listed.
  std::vector<Diagnostic> sorted() const;

 private:
  void add(Severity severity, Spot spot, std::string message, std::string hint);

  const Sources& sources_;
  std::vector<Diagnostic> all_;
  std::set<std::tuple<int, int, int, std::string>> seen_;
  std::size_t errors_ = 0;  ///< repeated errors included
  std::size_t different_errors_ = 0, different_warnings_ = 0;
  const std::string* path_ = nullptr;
};

/// Whether `a` comes before `b` in the order of reading: files in their order, the command line last.
bool comes_before(const Spot& a, const Spot& b);

/// "`a`, `b` or `c`": a list of names in a message.
std::string list_names(const std::vector<std::string>& names, std::string_view last_word = "or");

/// Up to this many names may be mistyped; more of them are intended, and no other name is looked for.
constexpr std::ptrdiff_t most_mistyped = 20;

/// "did you mean `name`?" with the nearest known name, or `otherwise` if none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known, std::string otherwise = {});

}  // namespace rheonet
