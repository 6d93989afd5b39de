#include "tests/support/reference_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>

#include "tests/support/reference_step.hpp"

namespace rheonet::test {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// A position step is a ramp of this part of the run, and "just after" an instant is as much later.
constexpr double instant = 1e-7;
constexpr int instant_steps = 8;

// A turn is known to this part of the step (see Run::step): 2^-12. So many are sought in a run, lest rounding that looks
// like turns without end takes all the time.
constexpr int bisections = 12;
constexpr int most_searches = 300;

// Implicit Euler is late, or early, for a turn by a few steps; what comes between has another side of the corner.
constexpr double late = 6;

// So many rows before and after have a say in the error of one.
constexpr std::size_t around = 2;

/// One run with steps of a given length.
class Run {
 public:
  Run(const Scene& scene, Declarations declarations, int steps, int refinement)
      : scene_(scene), declarations_(declarations), h_((scene.stop - scene.start) / steps), refinement_(refinement),
        network_(build()) {}

  bool go();
  const std::vector<std::vector<double>>& rows() const { return rows_; }
  const std::vector<char>& open() const { return open_; }
  const std::vector<std::vector<double>>& late() const { return late_; }
  /// For each row, the pieces of its laws' maps that the network is on.
  const std::vector<std::vector<ReferenceLaw::Piece>>& pieces() const { return pieces_; }
  /// True if a law turned within `distance` of t.
  bool turned_near(double t, double distance) const {
    const auto next = std::lower_bound(turns_.begin(), turns_.end(), t - distance);
    return next != turns_.end() && *next <= t + distance;
  }
  double end() const { return t_; }

 private:
  struct Motion { Signal signal; bool by_position; NodeId node; int element; Piece piece; };
  struct Force { Signal signal; NodeId a, b; int element; Piece piece; };
  struct Mass { double mass; NodeId node; int element; };

  const std::string& type_of(const SceneElement& e) const { return declarations_[at(e.declaration)]->type; }
  ReferenceNetwork build();
  bool enter(double t);
  bool advance(double to, int least_steps);
  bool step(double after, int depth);
  bool jump(const std::vector<double>& steps);
  double next_break() const;
  double row_time(std::int64_t k) const;
  std::vector<double> values() const;
  void record(const std::vector<double>* early = nullptr);
  double element_force(int element) const;
  double force_of(const Record& record) const;

  const Scene& scene_;
  Declarations declarations_;
  double h_;
  int refinement_;
  std::vector<Motion> motions_;
  std::vector<Force> forces_;
  std::vector<Mass> masses_;
  std::map<int, std::pair<std::size_t, std::size_t>> law_of_;  ///< element: bundle, member
  std::vector<double> mass_;          ///< of each node
  std::vector<double> acceleration_;  ///< of each node, at the end of the last step
  std::vector<double> applied_;
  std::vector<std::vector<double>> rows_;
  std::vector<std::vector<double>> late_;  ///< for each row, what it changes by in the time that it is late
  std::vector<char> open_;
  std::vector<std::vector<ReferenceLaw::Piece>> pieces_;
  double t_ = 0;
  int searches_ = 0;
  std::vector<double> turns_;  ///< when they were [s]
  ReferenceNetwork network_;  ///< last, because it is built from what is above
};

ReferenceNetwork Run::build() {
  std::vector<ReferenceNetwork::Node> nodes(scene_.nodes.size());
  nodes[0].prescribed = true;
  mass_.assign(nodes.size(), 0);
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
    } else if (!ReferenceLaw::is_law(type_of(e))) {
      throw std::runtime_error("the reference integrator knows no " + type_of(e));
    }
  }
  std::vector<ReferenceBundle> bundles;
  for (std::size_t k = 0; k < scene_.elements.size(); ++k) {
    const SceneElement& e = scene_.elements[k];
    if (!ReferenceLaw::is_law(type_of(e))) continue;
    auto found = std::find_if(bundles.begin(), bundles.end(), [&](const ReferenceBundle& b) {
      return (b.a == e.a && b.b == e.b) || (b.a == e.b && b.b == e.a);
    });
    if (found == bundles.end()) found = bundles.insert(found, ReferenceBundle(e.a, e.b));
    const double displacement = nodes[at(e.a)].position - nodes[at(e.b)].position;
    law_of_[static_cast<int>(k)] = {std::size_t(found - bundles.begin()), found->members().size()};
    found->add({ReferenceLaw(e, *declarations_[at(e.declaration)], displacement), found->a == e.a ? 1.0 : -1.0,
                static_cast<int>(k)});
  }
  acceleration_.assign(nodes.size(), 0);
  applied_.assign(nodes.size(), 0);
  return ReferenceNetwork(std::move(nodes), std::move(bundles));
}

double Run::row_time(std::int64_t k) const {
  const double t = scene_.start + static_cast<double>(k) * scene_.output_every;
  return std::abs(t - scene_.stop) <= 1e-9 * scene_.output_every ? scene_.stop : t;
}

