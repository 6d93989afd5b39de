#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace rheonet::tool {

/// What a process ends with; part of the contract with scripts that call the program.
enum ExitStatus { done = 0, not_simulated = 1, not_as_claimed = 1, wrong_input = 2 };

/// A command line, read.
struct Arguments {
  enum class Command { run, check, compare, components, schema };

  Command command = Command::run;
  std::string scene;
  std::vector<std::string> scenes;     ///< of `compare`
  std::vector<std::string> pairs;      ///< PATH=PATH, of `compare`
  std::string vary;                    ///< PATH=RANGE, of `compare`; "": nothing
  std::optional<double> within;        ///< of `compare`
  std::string overlay;                 ///< where the data of `compare` go; "": nowhere
  std::string output = "-";            ///< "-": standard output
  std::string events;                  ///< where the events go; "": nowhere
  std::vector<std::string> overrides;  ///< PATH=VALUE
  std::optional<double> accuracy;
  bool quiet = false;
  bool verbose = false;
  std::string type;  ///< of `components`; "": all
  bool markdown = false;
};

/// Reads the words after the program's name. The exit status instead if there is nothing more to do: help or the
/// version was asked for, or the command line is wrong; what there is to say has then been printed.
std::variant<Arguments, ExitStatus> read_arguments(std::vector<std::string> words);

}  // namespace rheonet::tool
