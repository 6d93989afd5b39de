#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rheonet::tool {

/// Thrown for an invalid command line. The message has what was found and what was expected; the hint has the remedy and may be empty.
struct WrongCommandLine {
  std::string message;
  std::string hint;
};

/// The number after an option. Throws WrongCommandLine.
double read_number(const char* option, const std::string& text);

/// The whole number after an option. Throws WrongCommandLine if it is outside `least` .. `most`.
int read_whole(const char* option, const std::string& text, int least, int most);

/// Adds an option that may be repeated, each time with one value or, with `commas`, several between commas. A comma in brackets
/// does not separate: `value(k1.force, 2 s)` is the name of one column.
void add_list(CLI::App* command, const char* names, std::vector<std::string>& values, const char* description, const char* type,
              bool commas = true);

}  // namespace rheonet::tool
