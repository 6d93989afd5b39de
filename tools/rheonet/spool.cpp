#include "tools/rheonet/spool.hpp"

#include <utility>

namespace rheonet::tool {

std::int64_t SpoolFile::write(const std::string& bytes) {
  std::int64_t place = 0;
  {
    const std::scoped_lock lock(mutex_);
    if (free_.empty()) {
      place = std::exchange(end_, end_ + static_cast<std::int64_t>(block));
    } else {
      place = free_.back();
      free_.pop_back();
    }
  }
  file_.write(bytes.data(), bytes.size(), place);
  return place;
}

void SpoolFile::free(std::int64_t place) {
  const std::scoped_lock lock(mutex_);
  free_.push_back(place);
}

Spool& Spool::operator=(Spool&& other) noexcept {
  if (this == &other) return *this;
  clear();
  file_ = other.file_;
  blocks_ = std::exchange(other.blocks_, {});
  rest_ = std::exchange(other.rest_, {});
  size_ = std::exchange(other.size_, 0);
  return *this;
}

void Spool::clear() {
  for (const Block& block : blocks_) file_->free(block.place);
  blocks_.clear();
  rest_.clear();
  size_ = 0;
}

void Spool::append(std::string_view text) {
  size_ += text.size();
  while (rest_.size() + text.size() > SpoolFile::block) {
    const std::size_t fits = SpoolFile::block - rest_.size();
    rest_ += text.substr(0, fits);
    text.remove_prefix(fits);
    write();
  }
  rest_ += text;
}

void Spool::append(Spool&& other) {
  if (other.blocks_.empty()) {
    append(other.rest_);
  } else {
    if (!rest_.empty()) write();
    size_ += other.size_;
    blocks_.insert(blocks_.end(), other.blocks_.begin(), other.blocks_.end());
    rest_ = std::move(other.rest_);
    other.blocks_.clear();
  }
  other.clear();
}

void Spool::write() {
  blocks_.push_back({file_->write(rest_), rest_.size()});
  rest_.clear();
}

bool Spool::take(const std::function<bool(const std::string& lines)>& take) {
  std::string lines, bytes;
  for (const Block& block : blocks_) {
    bytes.resize(block.size);
    file_->read(bytes, block.place);
    lines += bytes;
    const std::size_t whole = lines.rfind('\n') + 1;  // 0: no complete line.
    bytes.assign(lines, whole);
    lines.resize(whole);
    if (whole > 0 && !take(lines)) return false;
    std::swap(lines, bytes);
  }
  lines += rest_;
  clear();
  return lines.empty() || take(lines);
}

}  // namespace rheonet::tool
