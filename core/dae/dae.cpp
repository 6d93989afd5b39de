#include "core/dae/dae.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/dae/contacts.hpp"

namespace rheonet {

namespace {

/// Whether an input acts on an algebraic unknown at once. `varying`: the sliders whose forces vary.
bool any_follows_time(const Network& network, const Structure& structure, const UnknownIndices& index, const std::vector<std::size_t>& varying) {
  const auto moves = [&](NodeId node) { return structure.motion[at(node)] >= 0; };
  // Its velocity is an unknown that no equation differentiates.
  const auto at_once = [&](NodeId node) { return index.velocity[at(node)] >= 0 && structure.kind[at(node)] != Kind::massive; };
  const auto pulled = [&](const Branch& b) { return (moves(b.a) && at_once(b.b)) || (moves(b.b) && at_once(b.a)); };
  const auto pushed = [&](const Network::Force& f) {
    return at_once(structure.rigid[at(f.a)]) || (f.b >= 0 && at_once(structure.rigid[at(f.b)]));
  };
  const auto rubbed = [&](std::size_t k) {
    const Branch& b = structure.sliders[k];
    return b.a != b.b && (at_once(b.a) || at_once(b.b));
  };
  const auto turned = [&](const Structure::Tied& tied) {
    return std::any_of(tied.terms.begin(), tied.terms.end(), [&](const Structure::Tied::Term& term) { return moves(term.node); });
  };
  return std::any_of(structure.tied.begin(), structure.tied.end(), turned) ||
         std::any_of(structure.rates.begin(), structure.rates.end(), pulled) ||
         std::any_of(varying.begin(), varying.end(), rubbed) ||
         std::any_of(network.forces.begin(), network.forces.end(), pushed);
}

}  // namespace

Dae::Dae(const Network& network, const Structure& structure, Inputs& inputs, const std::vector<char>& needed)
    : network_(&network),
      structure_(&structure),
      inputs_(&inputs),
      stick_forces_(network, structure, inputs),
      inertia_(network, structure),
      positions_(find_positions(network, structure, needed)),
      index_(number_unknowns(network, structure, positions_, inputs.blocks().states())),
      sliding_modes_(network, structure, index_) {
  const std::size_t nodes = network.nodes(), nd = network.deflections.size(), nr = network.rates.size();
  for (const Laws<RateBatch>& laws : network.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) rough_ = rough_ || laws.batch->growth(i).exponent != 1;
  }
  rows_.reserve(structure.closing.size() + positions_.integrated.size());
  felt_terms_.resize(inputs.history().delayed().size());
  for (const int branch : structure.closing) add_row(index_.deflection[at(branch)], false, closed_loop(network, structure, branch));
  for (NodeId node : positions_.integrated) {
    add_row(index_.position[at(node)], true, minus_velocity(structure, node, positions_.of[at(node)].parent));
  }
  offset_.assign(nd, 0);
  driven_from_ = offset_;
  slip_force_.assign(network.sliders.size(), 0);
  slider_shift_ = slip_force_;
  tied_sum_.assign(structure.tied.size(), 0);
  slip_side_.assign(network.sliders.size(), 0);
  for (std::size_t k = 0; k < network.sliders.size(); ++k) {
    if (!structure.stuck[k] && !network.sliders[k].varying.empty()) varying_.push_back(k);
  }
  view_.slider_velocity = view_.slider_force = slip_force_;
  v_.assign(nodes, 0);
  a_.assign(nodes, 0);
  work_ = a_;
  rate_in_.assign(nr, 0);
  rate_out_ = rate_d_ = rate_in_;
  df_.assign(nd, 0);
  dc_ = df_;
  view_.train_force.assign(network.trains.size(), 0);
  loss_lines_.assign(network.trains.size(), {});
  b_drives_.assign(network.trains.size(), 0);
  train_forces_ = structure.train_forces;
  equations_ = structure.tied;
  if (std::any_of(varying_.begin(), varying_.end(), [&](std::size_t k) { return network.sliders[k].train >= 0; }) && !equations_.empty()) {
    std::vector<NodeId> sharing;
    for (const auto& [node, share] : equations_.front().shares) sharing.push_back(node);
    train_shares_.emplace(network, equations_, structure.rigid, std::move(sharing));
  }
  view_.velocity = view_.acceleration = view_.nodal = view_.applied = view_.position = v_;
  view_.p = view_.f = view_.creep = view_.flow = view_.dp = df_;
  view_.rate_velocity = view_.rate_force = rate_in_;
  build_pattern();
  loose_dashpots_ = LooseDashpots(network, structure, index_.force);
  follows_time_ = (inputs.fastest() > 0 || !network.blocks.blocks.empty()) && any_follows_time(network, structure, index_, varying_);
}

