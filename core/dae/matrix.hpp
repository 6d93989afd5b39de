#pragma once

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
  /// Reserves the entry (row, column) and returns its ticket.
  int ticket(int row, int column) {
    places_.push_back({row, column});
    return static_cast<int>(places_.size()) - 1;
  }
  struct Place { int row, column; };
  /// For each ticket.
  const std::vector<Place>& places() const { return places_; }
  /// The pattern, and for each ticket its entry in it: tickets for the same place get the same entry.
  Pattern build(int size, std::vector<int>& entry_of_ticket) const;

 private:
  std::vector<Place> places_;  ///< of each ticket
};

}  // namespace rheonet
