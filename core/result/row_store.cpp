#include "core/result/row_store.hpp"

#include <algorithm>
#include <utility>

namespace rheonet {
namespace {

constexpr std::size_t memory = 64 << 20;  // bytes for the rows of all runs
constexpr std::size_t smallest_block = 4 << 10, largest_block = 256 << 10;  // bytes: a write of less costs more than its rows

}  // namespace

RowStore::RowStore(const std::vector<std::size_t>& widths, const char* contents) : file_(std::make_unique<TemporaryFile>(contents)) {
  const std::size_t bytes = std::clamp(memory / std::max<std::size_t>(widths.size(), 1), smallest_block, largest_block);
  for (const std::size_t values : widths) {
    const std::size_t width = values + 1;
    runs_.push_back({.width = width, .block_size = std::max<std::size_t>(bytes / sizeof(double) / width, 1) * width});
  }
}

void RowStore::add(std::size_t number, double time, const std::vector<double>& values) {
  Run& run = runs_[number];
  if (run.block.size() == run.block_size) {
    run.blocks.push_back(file_->append(run.block.data(), run.block.size() * sizeof(double)));
    run.block.clear();
  }
  run.block.push_back(time);
  run.block.insert(run.block.end(), values.begin(), values.end());
  ++run.rows;
}

const double* RowStore::Reader::next() {
  if (next_ == end_ && !read()) return nullptr;
  return std::exchange(next_, next_ + run_->width);
}

/// Goes on to the next block. Returns false if there is none.
bool RowStore::Reader::read() {
  if (begun_ > run_->blocks.size()) return false;
  const bool in_memory = begun_ == run_->blocks.size();
  if (!in_memory) {
    block_.resize(run_->block_size);
    file_->read(block_.data(), block_.size() * sizeof(double), run_->blocks[begun_]);
  }
  ++begun_;
  const std::vector<double>& block = in_memory ? run_->block : block_;
  next_ = block.data();
  end_ = next_ + block.size();
  return next_ != end_;
}

}  // namespace rheonet
