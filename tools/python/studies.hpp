#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/result/model_hierarchy.hpp"
#include "core/result/sensitivities.hpp"
#include "core/result/work_precision.hpp"
#include "tools/python/reading.hpp"
#include "tools/rheonet/comparison.hpp"
#include "tools/rheonet/design.hpp"

/// The studies of the commands `compare`, `effects`, `precision` and `run --sensitivities` for Python. They raise rheonet.SimulationError if a
/// scene cannot be simulated, and ValueError if scenes cannot be compared.
namespace rheonet::python {

/// Scenes on one time base, and the difference of each from the first.
class Comparison {
 public:
  /// `pairings`: each has a record for each scene; empty: the records that all scenes share.
  Comparison(const std::vector<const Reading*>& readings, std::vector<tool::Pairing> pairings, const py::object& progress);

  const std::vector<tool::Pairing>& pairings() const { return compared_.pairings; }
  std::vector<std::string> units() const;
  /// Keywords of rheonet.Difference for each scene but the first and each pairing.
  py::list differences() const;
  std::vector<double> dissipated() const;
  py::array_t<double> time() const;
  /// The rows of a pairing: an array of shape (scenes, rows).
  py::array_t<double> rows(std::size_t pairing) const;
  std::string text() const;

 private:
  tool::Compared compared_;
};

/// The points of `rheonet sweep` with --random, --latin or --sobol. `vary` and `correlate` have the words after these options of the
/// command. Throws std::invalid_argument for words that the command refuses.
tool::Design drawn_points(const std::vector<std::string>& vary, const std::string& kind, long count, std::uint64_t seed,
                          const std::vector<std::string>& correlate);

/// The number in a text without reference to other values, in SI, and whether it has a unit; absent if the text is no number.
std::optional<std::pair<double, bool>> evaluated(const std::string& text);

/// The contribution of each physical effect.
class Effects {
 public:
  Effects(const Reading& reading, int runs, const py::object& progress);

  std::vector<std::string> effects() const;
  py::dict full() const { return model(ladder_.full); }
  py::list each() const { return models(ladder_.each); }
  py::list steps() const { return models(ladder_.steps); }
  /// Position in `steps` of the simplest model within `relative`.
  std::optional<std::size_t> barest(double relative) const;
  std::string text(std::optional<double> within) const;

 private:
  py::dict model(const Rung& rung) const;
  py::list models(const std::vector<Rung>& rungs) const;

  std::string file_;
  Scene scene_;
  ModelHierarchy ladder_;
};

/// CPU time over accuracy.
class Precision {
 public:
  struct Wanted {
    std::vector<double> accuracies;
    int runs = 5;
    bool variants = false, certified = false;
    std::vector<std::pair<std::string, const Reading*>> models;  ///< By name.
    std::vector<std::vector<std::string>> records;               ///< For each model one record for each record of the scene.
  };
  Precision(const Reading& reading, const Wanted& wanted, const py::object& progress);

  py::list prices() const;
  std::optional<std::size_t> cheapest() const { return place(list_.cheapest()); }
  std::optional<std::size_t> own() const { return place(list_.own(scene_)); }
  py::dict doubt() const;
  std::string text() const;

 private:
  std::optional<std::size_t> place(const Price* price) const;

  std::string file_;
  Scene scene_;
  PriceList list_;
};

/// The derivatives of all records by some values of the netlist.
class Sensitivities {
 public:
  /// `wanted`: how the scene is read. `paths`: values that can be multiplied.
  Sensitivities(Source& source, const Source::Wanted& wanted, std::vector<std::string> paths, std::optional<double> accuracy,
                const py::object& progress);

  py::array_t<double> time() const;
  /// p dr/dp of each value p, for the record r of this number: an array of shape (values, rows).
  py::array_t<double> rows(std::size_t record) const;
  /// For each value and each record a tuple: the largest magnitude of the derivative, its time [s], its estimated error.
  py::list largest() const;
  std::string text() const;

 private:
  py::ssize_t rows_of_all() const;

  std::vector<std::string> paths_;
  Reading reading_;
  std::vector<Sensitivity> derivatives_;
};

}  // namespace rheonet::python
