#include "core/network/component.hpp"

namespace rheonet {
namespace {

// A transmission with a moving support, or in a loop with other elements. See core/network/transmission.hpp.
const RegisterComponent register_gear_train({
    .declaration = {.type = "gear train", .ports = Declaration::Ports::between},
    .role = Role::train,
    .hidden = true,
});

}  // namespace
}  // namespace rheonet
