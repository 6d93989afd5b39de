#pragma once

#include <string>

#include "core/netlist/presentation.hpp"
#include "core/netlist/scene.hpp"
#include "tools/plot/compose.hpp"
#include "tools/plot/mistake.hpp"
#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// Whether a file name has the ending of a figure and the file can be written; prints an error if not. Call before the simulation.
/// `option` is the option that names the file: "--output".
bool can_be_figure(const std::string& path, const char* option);

/// Prints the notes on standard error.
void say_notes(const std::vector<std::string>& notes);

/// Prints the reason why a figure cannot be drawn.
void report(const plot::Mistake& mistake);

/// Writes an SVG document to a file, converted to PNG if the name ends in .png.
ExitStatus write_figure(const std::string& svg, const std::string& path);

/// Composes and writes a figure, and prints the notes. Throws plot::Mistake.
ExitStatus write_figure(std::vector<plot::Measured> curves, const plot::Look& look, const std::string& path);

/// The figure of `run --plot`: collects the curves of `[plot]` during a run, or without them all records over time.
class RunFigure {
 public:
  RunFigure(const Scene& scene, const PlotTable& table);
  void row(double time, const std::vector<double>& values);
  ExitStatus write(const std::string& path) const;
  /// Writes the figure of a run that ended early, with the rows so far. Prints the file name, or that there is nothing to draw.
  void write_beginning(const std::string& path) const;

 private:
  plot::Look look_;
  std::vector<plot::ColumnPair> chosen_;  ///< Column 0 is time.
  std::vector<plot::Measured> curves_;
};

}  // namespace rheonet::tool