double Run::next_break() const {
  double next = scene_.stop;
  for (const Motion& m : motions_) next = std::min(next, m.piece.end);
  for (const Force& f : forces_) next = std::min(next, f.piece.end);
  return next;
}

/// Steps from the present time to `to`, on the present stretches of the signals.
bool Run::advance(double to, int least_steps) {
  const double from = t_, length = to - from;
  if (length <= 0) return true;
  const int n = std::max(least_steps, static_cast<int>(std::ceil(length / h_ - 1e-9))) * refinement_;
  for (int k = 0; k < n; ++k) {
    if (!step(k + 1 == n ? to : from + (k + 1) * (length / n), bisections)) return false;
  }
  return true;
}

/// One step to `after`. A step in which a law turns is halved, and so on, until the instant is known well: else the error
/// would be as large as the step and depend on where in it the instant lies, and could not be extrapolated away.
bool Run::step(double after, int depth) {
  const double before = t_, h = after - before;
  const std::size_t nodes = scene_.nodes.size();
  ReferenceNetwork::Input input;
  input.h = h;
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
  if (depth == bisections && searches_ >= most_searches) depth = 0;
  const ReferenceNetwork start = network_;
  const bool done = network_.step(input);
  if (depth > 0 && (!done || network_.turned_since(start))) {
    const ReferenceNetwork whole = network_;
    network_ = start;
    if (depth == bisections) ++searches_;
    if (!step(before + h / 2, depth - 1) || !step(after, depth - 1)) return false;
    // A motion may be too slow to be told from rounding in the shortest steps.
    if (done) network_.follow(whole, start);
    return true;
  }
  if (!done) {
    network_ = start;
    return false;
  }
  if (network_.turned_since(start)) turns_.push_back(after);
  for (std::size_t i = 0; i < nodes; ++i) {
    acceleration_[i] = (network_.nodes()[i].velocity - start.nodes()[i].velocity) / h;
  }
  for (const Motion& m : motions_) acceleration_[at(m.node)] = m.by_position ? m.piece.curvature(after) : m.piece.rate(after);
  applied_ = input.applied;
  t_ = after;
  return true;
}

/// Prescribed nodes move by `steps` in no time, all else goes on as it is.
bool Run::jump(const std::vector<double>& steps) {
  if (std::all_of(steps.begin(), steps.end(), [](double x) { return x == 0; })) return true;
  const int n = instant_steps * refinement_;
  ReferenceNetwork::Input input;
  input.h = instant * (scene_.stop - scene_.start) / n;
  input.applied = applied_;
  input.displacement = steps;
  for (double& x : input.displacement) x /= n;
  input.velocity = input.displacement;
  for (double& x : input.velocity) x /= input.h;
  for (int k = 0; k < n; ++k) {
    if (!network_.step(input)) return false;
  }
  return true;
}

/// Goes over to the stretches of the signals that begin at t.
bool Run::enter(double t) {
  std::vector<double> steps(scene_.nodes.size(), 0);
  for (Motion& m : motions_) {
    m.piece = m.signal.piece(t);
    if (!m.by_position) continue;
    const double position = network_.nodes()[at(m.node)].position, step = m.piece.value(t) - position;
    if (std::abs(step) > 1e-9 * (std::abs(position) + std::abs(m.piece.value(t)))) steps[at(m.node)] = step;
  }
  for (Force& f : forces_) f.piece = f.signal.piece(t);
  return jump(steps);
}

