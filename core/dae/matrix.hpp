#pragma once

#include <map>
#include <utility>
#include <vector>

namespace rheonet {

/// A sparsity pattern, compressed by columns, row indices ascending in each.
struct Pattern {
  int size = 0;
  std::vector<int> column_start;  ///< size + 1
  std::vector<int> row;
  int entries() const { return static_cast<int>(row.size()); }
};

/// Collects entries in any order, then numbers them by columns.
class PatternBuilder {
 public:
  /// A ticket for entry (row, column); the same ticket for the same place.
  int ticket(int row, int column) {
    const auto [it, fresh] = tickets_.try_emplace({column, row}, static_cast<int>(tickets_.size()));
    return it->second;
  }
  /// The pattern, and for each ticket its entry in it.
  Pattern build(int size, std::vector<int>& entry_of_ticket) const {
    Pattern pattern{.size = size, .column_start = std::vector<int>(static_cast<std::size_t>(size) + 1, 0), .row = {}};
    entry_of_ticket.resize(tickets_.size());
    int entry = 0;
    for (const auto& [place, ticket] : tickets_) {
      entry_of_ticket[static_cast<std::size_t>(ticket)] = entry++;
      ++pattern.column_start[static_cast<std::size_t>(place.first) + 1];
      pattern.row.push_back(place.second);
    }
    for (std::size_t c = 1; c < pattern.column_start.size(); ++c) pattern.column_start[c] += pattern.column_start[c - 1];
    return pattern;
  }

 private:
  std::map<std::pair<int, int>, int> tickets_;  // sorted by column, then row
};

}  // namespace rheonet
