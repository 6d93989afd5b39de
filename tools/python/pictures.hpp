#pragma once

#include <pybind11/pybind11.h>

#include <optional>
#include <string>
#include <vector>

#include "tools/python/reading.hpp"
#include "tools/rheonet/arguments.hpp"

namespace rheonet::python {

/// The keywords of Result.plot() as the options of `rheonet plot`.
tool::Arguments::Plot plot_options(const py::kwargs& keywords);

/// A figure of the rows of a run.
struct Figure {
  struct Curve {
    std::string name, x, y;  ///< `x` and `y` are columns.
  };
  std::string svg;
  std::vector<Curve> curves;
  bool logarithmic_x = false, logarithmic_y = false, magnitudes = false;
  std::vector<std::string> notes;  ///< On everything that was left out.
};

/// Draws as `rheonet plot` does. Throws plot::Mistake.
Figure draw(const Run& run, const std::string& name, const tool::Arguments::Plot& options);

/// The bytes of a PNG. Raises OSError if no converter is installed.
py::bytes png_of(const std::string& svg);

/// Replaces a file as the commands do: only when the new one is complete. Returns the error (errno) or 0.
int write_file(const std::string& path, const std::string& content);

/// The HTML of `rheonet report`, and the failures of its scenes. Raises RuntimeError if rheonet was built without the page.
py::tuple report(const std::vector<const Reading*>& readings, std::optional<double> accuracy, const std::string& title, bool certify, bool precision,
                 const py::object& progress);

}  // namespace rheonet::python
