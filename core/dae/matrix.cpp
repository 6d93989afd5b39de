#include "core/dae/matrix.hpp"

#include <numeric>

namespace rheonet {

namespace {

/// The members of `list` sorted by their keys, which are below `size`; members of equal key keep their order.
template <class Key>
std::vector<int> sorted(const std::vector<int>& list, int size, Key key) {
  std::vector<int> next(static_cast<std::size_t>(size) + 1, 0), result(list.size());
  for (const int i : list) ++next[static_cast<std::size_t>(key(i)) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (const int i : list) result[static_cast<std::size_t>(next[static_cast<std::size_t>(key(i))]++)] = i;
  return result;
}

}  // namespace

Pattern PatternBuilder::build(int size, std::vector<int>& entry_of_ticket) const {
  const auto place = [&](int ticket) { return places_[static_cast<std::size_t>(ticket)]; };
  std::vector<int> tickets(places_.size());
  std::iota(tickets.begin(), tickets.end(), 0);
  tickets = sorted(tickets, size, [&](int ticket) { return place(ticket).row; });
  tickets = sorted(tickets, size, [&](int ticket) { return place(ticket).column; });
  Pattern pattern{.size = size, .column_start = std::vector<int>(static_cast<std::size_t>(size) + 1, 0), .row = {}};
  entry_of_ticket.resize(places_.size());
  Place last{-1, -1};
  for (const int ticket : tickets) {
    const Place here = place(ticket);
    if (here.row != last.row || here.column != last.column) {
      pattern.row.push_back(here.row);
      ++pattern.column_start[static_cast<std::size_t>(here.column) + 1];
      last = here;
    }
    entry_of_ticket[static_cast<std::size_t>(ticket)] = pattern.entries() - 1;
  }
  pattern.row.shrink_to_fit();
  std::partial_sum(pattern.column_start.begin(), pattern.column_start.end(), pattern.column_start.begin());
  return pattern;
}

}  // namespace rheonet
