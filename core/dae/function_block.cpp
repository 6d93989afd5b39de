#include "core/dae/function_block.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/numerics.hpp"

namespace rheonet {

FunctionBlock::FunctionBlock(const SwitchedFunction& function)
    : function_(&function),
      arguments_(function.variables(), 0),
      rates_(arguments_),
      partials_(arguments_),
      changing_(arguments_.size(), 1),
      sides_(function.switches(), SwitchedFunction::no_side),
      fresh_(sides_),
      fired_(sides_),
      guards_(sides_) {}

void FunctionBlock::begin(double time) {
  std::fill(arguments_.begin(), arguments_.end(), 0.0);
  std::fill(rates_.begin(), rates_.end(), 0.0);
  std::fill(changing_.begin(), changing_.end(), 0);
  arguments_.back() = time;
  rates_.back() = 1;
  changing_.back() = 1;
  past_switch_ = false;
}

void FunctionBlock::add(std::size_t argument, Dual value, bool changes, bool past_switch) {
  past_switch_ = past_switch_ || past_switch;
  if (changes) changing_[argument] = 1;
  arguments_[argument] += value.value;
  rates_[argument] += value.derivative;
}

Dual FunctionBlock::value(bool held) {
  bool ordered = true;
  if (!held) {
    fresh_ = fired_;
    ordered = function_->complete_sides(arguments_, fresh_);
    if (ordered && rests_on_threshold()) ordered = function_->complete_sides(arguments_, fresh_);
  }
  const auto value = ordered ? function_->value_past_switches(arguments_, held ? sides_ : fresh_, partials_, past_switch_) : std::nullopt;
  if (!value) {
    // The partial derivatives enter the Jacobian, where a number that is not finite would spoil the equations of others.
    std::fill(partials_.begin(), partials_.end(), 0.0);
    return std::numeric_limits<double>::quiet_NaN();
  }
  Dual result(*value);
  for (std::size_t k = 0; k < arguments_.size(); ++k) result.derivative += partials_[k] * rates_[k];
  return result;
}

/// A switch that has fired does not go over where its arguments stay exactly at its threshold, as where a slider sticks: there the function has its
/// value at the threshold. Returns whether there is one; its side is then open.
bool FunctionBlock::rests_on_threshold() {
  if (std::all_of(fired_.begin(), fired_.end(), [](double side) { return std::isnan(side); })) return false;
  function_->switching_functions(arguments_, fresh_, guards_);
  bool any = false;
  for (std::size_t k = 0; k < fired_.size(); ++k) {
    if (std::isnan(fired_[k]) || guards_[k] != 0 || function_->switch_follows(k, arguments_, fresh_, changing_)) continue;
    fresh_[k] = SwitchedFunction::no_side;
    any = true;
  }
  return any;
}

double FunctionBlock::event_function(std::size_t which) {
  function_->switching_functions(arguments_, sides_, guards_);
  return std::isfinite(guards_[which]) ? guards_[which] : 1;
}

std::vector<double> FunctionBlock::guards(const std::vector<std::size_t>& switches) {
  function_->switching_functions(arguments_, sides_, guards_);
  std::vector<double> result;
  for (const std::size_t k : switches) result.push_back(guards_[k]);
  return result;
}

bool FunctionBlock::fire(const std::vector<std::size_t>& switches, const std::vector<double>& guards) {
  std::fill(fired_.begin(), fired_.end(), SwitchedFunction::no_side);
  std::vector<double> crossed = sides_;
  for (std::size_t i = 0; i < switches.size(); ++i) {
    const std::size_t k = switches[i];
    function_->switching_functions(arguments_, crossed, guards_);
    // The same double, as it is computed from the same arguments: no other event has changed it.
    const bool same = guards_[k] == guards[i] && function_->switch_follows(k, arguments_, crossed, changing_);
    if (!same && !(guards_[k] < 0)) continue;
    function_->cross(k, arguments_, crossed);
    fired_[k] = crossed[k];
  }
  bool past_switch = past_switch_;
  const double before = function_->value_past_switches(arguments_, sides_, partials_, past_switch).value_or(0);
  past_switch = past_switch_;
  fired_value_ = function_->value_past_switches(arguments_, crossed, partials_, past_switch).value_or(0);
  changes_now_ = false;
  for (std::size_t j = 0; j < partials_.size(); ++j) changes_now_ = changes_now_ || (changing_[j] && partials_[j] != 0);
  if (switches.empty()) return false;
  largest_ = std::max({largest_, std::abs(before), std::abs(fired_value_)});
  return std::abs(fired_value_ - before) > numerics::function_jump * largest_;
}

bool FunctionBlock::choose() {
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  if (std::equal(sides_.begin(), sides_.end(), fresh_.begin(), same)) return false;
  sides_ = fresh_;
  return true;
}

}  // namespace rheonet
