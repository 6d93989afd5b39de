#include "core/dae/pivot_rows.hpp"

#include <map>
#include <set>
#include <utility>

#include "core/base/index.hpp"

namespace rheonet {

void PivotRows::reserve(JacobianEntries& jacobian) {
  const std::vector<Structure::TrainEquation>& equations = slip_.equations();
  if (equations.empty()) return;
  std::map<int, std::size_t> of_row;  // the equation of each pivot's row
  for (std::size_t r = 0; r < equations.size(); ++r) of_row.emplace(index_.velocity[at(equations[r].pivot)], r);
  PatternBuilder& builder = jacobian.builder();
  for (const JacobianEntries::Constant& mass : jacobian.withdraw_masses()) {
    const PatternBuilder::Place place = builder.places()[at(mass.entry)];
    const auto found = of_row.find(place.row);
    if (found == of_row.end()) {
      jacobian.put_back(mass);
      continue;
    }
    const std::vector<Structure::TrainEquation::Term>& shares = equations[found->second].shares;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      shared_masses_.push_back({builder.ticket(index_.velocity[at(shares[i].node)], place.column), found->second, i, mass.value});
    }
  }
  std::set<std::pair<int, int>> places;  // row and column
  for (const PatternBuilder::Place& place : builder.places()) {
    if (of_row.contains(place.row)) places.emplace(place.row, place.column);
  }
  for (const auto& [from, column] : places) {
    const std::size_t r = of_row.at(from);
    const std::vector<Structure::TrainEquation::Term>& shares = equations[r].shares;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      shared_entries_.push_back({builder.ticket(from, column), builder.ticket(index_.velocity[at(shares[i].node)], column), r, i});
    }
  }
  for (const auto& [row, r] : of_row) {
    tied_.push_back({builder.ticket(row, row), 1});
    for (const auto& [node, factor] : equations[r].terms) {
      if (index_.velocity[at(node)] >= 0) tied_.push_back({builder.ticket(row, index_.velocity[at(node)]), factor});
    }
  }
}

void PivotRows::take(const Pattern& pattern, const std::vector<int>& entry) {
  if (slip_.equations().empty()) return;
  for (SharedMass& m : shared_masses_) m.entry = entry[at(m.entry)];
  for (SharedEntry& s : shared_entries_) {
    s.from = entry[at(s.from)];
    s.to = entry[at(s.to)];
  }
  for (JacobianEntries::Constant& c : tied_) c.entry = entry[at(c.entry)];
  std::vector<char> of_pivot(at(pattern.size), 0);
  for (const Structure::TrainEquation& equation : slip_.equations()) of_pivot[at(index_.velocity[at(equation.pivot)])] = 1;
  for (int e = 0; e < pattern.entries(); ++e) {
    if (of_pivot[at(pattern.row[at(e)])]) pivot_entries_.push_back(e);
  }
}

void PivotRows::tie(double* values) const {
  const std::vector<Structure::TrainEquation>& equations = slip_.equations();
  for (const SharedEntry& s : shared_entries_) values[s.to] -= equations[s.equation].shares[s.share].factor * values[s.from];
  for (const int entry : pivot_entries_) values[entry] = 0;
  for (const JacobianEntries::Constant& c : tied_) values[c.entry] += c.value;
}

}  // namespace rheonet
