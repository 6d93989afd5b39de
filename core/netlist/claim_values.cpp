#include "core/netlist/claim_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/netlist/counting.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

bool is_time(Claim::Figure figure) {
  using Figure = Claim::Figure;
  return figure == Figure::crossing || figure == Figure::time_of_max || figure == Figure::time_of_min;
}

double ClaimValues::time(const TomlValue& source, const std::string& name) const {
  const Formula formula(source, name, context_.diagnostics);
  if (!formula.given()) return not_given;
  const auto t = formula.evaluate_finite(environment_, Quantity::time, context_.domain, context_.diagnostics);
  check_in_run(source, name, t.value_or(not_given));
  return t.value_or(not_given);
}

void ClaimValues::check_in_run(const TomlValue& source, const std::string& name, double t) const {
  if (std::isnan(scene_.start) || std::isnan(scene_.stop)) return;  // this mistake has been reported
  if (t < scene_.start || t > scene_.stop)
    context_.diagnostics.error(source.spot,
                            fmt::format("{} must be within the run, {} s to {} s, but is {} s", name,
                                        number_text(scene_.start), number_text(scene_.stop), number_text(t)));
}

double ClaimValues::level(const TomlValue& source, const std::string& name, const Number& expected) const {
  DiagnosticList& diagnostics = context_.diagnostics;
  const Formula formula(source, name, diagnostics);
  if (!formula.given()) return not_given;
  const auto number = formula.evaluate(environment_, diagnostics);
  if (!number) return not_given;
  if (!fits(*number, expected)) {
    diagnostics.error(source.spot, fmt::format("{}: expected {}, found {}", name, describe(expected), describe(*number)));
    return not_given;
  }
  if (std::isfinite(number->value)) return number->value;
  diagnostics.error(source.spot, name + " must be finite, but is infinite");
  return not_given;
}

int claimed_index(const Record& record, Scene& scene) {
  auto& claimed = scene.claimed;
  const auto known =
      std::find_if(claimed.begin(), claimed.end(), [&](const Record& other) { return other.path == record.path; });
  if (known == claimed.end()) {
    claimed.push_back(record);
    return static_cast<int>(claimed.size()) - 1;
  }
  return static_cast<int>(known - claimed.begin());
}

}  // namespace rheonet
