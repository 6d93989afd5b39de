#include "core/dae/node_positions.hpp"

#include <algorithm>

#include "core/base/index.hpp"
#include "core/dae/contacts.hpp"

namespace rheonet {

namespace {

double sum_of_positions(const Structure::TrainEquation& equation, const std::vector<double>& position) {
  double sum = position[at(equation.pivot)];
  for (const auto& [node, factor] : equation.terms) sum += factor * position[at(node)];
  return sum;
}

}  // namespace

void NodePositions::enter(const State& state, double* y) {
  offset_ = state.offset;
  for (std::size_t k = 0; k < slider_shift_.size(); ++k) {
    const Network::Slider& slider = network_.sliders[k];
    slider_shift_[k] = slider.contact ? rheonet::displacement(slider, state) : state.position[at(slider.branch.a)] - state.position[at(slider.branch.b)];
  }
  const std::vector<double> place = places(state);
  for (const NodeId node : positions_.order) {
    if (const int r = positions_.of[at(node)].train_equation; r >= 0) tied_sum_[at(r)] = sum_of_positions(structure_.train_equations[at(r)], place);
  }
  for (const NodeId node : positions_.integrated) {
    y[index_.position[at(node)]] = state.position[at(node)] - place[at(positions_.of[at(node)].parent)];
  }
}

/// Positions as the view computes them. The state lacks the position of a node that was not requested, but that another
/// position is counted from in these modes.
std::vector<double> NodePositions::places(const State& state) const {
  std::vector<double> place = state.position;
  for (std::size_t m = 0; m < network_.motions.size(); ++m) {
    if (network_.motions[m].block < 0) place[at(network_.motions[m].node)] = inputs_.position[m];
  }
  for (const NodeId node : positions_.order) {
    const Position& x = positions_.of[at(node)];
    if (x.integrated || x.branch < 0) continue;
    place[at(node)] = place[at(x.parent)] + x.sign * (state.p[at(x.branch)] + offset_[at(x.branch)]);
  }
  return place;
}

void NodePositions::evaluate(const std::vector<double>& p, const double* y, std::vector<double>& positions) const {
  for (std::size_t m = 0; m < network_.motions.size(); ++m) {
    if (network_.motions[m].block < 0) positions[at(network_.motions[m].node)] = inputs_.position[m];
  }
  for (NodeId node : positions_.order) {
    const Position& x = positions_.of[at(node)];
    double& position = positions[at(node)];
    const double parent = positions[at(x.parent)];
    if (x.integrated) {
      position = parent + y[index_.position[at(node)]];
    } else if (x.branch >= 0) {
      position = parent + x.sign * (p[at(x.branch)] + offset_[at(x.branch)]);
    } else if (x.slider >= 0) {
      position = parent + x.sign * slider_shift_[at(x.slider)];
    } else if (x.train_equation >= 0) {
      const Structure::TrainEquation& equation = structure_.train_equations[at(x.train_equation)];
      const auto own = std::find_if(equation.terms.begin(), equation.terms.end(), [&](const Structure::TrainEquation::Term& term) { return term.node == node; });
      const double factor = own == equation.terms.end() ? 1 : own->factor;
      position = 0;
      position = (tied_sum_[at(x.train_equation)] - sum_of_positions(equation, positions)) / factor;
    }
  }
}

}  // namespace rheonet
