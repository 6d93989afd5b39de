#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/netlist/presentation.hpp"
#include "core/netlist/scene.hpp"
#include "core/network/error.hpp"
#include "core/result/certify.hpp"
#include "core/result/run.hpp"

namespace rheonet::python {

namespace py = pybind11;

/// The rows, the events and the summary of a run. Each record has a column of its own, which NumPy views without a copy.
struct Run {
  std::vector<double> times;
  std::vector<std::vector<double>> columns;  ///< One for each record of the scene.
  std::string events;                        ///< CSV with a header, as from `rheonet run --events`.
  Summary summary;
  std::optional<Certificate> certificate;
  std::shared_ptr<const Scene> scene;
  std::shared_ptr<const Sources> sources;
  PlotTable drawn;                           ///< The `[plot]` of the netlist.
  std::optional<SimulationError> failure;  ///< Why the run ended early; the rows up to there are kept.
};

/// A read-only view of a column, which keeps its owner alive.
py::array_t<double> view(const std::vector<double>& column, const py::handle& owner);

/// Results as Python objects: a list of tuples (time, element, event, direction), and dictionaries.
py::list events_of(const Run& run);
py::object summary_of(const Run& run);
py::object certificate_of(const Run& run);

}  // namespace rheonet::python
