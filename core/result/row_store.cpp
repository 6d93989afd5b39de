#include "core/result/row_store.hpp"

#include <algorithm>
#include <utility>

namespace rheonet {
namespace {

constexpr std::size_t memory = 64 << 20;  // bytes for the rows of all runs
constexpr std::size_t smallest_block = 4 << 10, largest_block = 256 << 10;  // bytes: a write of less costs more than its rows

}  // namespace

RowStore::RowStore(const std::vector<std::size_t>& widths)
    : bytes_(std::clamp(memory / std::max<std::size_t>(widths.size(), 1), smallest_block, largest_block)) {
  for (const std::size_t width : widths) runs_.push_back({.width = width + 1});
}

std::size_t RowStore::rows_of_block(const Run& run) const { return std::max<std::size_t>(bytes_ / sizeof(double) / run.width, 1); }

void RowStore::add(std::size_t number, double time, const std::vector<double>& values) {
  Run& run = runs_[number];
  if (run.block.size() == size_of_block(run)) write(run);
  run.block.push_back(time);
  run.block.insert(run.block.end(), values.begin(), values.end());
  ++run.rows;
}

void RowStore::write(Run& run) {
  const std::size_t size = run.block.size() * sizeof(double);
  std::int64_t offset = 0;
  {
    const std::lock_guard lock(mutex_);
    offset = std::exchange(end_, end_ + static_cast<std::int64_t>(size));
  }
  file_.write(run.block.data(), size, offset);
  run.blocks.push_back(offset);
  run.block.clear();
}

const double* RowStore::next(std::size_t number) {
  Run& run = runs_[number];
  if (run.begun == 0 || run.place == run.block.size()) read(run);
  return run.block.data() + std::exchange(run.place, run.place + run.width);
}

void RowStore::read(Run& run) {
  if (run.begun == 0) run.last = std::move(run.block);
  run.place = 0;
  if (run.begun < run.blocks.size()) {
    run.block.resize(size_of_block(run));
    file_.read(run.block.data(), run.block.size() * sizeof(double), run.blocks[run.begun]);
  } else {
    run.block = std::move(run.last);
  }
  ++run.begun;
}

}  // namespace rheonet
