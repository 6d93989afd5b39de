#include "core/network/alternatives.hpp"

#include <utility>

namespace rheonet {

namespace {

// A function's static: components register while other files' static objects may not exist yet.
std::vector<Alternative>& registered_alternatives() {
  static std::vector<Alternative> instance;
  return instance;
}

}  // namespace

RegisterAlternative::RegisterAlternative(Alternative alternative) { registered_alternatives().push_back(std::move(alternative)); }

const std::vector<Alternative>& alternatives() { return registered_alternatives(); }

}  // namespace rheonet