Dae::Terms Dae::add_terms(const Structure::Loop& loop) {
  Terms terms{.flow_begin = static_cast<int>(flows_.size()), .flow_end = 0,
              .velocity_begin = static_cast<int>(velocities_.size()), .velocity_end = 0};
  flows_.insert(flows_.end(), loop.flows.begin(), loop.flows.end());
  for (const Structure::Term& term : loop.velocities) {
    // The reference of a group has no velocity of its own.
    if (structure_->kind[at(term.index)] == Kind::known || index_.velocity[at(term.index)] >= 0) velocities_.push_back(term);
  }
  terms.flow_end = static_cast<int>(flows_.size());
  terms.velocity_end = static_cast<int>(velocities_.size());
  return terms;
}

void Dae::add_row(int row, bool position, const Structure::Loop& loop) {
  const Row r{.row = row, .position = position, .terms = add_terms(loop),
              .delayed = position ? -1 : inputs_->history().index_of(loop.branch)};
  if (r.delayed >= 0) {
    const DelayHistory::Delayed& delayed = inputs_->history().delayed()[at(r.delayed)];
    const Branch& b = structure_->deflections[at(loop.branch)];
    Structure::Loop now{.branch = -1, .flows = {}, .velocities = {}};
    if (delayed.free_a) now.velocities.push_back({b.a, -1});
    if (delayed.free_b) now.velocities.push_back({b.b, 1});
    felt_terms_[at(r.delayed)] = add_terms(now);
  }
  rows_.push_back(r);
}

/// The Jacobian's entries while the pattern is built, each identified by a ticket.
struct Dae::Drafts {
  PatternBuilder builder;
  std::vector<Constant> constants, masses;
  std::vector<Scatter> scatter;

  void put(int row, int column, double value) {
    if (column >= 0) constants.push_back({builder.ticket(row, column), value});
  }
  void put_mass(int row, int column, double mass) {
    if (mass != 0 && row >= 0 && column >= 0) masses.push_back({builder.ticket(row, column), mass});
  }
  void depend(int row, int column, Source source, int index, Sign sign) {
    if (row >= 0 && column >= 0) scatter.push_back({builder.ticket(row, column), index, source, sign});
  }
};

void Dae::build_pattern() {
  Drafts drafts;
  draft_balances(drafts);
  draft_rates(drafts);
  draft_rows(drafts);
  if (idle()) drafts.put_mass(0, 0, 1);
  for (const int z : index_.block) drafts.put_mass(z, z, 1);
  build_couplings(drafts.builder);
  share_balances_of_pivots(drafts);
  couple_shares(drafts.builder);
  sliding_modes_.reserve(drafts.builder);
  take_entries(drafts);
  update_holds();
}

