#include "core/dae/block_trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/format_list.hpp"

namespace rheonet {

bool BlockTrials::agree(State& state, const std::vector<double>& velocity, const std::string& refusal) {
  std::vector<std::size_t> varying;
  for (std::size_t k = 0; k < network_.sliders.size(); ++k) {
    if (!network_.sliders[k].varying.empty()) varying.push_back(k);
  }
  if (varying.empty() || network_.blocks.sensors.empty()) return true;
  const auto bounds = [&] {
    std::vector<double> result;
    for (const std::size_t k : varying) {
      const Box& box = inputs_.box(k);
      for (const Bounds& b : {box.forward, box.backward}) result.insert(result.end(), {b.sliding.value, b.breakaway.value});
    }
    return result;
  };
  const std::vector<double> before = bounds();
  State found = state;
  found.velocity = velocity;
  inputs_.settle_blocks(t_, found);
  inputs_.transmit(state.train_force);
  const std::vector<double> after = bounds();
  const auto agree = [](double one, double other) {
    return one == other || std::abs(one - other) <= numerics::balance_roundoff * std::max(std::abs(one), std::abs(other));
  };
  if (std::equal(before.begin(), before.end(), after.begin(), agree)) {
    state.blocks = found.blocks;
    return true;
  }
  if (++count_ > numerics::block_trials) {
    std::vector<std::string> names;
    for (const std::size_t k : varying) names.push_back("`" + network_.name_of(network_.sliders[k].branch) + "`");
    throw SimulationError(network_.spot_of(network_.sliders[varying.front()].branch.element), fmt::format(
        "{}: the bounds of {} depend on the motion, and none was found that fits them; start from given values, and give it time to settle", refusal, format_list(names)));
  }
  // The motion as one vector, each kind of quantity in units of its size.
  const auto as_vector = [&](const State& of) {
    Eigen::VectorXd result(static_cast<Eigen::Index>(of.velocity.size() + of.position.size() + of.p.size()));
    Eigen::Index i = 0;
    for (const std::vector<double>* list : {&of.velocity, &of.position, &of.p}) {
      for (const double x : *list) result[i++] = x;
    }
    return result;
  };
  const Eigen::VectorXd next = points_.next(as_vector(trial_), as_vector(found));
  trial_ = found;
  Eigen::Index i = 0;
  for (std::vector<double>* list : {&trial_.velocity, &trial_.position, &trial_.p}) {
    for (double& x : *list) x = next[i++];
  }
  inputs_.settle_blocks(t_, trial_);
  inputs_.transmit(state.train_force);
  return false;
}

}  // namespace rheonet
