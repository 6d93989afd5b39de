#pragma once

#include <string>

namespace rheonet::bench {

/// Netlists of the benchmark. A program in hand/ of the same name has the same numbers.
std::string maxwell();
std::string stick_slip();
/// Masses in a chain of springs and dashpots, pushed at the free end; made by `repeat`.
std::string ladder(int masses);
/// The same chain without dashpots, each element written out: `elements` lines.
std::string written_out(int elements);
/// A mass held by springs in series with sliders, side by side.
std::string iwan(int pairs);
/// Layers of fluid between two plates, one of which is moved: masses with dashpots between.
std::string couette(int layers);
/// A random tree of series and parallel groups of so many springs and dashpots, one end driven.
std::string tree(int elements);
/// A square of side x side masses on sliders. Springs and dashpots connect neighbours; one edge is driven back and forth.
std::string grid(int side);

}  // namespace rheonet::bench
