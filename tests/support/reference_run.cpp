#include "tests/support/reference_run.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/base/index.hpp"

namespace rheonet::test {

namespace {

// A position step is a ramp of this part of the run, and "just after" an instant is as much later.
constexpr double instant = 1e-7;
constexpr int instant_steps = 8;

// A turn is located to this fraction of the step (see ReferenceRun::step): 2^-12. The number of searches in a run is limited, because
// round-off can look like endless turns.
constexpr int bisections = 12;
constexpr int most_searches = 300;
constexpr int instant_bisections = 5;
// A turn is not located in steps so short that this fraction of the forces is round-off.
constexpr double most_blur = 1e-8;
// A law that turns in every short step is at rest but for rounding: there is no instant to be found.
constexpr int most_halvings = 20 * bisections;

}  // namespace

ReferenceNetwork ReferenceRun::build() {
  std::vector<ReferenceNetwork::Node> nodes(scene_.nodes.size());
  nodes[0].prescribed = true;
  mass_.assign(nodes.size(), 0);
  std::vector<ReferenceNetwork::Gear> gears;
  for (std::size_t n = 1; n < nodes.size(); ++n) {
    if (!std::isnan(scene_.nodes[n].position)) nodes[n].position = scene_.nodes[n].position;
    if (!std::isnan(scene_.nodes[n].velocity)) nodes[n].velocity = scene_.nodes[n].velocity;
  }
  for (std::size_t k = 0; k < scene_.elements.size(); ++k) {
    const SceneElement& e = scene_.elements[k];
    const int index = static_cast<int>(k);
    if (type_of(e) == "motion") {
      const bool by_position = e.signal_parameters.at(0) == 0;
      motions_.push_back({e.signals.at(0), by_position, e.a, index, {}});
      nodes[at(e.a)].prescribed = true;
      nodes[at(e.a)].velocity = 0;
      if (by_position) nodes[at(e.a)].position = e.signals.at(0).before(scene_.start);
    } else if (type_of(e) == "force") {
      forces_.push_back({e.signals.at(0), e.a, e.at ? -1 : e.b, index, {}});
    } else if (type_of(e) == "mass") {
      masses_.push_back({e.values.at(0), e.a, index});
      nodes[at(e.a)].mass += e.values[0];
      mass_[at(e.a)] += e.values[0];
    } else if (const auto equation = transmission_equation(type_of(e), e)) {
      gear_of_[index] = gears.size();
      gears.push_back({.node = {e.a, e.b, e.support}, .factor = equation->factor, .equation = *equation});
    } else if (!ReferenceLaw::is_law(type_of(e))) {
      throw std::runtime_error("the reference integrator knows no " + type_of(e));
    }
  }
  std::vector<ReferenceBundle> bundles;
  const auto add = [&](NodeId a, NodeId b, ReferenceLaw law, std::size_t element) {
    auto found = std::find_if(bundles.begin(), bundles.end(), [&](const ReferenceBundle& bundle) {
      return (bundle.a == a && bundle.b == b) || (bundle.a == b && bundle.b == a);
    });
    if (found == bundles.end()) found = bundles.insert(found, ReferenceBundle(a, b));
    found->add({std::move(law), found->a == a ? 1.0 : -1.0, static_cast<int>(element)});
    return std::pair{std::size_t(found - bundles.begin()), found->members().size() - 1};
  };
  for (std::size_t k = 0; k < scene_.elements.size(); ++k) {
    const SceneElement& e = scene_.elements[k];
    if (const auto gear = gear_of_.find(static_cast<int>(k)); gear != gear_of_.end() && gears[gear->second].equation.lossy()) {
      ReferenceLaw friction = ReferenceLaw::loss();
      const auto [low, high] = gears[gear->second].equation.friction(0);
      friction.set_range({low, high});
      const auto [bundle, member] = add(e.a, e.support, std::move(friction), k);
      gears[gear->second].friction = {bundle, member};
    }
    if (!ReferenceLaw::is_law(type_of(e))) continue;
    const double displacement = nodes[at(e.a)].position - nodes[at(e.b)].position;
    law_of_[static_cast<int>(k)] = add(e.a, e.b, ReferenceLaw(e, *declarations_[at(e.declaration)], displacement), k);
    if (!e.signals.empty()) varying_.push_back({&e, law_of_[static_cast<int>(k)].first, law_of_[static_cast<int>(k)].second, {}});
  }
  acceleration_.assign(nodes.size(), 0);
  applied_.assign(nodes.size(), 0);
  return ReferenceNetwork(std::move(nodes), std::move(bundles), std::move(gears));
}

double ReferenceRun::row_time(std::int64_t k) const {
  const double t = scene_.start + static_cast<double>(k) * scene_.output_every;
  return std::abs(t - scene_.stop) <= 1e-9 * scene_.output_every ? scene_.stop : t;
}

double ReferenceRun::next_break() const {
  double next = scene_.stop;
  for (const Motion& m : motions_) next = std::min(next, m.piece.end);
  for (const Force& f : forces_) next = std::min(next, f.piece.end);
  for (const Varying& v : varying_) {
    for (const Piece& piece : v.pieces) next = std::min(next, piece.end);
  }
  return next;
}

/// Steps from the present time to `to`, on the present stretches of the signals.
bool ReferenceRun::advance(double to, int least_steps) {
  const double from = t_, length = to - from;
  if (length <= 0) return true;
  const int n = std::max(least_steps, static_cast<int>(std::ceil(length / h_ - 1e-9))) * refinement_;
  for (int k = 0; k < n; ++k) {
    if (!whole_step(k + 1 == n ? to : from + (k + 1) * (length / n))) return false;
  }
  return true;
}

bool ReferenceRun::turned_near(double t, double distance) const {
  const auto next = std::lower_bound(turns_.begin(), turns_.end(), t - distance);
  return next != turns_.end() && *next <= t + distance;
}

ReferenceNetwork::Input ReferenceRun::input(double before, double after) const {
  const std::size_t nodes = scene_.nodes.size();
  ReferenceNetwork::Input input;
  input.h = after - before;
  input.displacement.assign(nodes, 0);
  input.velocity.assign(nodes, 0);
  input.applied.assign(nodes, 0);
  for (const Motion& m : motions_) {
    const Piece& p = m.piece;
    input.displacement[at(m.node)] = m.by_position ? p.value(after) - p.value(before) : p.integral(before, after);
    input.velocity[at(m.node)] = m.by_position ? p.rate(after) : p.value(after);
  }
  for (const Force& f : forces_) {
    input.applied[at(f.a)] += f.piece.value(after);
    if (f.b >= 0) input.applied[at(f.b)] -= f.piece.value(after);
  }
  input.bounds = bounds(after);
  return input;
}

/// Bounds of the sliders whose bounds vary, on the present stretches of the signals.
std::vector<ReferenceNetwork::Input::Bound> ReferenceRun::bounds(double t) const {
  std::vector<ReferenceNetwork::Input::Bound> result;
  for (const Varying& v : varying_) {
    auto piece = v.pieces.begin();
    result.push_back({v.bundle, v.member, slider_bounds(*v.element, [&](const Signal&) { return (piece++)->value(t); })});
  }
  return result;
}

/// One step to `after`. Velocities are means over it, those of its middle: a turn in its second half shows in the next
/// step only, right at its beginning. Then both are done again.
bool ReferenceRun::whole_step(double after) {
  const Start start{t_, network_};
  const double shortest = std::ldexp(after - start.time, -bisections);
  const std::size_t turns = turns_.size();
  const int searches = searches_;
  first_turn_.reset();
  bool done = step(after, bisections, 0);
  if (!done && !first_turn_) first_turn_ = Step{t_, shortest};
  if (first_turn_ && first_turn_->from <= start.time + 0.5 * shortest && last_ && searches_ > searches) {
    const double ahead = first_turn_->length;
    turns_.resize(turns);
    network_ = last_->network;
    t_ = last_->time;
    done = step(start.time, bisections, ahead) && step(after, bisections, 0);
  }
  if (turns_.size() > turns) {
    last_.reset();
  } else {
    last_ = start;
  }
  return done;
}

void ReferenceRun::note_turn(double from, double to) {
  turns_.push_back(to);
  // The shortest steps may have been too short to show it: it lies anywhere in the first one that does.
  if (!first_turn_ || from < first_turn_->from) first_turn_ = Step{from, to - from};
}

/// True if a law turns in a short step from now on.
bool ReferenceRun::turns_ahead(double ahead) const {
  if (ahead == 0) return false;
  ReferenceNetwork network = network_;
  return !network.step(input(t_, t_ + ahead)) || network.turned_since(network_);
}

/// One step to `after`. A step in which a law turns is bisected until the instant is located. Otherwise the error would be of the order of
/// the step and depend on the position of the instant in it, which extrapolation cannot remove. With `ahead`, a turn that a step of that
/// length shows after this one counts as a turn in this one.
bool ReferenceRun::step(double after, int depth, double ahead) {
  const double before = t_, h = after - before;
  if (depth == bisections) halvings_ = 0;
  // The steps of a jump are short already: rounding would be all that is found.
  if (at_instant_ && depth < bisections - instant_bisections) depth = 0;
  if (halvings_ >= most_halvings || (depth == bisections && searches_ >= most_searches)) depth = 0;
  const ReferenceNetwork start = network_;
  const ReferenceNetwork::Input given = input(before, after);
  const bool done = network_.step(given);
  t_ = after;
  if (done && network_.blur() > most_blur) depth = 0;
  if (depth > 0 && (!done || network_.turned_since(start) || turns_ahead(ahead))) {
    const ReferenceNetwork whole = network_;
    network_ = start;
    t_ = before;
    if (depth == bisections) ++searches_;
    ++halvings_;
    if (!step(before + h / 2, depth - 1, ahead) || !step(after, depth - 1, ahead)) return false;
    // A motion may be too slow to be told from rounding in the shortest steps.
    if (done && network_.follow(whole, start)) note_turn(before, after);
    return true;
  }
  if (!done) {
    network_ = start;
    t_ = before;
    return false;
  }
  if (network_.turned_since(start)) note_turn(before, after);
  if ((network_.forked() && !start.forked()) || network_.could_slip_on(start)) fork_ = std::min(fork_, before);
  for (std::size_t i = 0; i < acceleration_.size(); ++i) {
    acceleration_[i] = network_.nodes()[i].acceleration;
  }
  for (const Motion& m : motions_) acceleration_[at(m.node)] = m.by_position ? m.piece.curvature(after) : m.piece.rate(after);
  applied_ = given.applied;
  return true;
}

/// Prescribed nodes move by `steps` in no time, all else goes on as it is.
bool ReferenceRun::jump(const std::vector<double>& steps) {
  if (std::all_of(steps.begin(), steps.end(), [](double x) { return x == 0; })) return true;
  const int n = instant_steps * refinement_;
  ReferenceNetwork::Input input;
  input.h = instant * (scene_.stop - scene_.start) / n;
  input.applied = applied_;
  input.bounds = bounds(t_);
  input.displacement = steps;
  for (double& x : input.displacement) x /= n;
  input.velocity = input.displacement;
  for (double& x : input.velocity) x /= input.h;
  for (int k = 0; k < n; ++k) {
    network_.begin();
    if (!network_.step(input)) return false;
  }
  network_.begin();
  return true;
}

/// Switches to the pieces of the signals that begin at t.
bool ReferenceRun::enter(double t) {
  last_.reset();
  std::vector<double> steps(scene_.nodes.size(), 0);
  for (Motion& m : motions_) {
    m.piece = m.signal.piece(t);
    if (!m.by_position) continue;
    const double position = network_.nodes()[at(m.node)].position, step = m.piece.value(t) - position;
    if (std::abs(step) > 1e-9 * (std::abs(position) + std::abs(m.piece.value(t)))) steps[at(m.node)] = step;
  }
  for (Force& f : forces_) f.piece = f.signal.piece(t);
  for (Varying& v : varying_) {
    v.pieces.clear();
    for (const Signal& signal : v.element->signals) v.pieces.push_back(signal.piece(t));
  }
  return jump(steps);
}

bool ReferenceRun::go() {
  const double slack = 1e-9 * scene_.output_every;
  std::int64_t row = 0;
  t_ = scene_.start;
  bool at_break = true;
  for (;;) {
    if (at_break) {
      if (!enter(t_)) return false;
      if (row <= scene_.output_intervals && row_time(row) <= t_ + slack) {
        // The row holds the values just after the instant.
        const double just_after = std::min(scene_.stop, t_ + instant * (scene_.stop - scene_.start));
        const double before = t_ + (just_after - t_) / instant_steps;
        at_instant_ = true;
        if (just_after > t_ && !advance(before, 1)) return false;
        const std::vector<double> early = values();
        if (just_after > t_ && !advance(just_after, instant_steps - 1)) return false;
        at_instant_ = false;
        record(&early);
        ++row;
      }
    } else if (row <= scene_.output_intervals && row_time(row) <= t_ + slack) {
      record();
      ++row;
    }
    if (t_ >= scene_.stop) return true;
    const double next = next_break();
    const double to = row <= scene_.output_intervals ? std::min(next, row_time(row)) : next;
    at_break = next <= to + slack && next < scene_.stop;
    if (!advance(at_break ? next : to, 1)) return false;
  }
}

double ReferenceRun::element_force(int element) const {
  if (const auto found = law_of_.find(element); found != law_of_.end()) {
    return network_.bundles()[found->second.first].members()[found->second.second].law.force();
  }
  if (const auto found = gear_of_.find(element); found != gear_of_.end()) {
    const ReferenceNetwork::Gear& gear = network_.gears()[found->second];
    return gear.force + (gear.friction ? network_.bundles()[gear.friction->bundle].members()[gear.friction->member].law.force() : 0);
  }
  for (const Mass& m : masses_) {
    if (m.element == element) return m.mass * acceleration_[at(m.node)];
  }
  for (const Force& f : forces_) {
    if (f.element == element) return f.piece.value(t_);
  }
  for (const Motion& m : motions_) {
    if (m.element != element) continue;
    return network_.nodal_force(m.node) + mass_[at(m.node)] * acceleration_[at(m.node)] - applied_[at(m.node)];
  }
  return 0;
}

double ReferenceRun::force_of(const Record& record) const {
  if (record.subject == Record::Subject::element) return element_force(record.index);
  double sum = 0;
  for (const SceneAssembly::Term& term : scene_.assemblies[at(record.index)].force) {
    sum += term.sign * element_force(term.element);
  }
  return sum;
}

/// The records as they are now.
std::vector<double> ReferenceRun::values() const {
  std::vector<double> row;
  for (const Record& r : scene_.records) {
    if (r.channel == Record::Channel::force) {
      row.push_back(force_of(r));
      continue;
    }
    NodeId a = r.index, b = ground;
    if (r.subject == Record::Subject::element) a = scene_.elements[at(r.index)].a, b = scene_.elements[at(r.index)].b;
    if (r.subject == Record::Subject::assembly) {
      a = scene_.assemblies[at(r.index)].a, b = scene_.assemblies[at(r.index)].b;
    }
    const ReferenceNetwork::Node &from = network_.nodes()[at(a)], &to = network_.nodes()[at(b)];
    row.push_back(r.channel == Record::Channel::velocity ? from.velocity - to.velocity : from.position - to.position);
  }
  return row;
}

/// A row just after an instant is a little late for it: what changes between `early` in that time and now is in doubt.
void ReferenceRun::record(const std::vector<double>* early) {
  rows_.push_back(values());
  late_.emplace_back(rows_.back().size(), 0);
  for (std::size_t k = 0; early && k < early->size(); ++k) late_.back()[k] = std::abs(rows_.back()[k] - (*early)[k]);
  open_.push_back(network_.ambiguous());
  pieces_.emplace_back();
  for (const ReferenceBundle& b : network_.bundles()) {
    for (const ReferenceBundle::Member& m : b.members()) pieces_.back().push_back(m.law.piece());
  }
}

}  // namespace rheonet::test
