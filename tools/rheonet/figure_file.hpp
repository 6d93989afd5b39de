#pragma once

#include <string>

#include "core/netlist/presentation.hpp"
#include "core/netlist/scene.hpp"
#include "tools/plot/compose.hpp"
#include "tools/plot/mistake.hpp"
#include "tools/rheonet/arguments.hpp"

namespace rheonet::tool {

/// Whether a file can be a figure: by its ending, and because it can be written; says so if not, before anything is simulated
/// for it. `option` is what names it: "--output".
bool can_be_figure(const std::string& path, const char* option);

/// Prints on standard error what was left out of a figure.
void say_notes(const std::vector<std::string>& notes);

/// Says why a figure cannot be drawn.
void report(const plot::Mistake& mistake);

/// Writes an SVG document to a file, or the .png made of it.
ExitStatus write_figure(const std::string& svg, const std::string& path);

/// Composes and writes a figure, and says what was left out of it. Throws plot::Mistake.
ExitStatus write_figure(std::vector<plot::Measured> curves, const plot::Look& look, const std::string& path);

/// Draws what `[plot]` says of what a run records while it goes on, or all records over time: `run --plot`.
class RunFigure {
 public:
  RunFigure(const Scene& scene, const PlotTable& table);
  void row(double time, const std::vector<double>& values);
  ExitStatus write(const std::string& path) const;
  /// The same of a run that came to no end: what there is of it. Says where it is, or that there is nothing to draw.
  void write_beginning(const std::string& path) const;

 private:
  plot::Look look_;
  std::vector<plot::ColumnPair> chosen_;  ///< column 0 is time
  std::vector<plot::Measured> curves_;
};

}  // namespace rheonet::tool
