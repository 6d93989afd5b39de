#include "core/netlist/declaration.hpp"

#include <algorithm>

namespace rheonet {

std::string called_here(std::string_view name, Declarations declarations) {
  const auto plain = [](std::string_view word) {
    std::string letters;
    for (const char c : word) {
      if (c != '-' && c != '_') letters += 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    }
    return letters;
  };
  std::string types, in_rotation;
  for (const Declaration* d : declarations) {
    if (std::none_of(d->other_names.begin(), d->other_names.end(), [&](const std::string& other) { return plain(other) == plain(name); })) continue;
    types += (types.empty() ? "`" : " or `") + d->type + '`';
    if (!d->rotational_type.empty()) in_rotation += ", `" + d->rotational_type + "` in rotation";
  }
  return types.empty() ? "" : "it is called " + types + " here" + in_rotation;
}

}  // namespace rheonet