/// Balances: a branch adds +f at its first node and -f at its second; a group's row is the sum over its nodes.
void Dae::draft_balances(Drafts& drafts) const {
  const auto balance_row = [&](NodeId node) { return index_.velocity[at(node)]; };
  const auto group_row = [&](NodeId node) { return index_.group_balance[at(node)]; };
  for (std::size_t j = 0; j < structure_->deflections.size(); ++j) {
    const Branch& b = structure_->deflections[j];
    if (b.a == b.b) continue;
    const int index = static_cast<int>(j);
    drafts.depend(balance_row(b.a), index_.deflection[j], Source::force, index, 1);
    drafts.depend(balance_row(b.b), index_.deflection[j], Source::force, index, -1);
    if (group_row(b.a) == group_row(b.b)) continue;  // within one group the two ends cancel
    drafts.depend(group_row(b.a), index_.deflection[j], Source::force, index, 1);
    drafts.depend(group_row(b.b), index_.deflection[j], Source::force, index, -1);
  }
  for (std::size_t n = 0; n < index_.velocity.size(); ++n) {
    if (structure_->kind[n] == Kind::massive) drafts.put_mass(index_.velocity[n], index_.velocity[n], structure_->mass[n]);
  }
  for (std::size_t k = 0; k < structure_->inerters.size(); ++k) {
    const Branch& b = structure_->inerters[k];
    if (b.a == b.b) continue;
    const double inertance = network_->inerters[k].inertance;
    for (const NodeId node : {b.a, b.b}) drafts.put_mass(index_.velocity[at(node)], index_.velocity[at(node)], inertance);
    drafts.put_mass(index_.velocity[at(b.a)], index_.velocity[at(b.b)], -inertance);
    drafts.put_mass(index_.velocity[at(b.b)], index_.velocity[at(b.a)], -inertance);
  }
}

void Dae::share_balances_of_pivots(Drafts& drafts) {
  if (equations_.empty()) return;
  std::map<int, std::size_t> of_row;  // the equation of each pivot's row
  for (std::size_t r = 0; r < equations_.size(); ++r) of_row.emplace(index_.velocity[at(equations_[r].pivot)], r);
  std::vector<Constant> masses;
  std::swap(masses, drafts.masses);
  for (const Constant& mass : masses) {
    const PatternBuilder::Place place = drafts.builder.places()[at(mass.entry)];
    const auto found = of_row.find(place.row);
    if (found == of_row.end()) {
      drafts.masses.push_back(mass);
      continue;
    }
    const std::vector<Structure::Tied::Term>& shares = equations_[found->second].shares;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      shared_masses_.push_back({drafts.builder.ticket(index_.velocity[at(shares[i].node)], place.column), found->second, i, mass.value});
    }
  }
  std::set<std::pair<int, int>> places;  // row and column
  for (const PatternBuilder::Place& place : drafts.builder.places()) {
    if (of_row.contains(place.row)) places.emplace(place.row, place.column);
  }
  for (const auto& [from, column] : places) {
    const std::size_t r = of_row.at(from);
    const std::vector<Structure::Tied::Term>& shares = equations_[r].shares;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      shared_entries_.push_back({drafts.builder.ticket(from, column), drafts.builder.ticket(index_.velocity[at(shares[i].node)], column), r, i});
    }
  }
  for (const auto& [row, r] : of_row) {
    tied_.push_back({drafts.builder.ticket(row, row), 1});
    for (const auto& [node, factor] : equations_[r].terms) {
      if (index_.velocity[at(node)] >= 0) tied_.push_back({drafts.builder.ticket(row, index_.velocity[at(node)]), factor});
    }
  }
}

/// Shares the balances of pivots, and writes the equations of the trains in their rows.
void Dae::tie(double* values) const {
  for (const SharedEntry& s : shared_entries_) values[s.to] -= equations_[s.equation].shares[s.share].factor * values[s.from];
  for (const int entry : pivot_entries_) values[entry] = 0;
  for (const Constant& c : tied_) values[c.entry] += c.value;
}

void Dae::draft_rates(Drafts& drafts) const {
  for (std::size_t r = 0; r < structure_->rates.size(); ++r) {
    const Branch& b = structure_->rates[r];
    if (b.a == b.b) continue;
    const int index = static_cast<int>(r);
    for (const Sign sign : {Sign{1}, Sign{-1}}) {
      const int row = index_.velocity[at(sign > 0 ? b.a : b.b)];
      if (row < 0) continue;
      if (index_.force[r] >= 0) {
        drafts.put(row, index_.force[r], sign);
      } else {
        drafts.depend(row, index_.velocity[at(b.a)], Source::rate, index, sign);
        drafts.depend(row, index_.velocity[at(b.b)], Source::rate, index, sign > 0 ? Sign{-1} : Sign{1});
      }
    }
    if (index_.force[r] >= 0) {
      drafts.put(index_.force[r], index_.velocity[at(b.a)], 1);
      drafts.put(index_.force[r], index_.velocity[at(b.b)], -1);
      drafts.depend(index_.force[r], index_.force[r], Source::rate, index, -1);
    }
  }
}

