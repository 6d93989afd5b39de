#include "core/netlist/dependency_order.hpp"

#include <algorithm>

namespace rheonet {

DependencyOrder dependency_order(const std::vector<std::vector<std::size_t>>& uses) {
  enum class State { untouched, open, done };
  struct Visit {
    std::size_t at;
    std::size_t next = 0;
  };
  DependencyOrder result;
  std::vector<State> states(uses.size(), State::untouched);
  std::vector<bool> broken(uses.size(), false);
  for (std::size_t root = 0; root < uses.size(); ++root) {
    if (states[root] != State::untouched) continue;
    std::vector<Visit> stack{{root}};
    states[root] = State::open;
    while (!stack.empty()) {
      const std::size_t at = stack.back().at;
      if (stack.back().next < uses[at].size()) {
        const std::size_t to = uses[at][stack.back().next++];
        if (states[to] == State::untouched) {
          states[to] = State::open;
          stack.push_back({to});
        } else if (states[to] == State::open) {
          std::vector<std::size_t> cycle;
          const auto first = std::find_if(stack.begin(), stack.end(), [&](const Visit& v) { return v.at == to; });
          for (auto visit = first; visit != stack.end(); ++visit) cycle.push_back(visit->at);
          result.cycles.push_back(std::move(cycle));
          broken[at] = true;
        } else if (broken[to]) {
          broken[at] = true;
        }
        continue;
      }
      states[at] = State::done;
      stack.pop_back();
      if (!broken[at])
        result.order.push_back(at);
      else if (!stack.empty())
        broken[stack.back().at] = true;
    }
  }
  return result;
}

}  // namespace rheonet
