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

/// Ends the reading of a scene: the errors so far are more than anyone reads.
struct TooManyMistakes {};

/// Collects the mistakes of a scene while it is read. One that is met again (in each member of a `repeat`, in each
/// instance of a model) counts once.
class Mistakes {
 public:
  explicit Mistakes(const Sources& sources) : sources_(sources) {}

  /// Throws TooManyMistakes where it is one too many.
  void error(Spot spot, std::string message, std::string hint = {});
  void warning(Spot spot, std::string message, std::string hint = {});
  /// Number of errors so far: a reader that wants to know whether a part was sound compares before and after.
  std::size_t errors() const { return errors_; }
  const std::vector<Diagnostic>& all() const { return all_; }

  /// The place of character `offset` of the string `value`, whatever its quotes and escapes.
  Spot inside(const TomlValue& value, std::size_t offset) const;

  /// While it lives, messages end in "(in `path`)": which instance or member it is that a place in a model or in a
  /// `repeat` is wrong for. `path` must live as long.
  class Within {
   public:
    Within(Mistakes& mistakes, const std::string& path) : mistakes_(mistakes), before_(mistakes.path_) {
      mistakes.path_ = &path;
    }
    ~Within() { mistakes_.path_ = before_; }
    Within(const Within&) = delete;
    Within& operator=(const Within&) = delete;

   private:
    Mistakes& mistakes_;
    const std::string* before_;
  };

  /// The mistakes in the order of files and lines, those of the command line last; then, if there are more of them, that it
  /// is so.
  std::vector<Diagnostic> sorted() const;

 private:
  void add(Severity severity, Spot spot, std::string message, std::string hint);

  const Sources& sources_;
  std::vector<Diagnostic> all_;
  std::set<std::tuple<int, int, int, std::string>> seen_;
  std::size_t errors_ = 0;  ///< those that are met again too
  std::size_t different_errors_ = 0, different_warnings_ = 0;
  const std::string* path_ = nullptr;
};

/// Whether `a` comes before `b` as a reader meets them: files in order, the command line last.
bool comes_before(const Spot& a, const Spot& b);

/// "`a`, `b` or `c`": how messages list names.
std::string list_names(const std::vector<std::string>& names, std::string_view last_word = "or");

/// "did you mean `name`?", or else `otherwise`.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known, std::string otherwise = {});

}  // namespace rheonet
