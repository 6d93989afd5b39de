#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace rheonet {

/// Lines of one kind, each with its names, in the order in which they come up.
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
