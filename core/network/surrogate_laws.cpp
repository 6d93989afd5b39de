#include "core/network/surrogate_laws.hpp"

#include <utility>

namespace rheonet {

namespace {

// A local static: components register before static objects of other files may exist.
std::vector<SurrogateLaw>& registered_alternatives() {
  static std::vector<SurrogateLaw> instance;
  return instance;
}

}  // namespace

RegisterSurrogate::RegisterSurrogate(SurrogateLaw alternative) { registered_alternatives().push_back(std::move(alternative)); }

const std::vector<SurrogateLaw>& surrogate_laws() { return registered_alternatives(); }

}  // namespace rheonet
