#include "core/network/transfer_function.hpp"

#include <algorithm>
#include <utility>

namespace rheonet {

TransferFunction::TransferFunction(const std::vector<double>& numerator, const std::vector<double>& denominator)
    : a(denominator), b(denominator.size(), 0) {
  // Leading coefficients of a numerator longer than the denominator are zeros.
  for (std::size_t k = 1; k <= std::min(numerator.size(), b.size()); ++k) b[b.size() - k] = numerator[numerator.size() - k];
  for (double& x : b) x /= denominator.front();
  for (double& x : a) x /= denominator.front();
}

std::vector<Blocks::Block> realise(Blocks::Block& block, const TransferFunction& transfer, int own, int next) {
  const std::vector<double>&a = transfer.a, &b = transfer.b;
  const std::size_t n = transfer.order();
  const std::vector<Blocks::Input> u = std::exchange(block.inputs, {});
  const auto times_u = [&](double factor) {
    std::vector<Blocks::Input> inputs = u;
    for (Blocks::Input& input : inputs) input.sign *= factor;
    return inputs;
  };
  const auto take_u = [&](Blocks::Block& to, double factor) {
    const std::vector<Blocks::Input> inputs = times_u(factor);
    if (factor != 0) to.inputs.insert(to.inputs.end(), inputs.begin(), inputs.end());
  };
  const auto take = [](Blocks::Block& to, int from, double factor) {
    if (factor != 0) to.inputs.push_back({true, from, factor});
  };
  const bool is_state = n > 0 && !transfer.direct();
  const auto state = [&](std::size_t k) { return is_state ? (k == 1 ? own : next + static_cast<int>(k) - 2) : next + static_cast<int>(k) - 1; };
  std::vector<Blocks::Block> states;
  const double at_rest = b[n] / a[n] - b[0];  // x[1]/u
  double settled = at_rest;                   // x[k]/u
  for (std::size_t k = 1; k <= n; ++k) {
    Blocks::Block made{.element = block.element, .law = {.state = true}, .generates = false, .signal = {}, .inputs = {}};
    if (k == 1) made.law.leak = a[1];
    if (k > 1) take(made, state(1), -a[k]);
    if (k < n) take(made, state(k + 1), 1);
    take_u(made, b[k] - a[k] * b[0]);
    if (a[n] != 0) made.steady = times_u(settled);
    settled = a[k] * at_rest - (b[k] - a[k] * b[0]);
    if (k == 1 && is_state) {
      block.inputs = std::move(made.inputs);
      block.steady = std::move(made.steady);
    } else {
      states.push_back(std::move(made));
    }
  }
  if (is_state) return states;
  take_u(block, b[0]);
  if (n > 0) take(block, state(1), 1);
  return states;
}

}  // namespace rheonet
