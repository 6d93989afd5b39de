#include "tests/netlist/fake_declarations.hpp"

namespace rheonet::test {

namespace {

using Kind = Parameter::Kind;
using Ports = Declaration::Ports;

constexpr double infinity = std::numeric_limits<double>::infinity();

const Declaration spring{
    .type = "spring",
    .parameters = {{.name = "stiffness", .quantity = Quantity::stiffness},
                   {.name = "rest", .quantity = Quantity::position, .fallback = 0.0, .lower = -infinity},
                   {.name = "f0", .quantity = Quantity::force, .kind = Kind::initial, .lower = -infinity}}};

const Declaration dashpot{.type = "dashpot",
                          .other_names = {"damper"},
                          .parameters = {{.name = "damping", .quantity = Quantity::damping, .flow_index = "flow_index"},
                                         {.name = "flow_index", .fallback = 1.0, .lower_open = false, .upper = 4}}};

const Declaration slider{
    .type = "slider",
    .parameters = {
        {.name = "coulomb", .quantity = Quantity::force, .lower_open = false, .may_be_infinite = true},
        {.name = "breakaway",
         .quantity = Quantity::force,
         .lower_open = false,
         .may_be_infinite = true,
         .same_as = "coulomb"},
        {.name = "delay", .quantity = Quantity::time, .fallback = 0.0}}};

const Declaration mass{.type = "mass",
                       .rotational_type = "inertia",
                       .ports = Ports::at,
                       .parameters = {{.name = "mass", .quantity = Quantity::mass, .rotational_name = "inertia"}}};

const Declaration motion{.type = "motion",
                         .ports = Ports::at,
                         .parameters = {{.name = "position", .quantity = Quantity::position, .kind = Kind::signal},
                                        {.name = "velocity", .quantity = Quantity::velocity, .kind = Kind::signal}},
                         .one_of = {"position", "velocity"}};

const Declaration force{
    .type = "force",
    .rotational_type = "torque",
    .ports = Ports::at_or_between,
    .parameters = {{.name = "force", .quantity = Quantity::force, .kind = Kind::signal, .rotational_name = "torque"}}};

const Declaration* const all[] = {&spring, &dashpot, &slider, &mass, &motion, &force};

}  // namespace

Declarations fake_declarations() { return all; }

}  // namespace rheonet::test
