#include "core/network/alternatives.hpp"

#include <utility>

namespace rheonet {

namespace {

// A local static: components register before static objects of other files may exist.
std::vector<Alternative>& registered_alternatives() {
  static std::vector<Alternative> instance;
  return instance;
}

}  // namespace

RegisterAlternative::RegisterAlternative(Alternative alternative) { registered_alternatives().push_back(std::move(alternative)); }

const std::vector<Alternative>& alternatives() { return registered_alternatives(); }

}  // namespace rheonet
