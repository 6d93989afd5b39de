// The functions of UDUNITS-2 that core/netlist/units.cpp calls, from the table that unit_table.cpp writes of that library's units.
#include <udunits2.h>

#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

struct Unit {
  bool multiple = true;
  double scale = 1, origin = 0;
  std::vector<std::pair<std::string, int>> powers;
};

struct ut_system {
  std::vector<std::pair<std::string, double>> prefixes;
  std::map<std::string, Unit, std::less<>> units;

  /// A unit by its name, with as many prefixes as it has.
  std::optional<Unit> find(std::string_view name) const {
    if (const auto found = units.find(name); found != units.end()) return found->second;
    std::optional<Unit> longest;
    std::size_t length = 0;
    for (const auto& [prefix, factor] : prefixes) {
      if (prefix.size() <= length || prefix.size() >= name.size() || !name.starts_with(prefix)) continue;
      std::optional<Unit> unit = find(name.substr(prefix.size()));
      if (!unit) continue;
      unit->scale *= factor;
      longest = std::move(unit);
      length = prefix.size();
    }
    return longest;
  }
};

namespace {

/// The unit or base unit behind the opaque type.
struct Held {
  std::optional<Unit> unit;
  std::string symbol;
};

Held* held(const ut_unit* unit) { return reinterpret_cast<Held*>(const_cast<ut_unit*>(unit)); }
ut_unit* opaque(Held* held) { return reinterpret_cast<ut_unit*>(held); }

}  // namespace

extern "C" {

ut_error_message_handler ut_set_error_message_handler(ut_error_message_handler handler) { return handler; }
int ut_ignore(const char*, va_list) { return 0; }

ut_system* ut_read_xml(const char*) {
  std::ifstream file("/units.txt");
  if (!file) return nullptr;
  auto system = std::make_unique<ut_system>();
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind, name;
    words >> kind >> name;
    if (kind == "prefix") {
      words >> system->prefixes.emplace_back(name, 1).second;
      continue;
    }
    Unit& unit = system->units[name];
    words >> unit.multiple >> unit.scale >> unit.origin;
    std::string base;
    for (int power = 0; words >> base >> power;) unit.powers.emplace_back(base, power);
  }
  return system.release();
}
void ut_free_system(ut_system* system) { delete system; }

ut_unit* ut_parse(const ut_system* system, const char* text, ut_encoding) {
  std::optional<Unit> unit = system->find(text);
  return unit ? opaque(new Held{std::move(unit), ""}) : nullptr;
}
void ut_free(ut_unit* unit) { delete held(unit); }

ut_status ut_accept_visitor(const ut_unit* visited, const ut_visitor* visitor, void* data) {
  const Unit& unit = *held(visited)->unit;
  if (!unit.multiple) return visitor->visit_logarithmic(visited, 10, visited, data);
  if (unit.scale != 1 || unit.origin != 0) {
    Held plain{unit, ""};
    plain.unit->scale = 1;
    plain.unit->origin = 0;
    return visitor->visit_galilean(visited, unit.scale, opaque(&plain), unit.origin, data);
  }
  std::vector<Held> bases;
  std::vector<int> powers;
  for (const auto& [symbol, power] : unit.powers) bases.push_back({{}, symbol}), powers.push_back(power);
  std::vector<const ut_unit*> pointers;
  for (Held& base : bases) pointers.push_back(opaque(&base));
  return visitor->visit_product(visited, static_cast<int>(powers.size()), pointers.data(), powers.data(), data);
}
const char* ut_get_symbol(const ut_unit* unit, ut_encoding) { return held(unit)->symbol.c_str(); }

}
