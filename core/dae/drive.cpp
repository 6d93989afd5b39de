#include "core/dae/drive.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rheonet {

Drive::Drive(const Network& network, double start, const std::vector<double>& positions) {
  for (const Network::Motion& m : network.motions) {
    Motion motion{.signal = m.signal, .by_position = m.position, .piece = {}};
    motion.anchor_time = start;
    motion.anchor = m.position ? m.signal.before(start) : positions[static_cast<std::size_t>(m.node)];
    // Until the first `enter` the node rests where it was before the run.
    motion.piece.level = m.position ? motion.anchor : 0;
    motions_.push_back(std::move(motion));
  }
  for (const Network::Force& f : network.forces) forces_.push_back({f.signal, {}});
  position.resize(motions_.size());
  velocity = acceleration = steps_ = position;
  force.resize(forces_.size());
  force_rate = force;
  time_ = std::numeric_limits<double>::quiet_NaN();
}

double Drive::position_of(const Motion& m, double t) const {
  return m.by_position ? m.piece.value(t) : m.anchor + m.piece.integral(m.anchor_time, t);
}

void Drive::enter(double t) {
  next_break_ = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    Motion& m = motions_[i];
    const double before = position_of(m, t);
    m.anchor = before;
    m.anchor_time = t;
    m.piece = m.signal.piece(t);
    const double step = position_of(m, t) - before;
    // A corner of a position signal leaves a difference of rounding, which is no step.
    steps_[i] = std::abs(step) <= 1e-13 * (std::abs(before) + std::abs(m.piece.value(t))) ? 0 : step;
    next_break_ = std::min(next_break_, m.piece.end);
  }
  for (Force& f : forces_) {
    f.piece = f.signal.piece(t);
    next_break_ = std::min(next_break_, f.piece.end);
  }
  time_ = std::numeric_limits<double>::quiet_NaN();
}

void Drive::evaluate(double t) {
  if (t == time_) return;
  time_ = t;
  for (std::size_t i = 0; i < motions_.size(); ++i) {
    const Motion& m = motions_[i];
    position[i] = position_of(m, t);
    velocity[i] = m.by_position ? m.piece.rate(t) : m.piece.value(t);
    acceleration[i] = m.by_position ? m.piece.curvature(t) : m.piece.rate(t);
  }
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    force[i] = forces_[i].piece.value(t);
    force_rate[i] = forces_[i].piece.rate(t);
  }
}

double Drive::fastest() const {
  double omega = 0;
  const auto look = [&](const Piece& p) {
    if (p.amplitude != 0) omega = std::max(omega, std::abs(p.omega) + std::sqrt(std::abs(p.chirp)));
  };
  for (const Motion& m : motions_) look(m.piece);
  for (const Force& f : forces_) look(f.piece);
  return omega;
}

}  // namespace rheonet
