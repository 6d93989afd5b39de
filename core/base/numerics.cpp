#include "core/base/numerics.hpp"

namespace rheonet::numerics {

std::vector<Parameter> parameters() {
  std::vector<Parameter> all;
  std::string heading;
#define HEADING(text) heading = text;
#define NUMBER(type, name, value, unit, meaning, reason) \
  all.push_back({heading, #name, {static_cast<double>(name)}, unit, meaning, reason});
#define NUMBERS(name, values, unit, meaning, reason) all.push_back({heading, #name, {name.begin(), name.end()}, unit, meaning, reason});
#include "core/base/numerics.def"
#undef HEADING
#undef NUMBER
#undef NUMBERS
  return all;
}

}  // namespace rheonet::numerics
