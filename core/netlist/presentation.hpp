#pragma once

#include <string>
#include <vector>

namespace rheonet {

/// `[plot]`: what is drawn of a scene where nobody says otherwise.
struct PlotTable {
  struct Curve { std::string x, y; };  ///< paths of records; `x` may be "time"
  std::vector<Curve> curves;           ///< none: every record over time
  std::vector<std::string> units;      ///< for the axes that have their dimension
  std::string log;                     ///< logarithmic axes: "", "x", "y" or "xy"

  /// The paths of the curves but "time", each once.
  std::vector<std::string> records() const;
};

/// `[demo]`: what a scene is to teach.
struct Demo {
  /// Between which values a parameter of the scene is worth moving.
  struct Slider {
    std::string parameter;
    std::string unit;              ///< as the file has it; "" for a number
    double least = 0, most = 0;    ///< in that unit
    double step = 0;               ///< in that unit; 0: any
    bool logarithmic = false;      ///< from a positive value to one that is at least `decades_apart` times as large
  };
  static constexpr double decades_apart = 20;

  std::string question, change, see, why;  ///< "" without a `[demo]`
  std::vector<Slider> sliders;             ///< in the order of the file
};

/// What a scene says of how it is shown; nothing of it changes what comes out.
struct Presentation {
  PlotTable plot;
  Demo demo;
};

}  // namespace rheonet
