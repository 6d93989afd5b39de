#include "core/netlist/si_units.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace rheonet {

namespace {

constexpr Dimension length{1, 0, 0}, mass{0, 1, 0}, duration{0, 0, 1}, force{1, 1, -2}, pressure{-1, 1, -2}, energy{2, 1, -2}, watt{2, 1, -3},
    frequency{0, 0, -1};

constexpr std::array<std::pair<std::string_view, Unit>, 30> units{{
    {"m", {1, length}},      {"km", {1e3, length}},        {"cm", {1e-2, length}},   {"mm", {1e-3, length}},
    {"um", {1e-6, length}},  {"nm", {1e-9, length}},       {"kg", {1, mass}},        {"g", {1e-3, mass}},
    {"mg", {1e-6, mass}},    {"s", {1, duration}},         {"ms", {1e-3, duration}}, {"us", {1e-6, duration}},
    {"N", {1, force}},       {"mN", {1e-3, force}},        {"kN", {1e3, force}},     {"MN", {1e6, force}},
    {"Pa", {1, pressure}},   {"kPa", {1e3, pressure}},     {"MPa", {1e6, pressure}}, {"GPa", {1e9, pressure}},
    {"J", {1, energy}},      {"mJ", {1e-3, energy}},       {"kJ", {1e3, energy}},    {"W", {1, watt}},
    {"mW", {1e-3, watt}},   {"kW", {1e3, watt}},         {"Hz", {1, frequency, 0, 1}},
    {"kHz", {1e3, frequency, 0, 1}}, {"rad", {1, {}, 1, 0}}, {"mrad", {1e-3, {}, 1, 0}},
}};

}  // namespace

const Unit* si_unit(std::string_view symbol) {
  const auto found = std::find_if(units.begin(), units.end(), [&](const auto& unit) { return unit.first == symbol; });
  return found != units.end() ? &found->second : nullptr;
}

}  // namespace rheonet
