// Bounds of friction, and losses of gears, that follow blocks: parts of Inputs.
#include <functional>
#include <span>
#include <vector>

#include "core/base/index.hpp"
#include "core/dae/inputs.hpp"

namespace rheonet {

void Inputs::apply_blocks() {
  for (std::size_t k = 0; k < network_->motions.size(); ++k) {
    const Network::Motion& m = network_->motions[k];
    if (m.block < 0) continue;
    const Dual out = blocks_.out(m.block);
    velocity[k] = m.sign * out.value;
    acceleration[k] = m.sign * out.derivative;
  }
  for (std::size_t k = 0; k < network_->forces.size(); ++k) {
    const Network::Force& f = network_->forces[k];
    if (f.block < 0) continue;
    const Dual out = blocks_.out(f.block);
    force[k] = f.sign * out.value;
    force_rate[k] = f.sign * out.derivative;
  }
  for (const std::size_t k : varying_sliders_) {
    const Network::Slider& slider = network_->sliders[k];
    std::vector<Dual> values(slider.values.begin(), slider.values.end());
    for (const Network::VaryingParameter& v : slider.varying) {
      values[static_cast<std::size_t>(v.parameter)] = Dual(v.sign) * blocks_.out(v.block);
    }
    if (slider.train < 0) {
      box_[k] = slider.component->box(values);
      continue;
    }
    std::vector<double> present;
    for (const Dual& value : values) present.push_back(value.value);
    losses_[at(slider.train)] = loss_law(slider)(present);
    bound_losses(at(slider.train));
  }
}

bool Inputs::bounds_follow(std::size_t k, NodeId node) const {
  const std::vector<Network::VaryingParameter>& varying = network_->sliders[k].varying;
  return std::any_of(varying.begin(), varying.end(), [&](const Network::VaryingParameter& v) { return blocks_.follows_velocity(v.block, node); });
}

Box Inputs::supposed_box(std::size_t k, NodeId node, double velocity) {
  const Network::Slider& slider = network_->sliders[k];
  std::vector<int> blocks;
  for (const Network::VaryingParameter& v : slider.varying) blocks.push_back(v.block);
  const std::vector<Dual> outputs = blocks_.supposed(blocks, node, velocity);
  std::vector<Dual> values(slider.values.begin(), slider.values.end());
  for (std::size_t i = 0; i < outputs.size(); ++i) values[at(slider.varying[i].parameter)] = Dual(slider.varying[i].sign) * outputs[i];
  if (slider.train < 0) return slider.component->box(values);
  std::vector<double> present, slopes;
  for (const Dual& value : values) {
    present.push_back(value.value);
    slopes.push_back(value.derivative);
  }
  const Loss loss = loss_law(slider)(present), by = loss_law(slider)(slopes);
  const double force = train_force_[at(slider.train)];
  const auto lost = [&](int side) -> Bounds {
    const Loss::Line line = loss.slope(side, loss.b_drives(side, force), by);
    const double value = loss.lost(side, force);
    const Dual bound(value, value > 0 ? side * (line.factor * force + line.offset) : 0);
    return {bound, bound};
  };
  return {lost(1), lost(-1)};
}

const std::function<Loss(std::span<const double>)>& Inputs::loss_law(const Network::Slider& slider) const {
  return components()[at(network_->element_of(slider.branch).declaration)]->loss;
}

Loss::Line Inputs::loss_slope(std::size_t k, int side, bool b_drives, std::size_t which) const {
  const Network::Slider& slider = network_->sliders[k];
  std::vector<double> one(slider.values.size(), 0);
  one[at(slider.varying[which].parameter)] = slider.varying[which].sign;
  return losses_[at(slider.train)].slope(side, b_drives, loss_law(slider)(one));
}

void Inputs::bound_losses(std::size_t k) {
  const Network::Train& train = network_->trains[k];
  if (train.friction < 0) return;
  const Dual forward = losses_[k].lost(1, train_force_[k]), backward = losses_[k].lost(-1, train_force_[k]);
  box_[at(train.friction)] = {{forward, forward}, {backward, backward}};
}

void Inputs::bound_losses(const std::vector<double>& train_force) {
  train_force_ = train_force;
  for (std::size_t k = 0; k < network_->trains.size(); ++k) bound_losses(k);
}

double Inputs::sliding_slope(std::size_t k, int side, std::size_t which) const {
  const Network::Slider& slider = network_->sliders[k];
  std::vector<Dual> values(slider.values.begin(), slider.values.end());
  for (std::size_t i = 0; i < slider.varying.size(); ++i) {
    const Network::VaryingParameter& v = slider.varying[i];
    values[static_cast<std::size_t>(v.parameter)] = {v.sign * blocks_.out(v.block).value, i == which ? 1.0 : 0.0};
  }
  return slider.component->box(values).at(side).sliding.derivative;
}

}  // namespace rheonet
