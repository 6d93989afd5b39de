#pragma once

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>

namespace rheonet::tool {

/// Without Boost's detour through `long double`: it takes longer, and fails where `long double` has no more digits than `double`, as
/// under valgrind.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using Normal = boost::math::normal_distribution<double, InDouble>;
using Binomial = boost::math::binomial_distribution<double, InDouble>;

}  // namespace rheonet::tool
