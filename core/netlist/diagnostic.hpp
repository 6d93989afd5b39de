#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rheonet {

/// A place in a netlist. Files are numbered in the order of reading. Lines and columns count from 1; columns count
/// characters (UTF-8 code points). On the command line, `line` counts the entries of `Sources::command_line`.
struct Spot {
  static constexpr int command_line = -1;

  int file = command_line;
  int line = 0;
  int column = 0;

  bool on_command_line() const { return file == command_line; }
};

/// The text of every file read, kept for excerpts in messages.
struct Sources {
  enum class Role { scene, included, table };
  struct File { std::filesystem::path path; std::string text; Role role = Role::scene; };
  std::vector<File> files;
  std::vector<std::string> command_line;  ///< options that messages point into, as typed: "--set k1.stiffness=3"
};

enum class Severity { error, warning };

/// One mistake: the finding, the rule that it violates, and a remedy.
struct Diagnostic {
  Severity severity = Severity::error;
  Spot spot;
  std::string message;  ///< one sentence without a final full stop: what was found and what was expected
  std::string hint;     ///< the remedy ("did you mean `stiffness`?"); may be empty
};

/// Formats a diagnostic as compilers do:
///
///     scene.toml:3:12: error: unknown element type `sprong`
///       3 | k1 = { type = "sprong", between = ["a", "ground"] }
///         |               ^
///       did you mean `spring`?
std::string format(const Diagnostic& diagnostic, const Sources& sources);

/// The nearest of `known` by edit distance (Damerau-Levenshtein); "" if none is within a third of the length (at least 2).
/// Case counts only between equally near names.
std::string nearest(std::string_view word, const std::vector<std::string>& known);

}  // namespace rheonet
