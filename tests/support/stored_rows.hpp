#pragma once

#include <cstddef>
#include <vector>

#include "core/result/row_store.hpp"

namespace rheonet::test {

/// The rows of one run, all in memory.
struct RowsInMemory {
  std::vector<double> times;
  std::vector<std::vector<double>> values;  ///< of each time
};

inline RowStore stored(const RowsInMemory& rows) {
  RowStore store({rows.values.front().size()});
  for (std::size_t i = 0; i < rows.times.size(); ++i) store.add(rows.times[i], rows.values[i]);
  return store;
}

inline RowsInMemory read_back(const RowStore& store) {
  RowsInMemory rows;
  RowStore::Reader reader = store.read();
  while (const double* const row = reader.next()) {
    rows.times.push_back(row[0]);
    rows.values.emplace_back(row + 1, row + store.width());
  }
  return rows;
}

}  // namespace rheonet::test
