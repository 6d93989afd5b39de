#include "tests/contract/refusals.hpp"

#include <doctest/doctest.h>

#include <string>

#include "tests/support/simulate.hpp"

namespace rheonet::test {

void check_refusals(const std::vector<Refusal>& refusals) {
  for (const Refusal& bad : refusals) {
    CAPTURE(std::string(bad.what));
    std::string netlist = bad.netlist + 1;
    if (netlist.find("[simulate]") == std::string::npos) netlist += "[simulate]\nstop = 1\n";
    const std::string message = bad.message;
    CHECK(refusal(netlist) == (message.starts_with('\n') ? message.substr(1) : message));
  }
}

}  // namespace rheonet::test