void Dae::draft_rows(Drafts& drafts) {
  for (const Row& row : rows_) {
    if (row.position) drafts.put_mass(row.row, row.row, 1);
    for (int k = row.terms.flow_begin; k < row.terms.flow_end; ++k) {
      const auto [j, sign] = flows_[at(k)];
      flow_entries_.push_back({drafts.builder.ticket(row.row, index_.deflection[at(j)]), j, sign});
      std::size_t i = 0;
      if (network_->batch_of(j, i).creeps(i)) creep_entries_.push_back({drafts.builder.ticket(row.row, index_.deflection[at(j)]), j, sign});
    }
    for (int k = row.terms.velocity_begin; k < row.terms.velocity_end; ++k) {
      drafts.put(row.row, index_.velocity[at(velocities_[at(k)].index)], velocities_[at(k)].sign);
    }
    if (row.delayed < 0) continue;
    const Terms& now = felt_terms_[at(row.delayed)];
    for (int k = now.velocity_begin; k < now.velocity_end; ++k) {
      const auto [node, sign] = velocities_[at(k)];
      if (index_.velocity[at(node)] >= 0) felt_entries_.push_back({drafts.builder.ticket(row.row, index_.velocity[at(node)]), row.delayed, sign});
    }
  }
}

/// Builds the pattern, and replaces each ticket by its entry.
void Dae::take_entries(Drafts& drafts) {
  std::vector<int> entry;
  pattern_ = drafts.builder.build(size(), entry);
  drafts.builder = {};
  const auto take = [&](auto& list) {
    for (auto& item : list) item.entry = entry[at(item.entry)];
  };
  const auto copy = [&](auto& list) {
    take(list);
    return std::vector(list.begin(), list.end());  // without spare capacity
  };
  constants_ = copy(drafts.constants);
  masses_ = copy(drafts.masses);
  scatter_ = copy(drafts.scatter);
  flow_entries_ = copy(flow_entries_);
  take(shared_masses_);
  for (SharedEntry& s : shared_entries_) {
    s.from = entry[at(s.from)];
    s.to = entry[at(s.to)];
  }
  take(tied_);
  std::vector<char> of_pivot(at(size()), 0);
  for (const Structure::Tied& tied : structure_->tied) of_pivot[at(index_.velocity[at(tied.pivot)])] = 1;
  for (int e = 0; !structure_->tied.empty() && e < pattern_.entries(); ++e) {
    if (of_pivot[at(pattern_.row[at(e)])]) pivot_entries_.push_back(e);
  }
  take(creep_entries_);
  take(felt_entries_);
  take(couplings_);
  for (SlidingCoupling& c : sliding_couplings_) c.coupling.entry = entry[at(c.coupling.entry)];
  for (ShareCoupling& c : share_couplings_) c.coupling.entry = entry[at(c.coupling.entry)];
  sliding_modes_.take(pattern_, entry);
  std::vector<char> with_mass(at(pattern_.entries()), 0);
  for_each_mass([&](int e, double) { with_mass[at(e)] = 1; });
  const auto begin = [&](int column) { return with_mass.begin() + pattern_.column_start[at(column)]; };
  differentiated_.resize(at(size()));
  for (int i = 0; i < size(); ++i) {
    // Deflections are differentiated; the velocity of a massless node and the force of a dashpot are not.
    const bool deflection = i >= index_.deflections_begin && i < index_.deflections_end;
    differentiated_[at(i)] = deflection || std::any_of(begin(i), begin(i + 1), [](char mass) { return mass != 0; });
  }
}

