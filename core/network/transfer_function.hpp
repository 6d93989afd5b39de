#pragma once

#include <cstddef>
#include <vector>

#include "core/network/blocks.hpp"

namespace rheonet {

/// (b[0] s^n + ... + b[n])/(s^n + a[1] s^(n-1) + ... + a[n]), a[0] = 1.
struct TransferFunction {
  /// From the coefficients of two polynomials, highest power first. The first one of the denominator is not 0, and the degree of the
  /// numerator is at most that of the denominator.
  TransferFunction(const std::vector<double>& numerator, const std::vector<double>& denominator);

  std::size_t order() const { return a.size() - 1; }
  /// Whether the output depends on the present input.
  bool direct() const { return b.front() != 0; }

  std::vector<double> a, b;
};

/// Makes `block`, whose inputs u are known, a transfer function in observer canonical form: its output is the first state plus b[0] u.
///
///     x[k]' = x[k+1] - a[k] x[1] + (b[k] - a[k] b[0]) u,  k = 1 ... n,  x[n+1] = 0
///
/// In equilibrium x[1] = (b[n]/a[n] - b[0]) u, and the other states follow; with a[n] = 0 it integrates, and has none. Returns blocks
/// for the states, numbered from `next` on. With b[0] = 0 the block itself, number `own`, is the first state: its law is that of a state with
/// the leak a[1].
std::vector<Blocks::Block> realise(Blocks::Block& block, const TransferFunction& transfer, int own, int next);

}  // namespace rheonet