bool Run::go() {
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
        if (just_after > t_ && !advance(before, 1)) return false;
        const std::vector<double> early = values();
        if (just_after > t_ && !advance(just_after, instant_steps - 1)) return false;
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

double Run::element_force(int element) const {
  if (const auto found = law_of_.find(element); found != law_of_.end()) {
    return network_.bundles()[found->second.first].members()[found->second.second].law.force();
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

double Run::force_of(const Record& record) const {
  if (record.subject == Record::Subject::element) return element_force(record.index);
  double sum = 0;
  for (const SceneAssembly::Term& term : scene_.assemblies[at(record.index)].force) {
    sum += term.sign * element_force(term.element);
  }
  return sum;
}

/// The records as they are now.
std::vector<double> Run::values() const {
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
void Run::record(const std::vector<double>* early) {
  rows_.push_back(values());
  late_.emplace_back(rows_.back().size(), 0);
  for (std::size_t k = 0; early && k < early->size(); ++k) late_.back()[k] = std::abs(rows_.back()[k] - (*early)[k]);
  open_.push_back(network_.ambiguous());
  pieces_.emplace_back();
  for (const ReferenceBundle& b : network_.bundles()) {
    for (const ReferenceBundle::Member& m : b.members()) pieces_.back().push_back(m.law.piece());
  }
}

}  // namespace

ReferenceSolution integrate_reference(const Scene& scene, Declarations declarations,
                                      const ReferenceSettings& settings) {
  using Rows = std::vector<std::vector<double>>;
  ReferenceSolution result;
  const std::size_t columns = scene.records.size();
  result.columns.resize(columns);
  std::vector<std::unique_ptr<Run>> all;
  std::vector<Rows> runs, second, third;  // one for each halving: as computed; extrapolated once; twice
  const auto extrapolate = [&](const std::vector<Rows>& from, double factor) {
    const Rows &fine = from.back(), &coarse = from[from.size() - 2];
    Rows better(std::min(fine.size(), coarse.size()), std::vector<double>(columns));
    for (std::size_t i = 0; i < better.size(); ++i) {
      for (std::size_t k = 0; k < columns; ++k) better[i][k] = fine[i][k] + (fine[i][k] - coarse[i][k]) / (factor - 1);
    }
    return better;
  };
  // Largest change of a record by the last halving.
  const auto change = [&](const std::vector<Rows>& solutions, std::size_t k) {
    const Rows &fine = solutions.back(), &coarse = solutions[solutions.size() - 2];
    double largest = 0;
    for (std::size_t i = 0; i < std::min(fine.size(), coarse.size()); ++i) {
      largest = std::max(largest, std::abs(fine[i][k] - coarse[i][k]));
    }
    return largest;
  };
  for (int halving = 0; halving <= settings.halvings; ++halving) {
    all.push_back(std::make_unique<Run>(scene, declarations, settings.base_steps, 1 << halving));
    const Run& run = *all.back();
    result.complete = all.back()->go();
    result.end = run.end();
    result.steps = settings.base_steps << halving;
    runs.push_back(run.rows());
    if (halving >= 1) second.push_back(extrapolate(runs, 2));
    if (halving >= 2) third.push_back(extrapolate(second, 4));
    if (halving < 2) continue;
    bool good = halving >= 3 || settings.halvings < 3;
    std::size_t common = runs.back().size();
    for (const Rows& rows : runs) common = std::min(common, rows.size());
    result.time.resize(common);
    // Rows at a turn: there is nothing to extrapolate if it comes before the row with one step and after it with another.
    std::vector<char> turning(common, 0);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < common; ++i) {
      result.time[i] = std::min(scene.start + static_cast<double>(i) * scene.output_every, scene.stop);
      for (std::size_t j = all.size() - 3; j < all.size(); ++j) {
        const double h = (scene.stop - scene.start) / settings.base_steps / (1 << (halving - 2));
        if (all[j]->pieces()[i] != run.pieces()[i] || all[j]->turned_near(result.time[i], late * h)) turning[i] = 1;
      }
      if (turning[i]) ++lost;
    }
    good = good && 10 * lost <= common;
    for (std::size_t k = 0; k < columns; ++k) {
      // Where the solution is smooth the third order is better, where it has corners the second may be.
      const bool smooth = third.size() >= 2 && change(third, k) < change(second, k);
      const std::vector<Rows>& solutions = smooth ? third : second;
      const Rows &fine = solutions.back(), &coarse = solutions[solutions.size() - 2];
      ReferenceSolution::Column& column = result.columns[k];
      column.value = column.before = column.error = std::vector<double>(common);
      column.scale = 0;
      for (std::size_t i = 0; i < common; ++i) column.scale = std::max(column.scale, std::abs(fine[i][k]));
      for (std::size_t i = 0; i < common; ++i) {
        column.value[i] = fine[i][k];
        column.before[i] = coarse[i][k];
        column.error[i] = std::abs(fine[i][k] - coarse[i][k]);
        // Two solutions may agree by chance: what the halving before changed counts too, by the quarter that it should.
        if (solutions.size() > 2) {
          const Rows& coarsest = solutions[solutions.size() - 3];
          column.error[i] = std::max(column.error[i], std::abs(coarse[i][k] - coarsest[i][k]) / 4);
        }
        // Beyond a corner that the extrapolation has smoothed over, what it gains by its order is not to be trusted.
        if (!third.empty()) {
          column.error[i] = std::max(column.error[i], std::abs(third.back()[i][k] - second.back()[i][k]));
        }
      }
      // The difference of two solutions changes its sign now and then, and is no measure of their error there.
      const std::vector<double> alone = column.error;
      for (std::size_t i = 0; i < common; ++i) {
        for (std::size_t j = i - std::min(i, around); j < std::min(common, i + around + 1); ++j) {
          column.error[i] = std::max(column.error[i], alone[j]);
        }
        good = good && (turning[i] || column.error[i] <= settings.target * column.scale);
        column.error[i] += run.late()[i][k];
        if (turning[i]) column.error[i] = INFINITY;
        if (scene.records[k].channel == Record::Channel::force && run.open()[i]) column.error[i] = INFINITY;
      }
    }
    if (good) break;
  }
  return result;
}

}  // namespace rheonet::test