void Dae::enter(double t, const State& state, const Modes& modes, std::vector<double>& y) {
  set_rate_forms();
  update_holds();
  inputs_->evaluate(t);
  offset_ = state.offset;
  b_drives_ = modes.b_drives;
  for (std::size_t k = 0; k < slip_force_.size(); ++k) {
    const Branch& b = network_->sliders[k].branch;
    slip_side_[k] = structure_->stuck[k] ? static_cast<signed char>(Modes::stuck) : modes.slider[k];
    slip_force_[k] = slip_side_[k] == 0 ? 0 : slip_side_[k] * inputs_->box(k).at(slip_side_[k]).sliding.value;
    slider_shift_[k] = network_->sliders[k].contact ? rheonet::displacement(network_->sliders[k], state) : state.position[at(b.a)] - state.position[at(b.b)];
  }
  follow_losses();
  y.assign(at(size()), 0);
  for (std::size_t j = 0; j < index_.deflection.size(); ++j) {
    const Branch& b = structure_->deflections[j];
    if (index_.deflection[j] >= 0) {
      y[at(index_.deflection[j])] = state.p[j];
    } else {
      driven_from_[j] = state.p[j] - known_way(b, t);
    }
  }
  const std::vector<double> place = places(state);
  for (const NodeId node : positions_.order) {
    if (const int r = positions_.of[at(node)].tied; r >= 0) tied_sum_[at(r)] = sum_of(structure_->tied[at(r)], place);
  }
  for (std::size_t n = 0; n < index_.velocity.size(); ++n) {
    if (index_.position[n] >= 0) y[at(index_.position[n])] = state.position[n] - place[at(positions_.of[n].parent)];
    if (index_.velocity[n] < 0) continue;
    const int group = structure_->group[n];
    const double base = group < 0 ? 0 : state.velocity[at(structure_->groups[at(group)].nodes.front())];
    y[at(index_.velocity[n])] = state.velocity[n] - base;
  }
  for (std::size_t k = 0; k < index_.block.size(); ++k) y[at(index_.block[k])] = state.blocks[k];
  guess_forces(t, y.data());
}

/// Positions as the view computes them. The state lacks the position of a node that was not requested, but that another
/// position is counted from in these modes.
std::vector<double> Dae::places(const State& state) const {
  std::vector<double> place = state.position;
  for (std::size_t m = 0; m < network_->motions.size(); ++m) {
    if (network_->motions[m].block < 0) place[at(network_->motions[m].node)] = inputs_->position[m];
  }
  for (const NodeId node : positions_.order) {
    const Position& x = positions_.of[at(node)];
    if (x.integrated || x.branch < 0) continue;
    place[at(node)] = place[at(x.parent)] + x.sign * (state.p[at(x.branch)] + offset_[at(x.branch)]);
  }
  return place;
}

double Dae::sum_of(const Structure::Tied& tied, const std::vector<double>& position) {
  double sum = position[at(tied.pivot)];
  for (const auto& [node, factor] : tied.terms) sum += factor * position[at(node)];
  return sum;
}

void Dae::leave(State& state) const {
  state.velocity = view_.velocity;
  state.p = view_.p;
  state.train_force = view_.train_force;
  for (std::size_t k = 0; k < index_.block.size(); ++k) state.blocks[k] = inputs_->blocks().state[k].value;
  for (NodeId node : positions_.order) state.position[at(node)] = view_.position[at(node)];
}

void Dae::set_rate_forms() {
  for (const Laws<RateBatch>& laws : network_->rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) laws.batch->set_by_force(i, index_.force[at(laws.first) + i] >= 0);
  }
}

void Dae::update_holds() {
  sliding_modes_.update();
  differential_.assign(at(size()), 0);
  for_each_mass([&](int entry, double mass) {
    if (mass != 0) differential_[at(pattern_.row[at(entry)])] = 1;
  });
  sliding_modes_.mark_differential(differential_);
}

void Dae::enter_sliding_modes(double t, const double* y, const double* yp, const std::vector<SlidingMode>& sliding_modes) {
  if (sliding_modes.empty()) return;
  // Holding a branch changes neither its deflection nor the force of another branch: one view suffices.
  view(t, y, yp);
  sliding_modes_.enter(sliding_modes, view_.p, view_.f);
  update_holds();
}

}  // namespace rheonet
