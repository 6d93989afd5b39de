#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tools/rheonet/page_arguments.hpp"
#include "tools/rheonet/sweep_arguments.hpp"

namespace rheonet::tool {

/// Exit status of the process. Scripts that call the program rely on these values.
enum ExitStatus { done = 0, not_simulated = 1, not_as_claimed = 1, wrong_input = 2 };

/// Error that `effects` accepts in a recommended model, as a fraction of the largest magnitude of each record: about the uncertainty of a
/// measurement.
inline constexpr double default_within = 0.01;

/// The contents of a command line.
struct Arguments {
  enum class Command { run, check, explain, effects, compare, precision, sweep, plot, draw, report, serve, components, expressions, schema };

  Command command = Command::run;
  std::vector<std::string> words;      ///< The command line as it was given.
  std::string scene;
  std::vector<std::string> scenes;     ///< For `compare` and `report`; for `plot` also CSV files.
  std::vector<std::string> pairs;      ///< PATH=PATH, for `compare` and `precision`.
  std::string vary;                    ///< PATH=RANGE, for `compare`; "": no value is varied.
  std::optional<double> within;        ///< Relative error that `compare` and `effects` accept.
  std::string overlay;                 ///< File for the data of `compare`, `precision` and `effects`; "": none.
  std::string output = "-";            ///< Output file; "-": standard output.
  std::string events;                  ///< File for the events; "": none.
  std::string summary;                 ///< JSON file for the summary of `run`; "": none.
  std::string figure;                  ///< File for the figure of `run` or `precision`; "": none.
  std::vector<std::string> overrides;  ///< PATH=VALUE.
  std::optional<double> accuracy;
  bool certify = false;                ///< For `run` and `report`.
  bool profile = false;                ///< For `run`.
  std::vector<std::string> sensitivities;  ///< For `run`: paths of values.
  int order = 5;                       ///< For `run`: highest order of the integration method.
  std::vector<double> accuracies;      ///< For `precision`: distinct, in descending order.
  int runs = 5;                        ///< Repetitions of a timed run: for each accuracy (`precision`) or model (`effects`).
  bool variants = false;               ///< For `precision`.
  bool certified = false;              ///< For `precision`: add certified runs.
  std::vector<std::string> variant_texts;  ///< For `precision`: the words after each --variant.
  std::vector<std::string> without;    ///< Effects that are left out.
  std::optional<std::vector<std::string>> only;  ///< Effects that are kept; an empty vector keeps none.
  std::vector<std::string> keep;       ///< Reductions that are switched off.
  bool json = false;                   ///< For `explain`.
  bool numerics = false;               ///< For `explain`: print the numerical parameters; there is no scene then.
  bool quiet = false;
  bool verbose = false;
  std::string type;  ///< For `components`; "": all.
  bool markdown = false;

  /// Options of `plot`. An empty string or vector leaves the choice to the files.
  struct Plot {
    std::string x;                                        ///< Column.
    std::vector<std::string> y;                           ///< Columns.
    std::vector<std::string> loops, flows, phases, decays;  ///< Elements; for `phases` nodes.
    std::string log;                                      ///< Logarithmic axes: "x", "y", "xy".
    std::string x_range, y_range;                         ///< "LOW:HIGH".
    std::string size;                                     ///< "WIDTHxHEIGHT" [px].
    std::string title, x_label, y_label;
    std::vector<std::string> units, names;
    bool magnitudes = false, marks = false;
  };
  Plot plot;
  SweepArguments sweep;
  ReportArguments report;
  ServeArguments serve;
  std::string title;    ///< For `draw` and `report`; "": the title of the scene.
  bool no_values = false;  ///< For `draw`.
  bool all = false;        ///< For `draw`.
  std::string domain;  ///< Domain of CSV files: "translation", "rotation"; "": unspecified.
};

/// Reads the words after the program's name. Returns an exit status instead after printing the help, the version, or the error in the
/// command line.
std::variant<Arguments, ExitStatus> read_arguments(std::vector<std::string> words);

}  // namespace rheonet::tool
