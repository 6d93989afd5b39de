#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tools/rheonet/page_arguments.hpp"
#include "tools/rheonet/sweep_arguments.hpp"

namespace rheonet::tool {

/// What a process ends with; part of the contract with scripts that call the program.
enum ExitStatus { done = 0, not_simulated = 1, not_as_claimed = 1, wrong_input = 2 };

/// What `effects` lets a record be off, of its largest magnitude, to recommend a model: what a measurement does not show.
inline constexpr double default_within = 0.01;

/// A command line, read.
struct Arguments {
  enum class Command { run, check, explain, effects, compare, precision, sweep, plot, draw, report, serve, components, expressions, schema };

  Command command = Command::run;
  std::vector<std::string> words;      ///< as they were given
  std::string scene;
  std::vector<std::string> scenes;     ///< of `compare`; of `plot` also CSV files
  std::vector<std::string> pairs;      ///< PATH=PATH, of `compare`
  std::string vary;                    ///< PATH=RANGE, of `compare`; "": nothing
  std::optional<double> within;        ///< of `compare`; of `effects`, else default_within
  std::string overlay;                 ///< where the data of `compare`, `precision` and `effects` go; "": nowhere
  std::string output = "-";            ///< "-": standard output
  std::string events;                  ///< where the events go; "": nowhere
  std::string figure;                  ///< where `run` draws its records; "": nowhere
  std::vector<std::string> overrides;  ///< PATH=VALUE
  std::optional<double> accuracy;
  bool certify = false;                ///< of `run` and `report`
  bool profile = false;                ///< of `run`
  std::vector<std::string> sensitivities;  ///< of `run`: paths of values
  int order = 5;                       ///< of the integration method in `run`, at most
  std::vector<double> accuracies;      ///< of `precision`, each once, from the loosest on
  int runs = 5;                        ///< of `precision`, for each accuracy; of `effects`, of each model
  bool variants = false;               ///< of `precision`
  bool certified = false;              ///< of `precision`: certified runs too
  std::vector<std::string> variant_texts;  ///< of `precision`: as after --variant
  std::vector<std::string> without;    ///< effects
  std::optional<std::vector<std::string>> only;  ///< effects; empty: none
  std::vector<std::string> keep;       ///< reductions that are not made
  bool json = false;                   ///< of `explain`
  bool numerics = false;               ///< of `explain`: print the numerical parameters; there is no scene then
  bool quiet = false;
  bool verbose = false;
  std::string type;  ///< of `components`; "": all
  bool markdown = false;

  /// Of `plot`: what is drawn, and how; "" and empty where that is left to the files.
  struct Plot {
    std::string x;                                        ///< a column
    std::vector<std::string> y;                           ///< columns
    std::vector<std::string> loops, flows, phases, decays;  ///< elements; of `phases` nodes
    std::string log;                                      ///< "x", "y", "xy"
    std::string x_range, y_range;                         ///< "LOW:HIGH"
    std::string size;                                     ///< "WIDTHxHEIGHT"
    std::string title, x_label, y_label;
    std::vector<std::string> units, names;
    bool magnitudes = false, marks = false;
  };
  Plot plot;
  SweepArguments sweep;
  ReportArguments report;
  ServeArguments serve;
  std::string title;    ///< of `draw` and `report`; "": that of the scene
  bool no_values = false;  ///< of `draw`
  bool all = false;        ///< of `draw`
  std::string domain;  ///< of CSV files: "translation", "rotation"; "": not said
};

/// Reads the words after the program's name. The exit status instead if there is nothing more to do: help or the
/// version was asked for, or the command line is wrong; what there is to say has then been printed.
std::variant<Arguments, ExitStatus> read_arguments(std::vector<std::string> words);

}  // namespace rheonet::tool
