#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rheonet {

/// Lines with the same key merged into one that lists their names, in order of first appearance.
template <class Line>
class Grouped {
 public:
  void add(const std::string& key, const Line& line, const std::string& name) {
    const auto [found, fresh] = index_.try_emplace(key, lines_.size());
    if (fresh) lines_.push_back(line);
    lines_[found->second].names.push_back(name);
  }
  std::vector<Line> take() { return std::move(lines_); }

 private:
  std::vector<Line> lines_;
  std::map<std::string, std::size_t> index_;
};

}  // namespace rheonet
