#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/result/row_store.hpp"
#include "core/result/run.hpp"

namespace rheonet {

/// How the records of a scene change with one value of its netlist. With p the value and r a record, all derivatives are p dr/dp, in
/// the unit of r: the change of the record for a relative change of the value, per unit of that change.
struct Sensitivity {
  struct Record {
    double largest = 0;  ///< magnitude of the derivative
    double time = 0;     ///< of the largest [s]
    double error = 0;    ///< estimated largest error of the derivative
  };
  RowStore rows;      ///< the derivative of each record at the times of the scene's rows; none at events
  std::vector<Record> records;
  double change = 0;  ///< relative change of the value in the runs that were compared
  int runs = 0;
};

/// The scene with the value multiplied by a factor. Throws what reading throws.
using MultipliedScene = std::function<Scene(double factor)>;

/// Compares runs with the value changed by one, two and three small steps to either side, to the sixth order. The step is chosen so that neither
/// its powers nor the errors of the runs matter. A row between an event of one run and the same event of another is compared on its own
/// side of the event: the derivative is that of the motion between two events, and jumps with it. `name` is that of the value, for messages. The
/// settings `interrupt`, `threads` and `progress` apply to each run. Throws SimulationError like `run`, where a change of the value changes the times of the rows,
/// and where a derivative does not exist because any change leads to other events on both sides.
Sensitivity sensitivity(const MultipliedScene& scene, const std::string& name, const RunSettings& settings = {});

}  // namespace rheonet
