#pragma once

#include <string>
#include <vector>

namespace rheonet {

/// `[plot]`: the default plot of a scene.
struct PlotTable {
  struct Curve { std::string x, y; };  ///< paths of records; `x` may be "time"
  std::vector<Curve> curves;           ///< empty: every record over time
  std::vector<std::string> units;      ///< each applies to the axes of its dimension
  std::string log;                     ///< logarithmic axes: "", "x", "y" or "xy"

  /// The records on the axes of all curves, each once; "time" is left out.
  std::vector<std::string> records() const;
};

/// `[demo]`: the lesson that a scene teaches.
struct Demo {
  /// Range in which a parameter of the scene is worth varying.
  struct Slider {
    std::string parameter;
    std::string unit;              ///< as in the file; "" for a number
    double least = 0, most = 0;    ///< in that unit
    double step = 0;               ///< in that unit; 0: any
    bool logarithmic = false;      ///< the range is positive and spans at least a factor of `decades_apart`
  };
  static constexpr double decades_apart = 20;

  std::string question, change, see, why;  ///< "" without a `[demo]`
  std::vector<Slider> sliders;             ///< in the order of the file
};

/// How a scene is displayed; does not affect its results.
struct Presentation {
  PlotTable plot;
  Demo demo;
};

}  // namespace rheonet
