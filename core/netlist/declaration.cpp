#include "core/netlist/declaration.hpp"

#include <algorithm>

namespace rheonet {

std::string called_here(std::string_view name, Declarations declarations) {
  std::string wanted(name);
  for (char& c : wanted) c = c == '-' ? '_' : 'A' <= c && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  for (const Declaration* d : declarations) {
    if (std::find(d->other_names.begin(), d->other_names.end(), wanted) == d->other_names.end()) continue;
    const std::string in_rotation = d->rotational_type.empty() ? "" : ", `" + d->rotational_type + "` in rotation";
    return "it is called `" + d->type + "` here" + in_rotation;
  }
  return "";
}

}  // namespace rheonet
