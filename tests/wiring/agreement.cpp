#include "tests/wiring/agreement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rheonet::test {

namespace {

// Allowed multiple of the reference's estimated error, which is the change of the extrapolated value by the last halving of the step.
constexpr double of_error = 3;
// Values whose doubt exceeds this fraction of the record's scale are not judged.
constexpr double largest_doubt = 1e-3;
// A sticking element moves in the reference in proportion to the imbalance of its force, relative to the largest value of its kind. A
// record that consists only of such motion has no scale of its own.
constexpr double unstretched = 3e-8, nothing = 1e-4;
// The same for velocities, which are this motion divided by a short step.
constexpr double creeping = 2e-6;
// Smallest scale [m | m/s | N], for scenes of the catalogue in which nothing moves.
constexpr double least = 0.1;

std::size_t kind_of(const Record& record) {
  switch (record.channel) {
    case Record::Channel::velocity:
      return 0;
    case Record::Channel::force:
    case Record::Channel::out:
      return 1;
    case Record::Channel::position:
    case Record::Channel::displacement:
      break;
    default:  // These scenes have no other records.
      break;
  }
  return 2;
}

}  // namespace

Agreement agreement(const Scene& scene, const RunTable& rows, const ReferenceSolution& reference) {
  Agreement result;
  if (rows.header.empty()) return result;  // refused before the first row
  std::array<double, 3> largest{least, least, least};
  for (std::size_t k = 0; k < scene.records.size(); ++k) {
    double& kind = largest[kind_of(scene.records[k])];
    kind = std::max(kind, reference.columns[k].scale);
  }
  std::size_t count = std::min(rows.time().size(), reference.time.size());
  while (count > 0 && reference.time[count - 1] > reference.fork) --count;
  std::size_t all = 0, judged = 0;
  double fine = 0, coarse = 0;
  for (std::size_t k = 0; k < scene.records.size(); ++k) {
    const ReferenceSolution::Column& column = reference.columns[k];
    const std::vector<double>& found = rows[scene.records[k].path];
    const std::size_t kind = kind_of(scene.records[k]);
    const double most = largest[kind], left = (kind == 0 ? creeping : unstretched) * most, scale = std::max(column.scale, nothing * most);
    std::size_t here = 0;
    for (std::size_t i = 0; i < count; ++i) {
      ++all;
      const double doubt = of_error * column.error[i] + of_accuracy * scene.accuracy * scale + unstretched * most;
      if (!(doubt <= largest_doubt * scale)) continue;
      const double allowed = std::max(doubt, left);
      ++here;
      const double off = std::abs(found[i] - column.value[i]), before = std::abs(found[i] - column.coarse[i]);
      fine += std::pow(std::max(0.0, off - left) / scale, 2);
      coarse += std::pow(std::max(0.0, before - left) / scale, 2);
      const double part = allowed > 0 ? off / allowed : off > 0 ? HUGE_VAL : 0;
      if (part <= result.worst) continue;
      result.worst = part;
      result.deviation = off / scale;
      result.where = fmt::format("{} at row {}, t = {:.6g}: {:.9g}, the reference has {:.9g} +- {:.1e} (scale {:.3g})",
                                 scene.records[k].path, i, reference.time[i], found[i], column.value[i],
                                 column.error[i], scale);
    }
    judged += here;
    if (here == 0 && count > 0) result.unjudged = scene.records[k].path;
  }
  if (all > 0) result.judged = double(judged) / double(all);
  if (judged > 0) {
    result.from_fine = std::sqrt(fine / double(judged));
    result.from_coarse = std::sqrt(coarse / double(judged));
  }
  return result;
}

}  // namespace rheonet::test
