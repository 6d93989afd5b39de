#include "tools/rheonet/design.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/netlist/csv_fields.hpp"
#include "core/netlist/diagnostic.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

constexpr long most_runs = 10'000'000;  // 3 CPU hours at 1 ms a run.

using Checked = std::variant<std::monostate, NoVariation>;

}  // namespace

std::variant<Design, NoVariation> Design::read(const SweepArguments& sweep) {
  Design design;
  if (!sweep.list.empty()) {
    auto list = PointList::read(sweep.list);
    if (auto* wrong = std::get_if<NoVariation>(&list)) return std::move(*wrong);
    design.list_ = std::get<std::shared_ptr<const PointList>>(std::move(list));
    design.paths_ = design.list_->paths();
    design.rows_ = design.list_->rows();
    design.origins_.assign(design.paths_.size(), "--list " + sweep.list + ": ");
  }
  Checked checked = design.read_ranges(sweep);
  if (auto* wrong = std::get_if<NoVariation>(&checked)) return std::move(*wrong);
  design.origins_.resize(design.paths_.size(), "--vary ");
  std::set<std::string> seen;
  for (const std::string& path : design.paths_)
    if (!seen.insert(path).second) return NoVariation{fmt::format("`{}` is varied twice", path), ""};
  if (design.paths_.empty())
    return NoVariation{"nothing is varied", "--vary k1.stiffness=100:1000:10, or --list FILE.csv"};
  return design;
}

std::variant<std::monostate, NoVariation> Design::read_ranges(const SweepArguments& sweep) {
  const std::pair<const char*, long> ways[] = {{"--random", sweep.random}, {"--latin", sweep.latin}, {"--sobol", sweep.sobol}};
  const char* way = nullptr;
  for (const auto& [option, count] : ways) {
    if (count == 0) continue;
    if (way) return NoVariation{fmt::format("`{}` and `{}` exclude each other", way, option), ""};
    way = option;
    drawn_ = count;
  }
  if (!way)
    for (const auto& [option, given] : {std::pair{"--seed", sweep.seed.has_value()}, {"--correlate", !sweep.correlate.empty()}, {"--sobol-indices", sweep.indices}})
      if (given) return NoVariation{fmt::format("`{}` is for points that are drawn", option), "--random N, --latin N or --sobol N"};
  if (way && sweep.vary.empty()) return NoVariation{"there is no range to draw from", "--vary k1.stiffness=100:1000"};
  for (const std::string& text : sweep.vary) {
    if (way) {
      auto distribution = read_distribution(text);
      if (auto* wrong = std::get_if<NoVariation>(&distribution)) return std::move(*wrong);
      distributions_.push_back(std::get<Distribution>(std::move(distribution)));
      paths_.push_back(distributions_.back().path);
    } else {
      auto variation = read_variation(text);
      if (auto* wrong = std::get_if<NoVariation>(&variation)) return std::move(*wrong);
      variations_.push_back(std::get<Variation>(std::move(variation)));
      paths_.push_back(variations_.back().path);
      if (grid_ <= most_runs) grid_ *= static_cast<long>(variations_.back().values.size());
    }
  }
  if (sweep.indices) {
    if (list_) return NoVariation{"`--sobol-indices` and `--list` exclude each other", ""};
    group_ = static_cast<long>(distributions_.size()) + 2;
  }
  if (grid_ > most_runs || drawn_ > most_runs / group_ || rows_ > most_runs / (drawn_ * group_ * grid_))
    return NoVariation{fmt::format("these are more than {} runs", most_runs), "draw some of them: --latin 1000"};
  const std::size_t axes = distributions_.size() * (sweep.indices ? 2 : 1);
  if (axes > Points::most_dimensions) return NoVariation{fmt::format("points are drawn from at most {} ranges", Points::most_dimensions), ""};
  using Kind = Points::Kind;
  points_ = Points(sweep.sobol > 0 ? Kind::sobol : sweep.latin > 0 ? Kind::latin : Kind::random, sweep.seed.value_or(1),
                   static_cast<std::uint64_t>(drawn_), axes);
  return read_correlations(sweep);
}

std::variant<std::monostate, NoVariation> Design::read_correlations(const SweepArguments& sweep) {
  if (sweep.correlate.empty()) return {};
  if (sweep.indices)
    return NoVariation{"`--sobol-indices` and `--correlate` exclude each other: the indices are of independent values", ""};
  const auto size = static_cast<Eigen::Index>(distributions_.size());
  Eigen::MatrixXd coefficients = Eigen::MatrixXd::Identity(size, size);
  for (const std::string& text : sweep.correlate) {
    const auto wrong = [&](const std::string& what, const std::string& hint) { return NoVariation{fmt::format("`--correlate {}`: {}", text, what), hint}; };
    const std::size_t equals = text.rfind('=');
    const std::vector<std::string> names = split(text.substr(0, equals), ',');
    const auto coefficient = equals == text.npos ? std::nullopt : csv_number(text.substr(equals + 1));
    if (names.size() != 2 || !coefficient) return wrong("it does not say how two ranges are correlated", "--correlate k1.stiffness,c1.damping=0.6");
    Eigen::Index axis[2] = {};
    for (std::size_t k = 0; k < 2; ++k) {
      const auto found = std::find_if(distributions_.begin(), distributions_.end(), [&](const Distribution& d) { return d.path == names[k]; });
      if (found == distributions_.end()) {
        std::vector<std::string> known;
        for (const Distribution& d : distributions_) known.push_back(d.path);
        const std::string meant = nearest(names[k], known);
        return wrong(fmt::format("`{}` is not drawn", names[k]), meant.empty() ? "`--vary` says what is drawn" : fmt::format("did you mean `{}`?", meant));
      }
      axis[k] = found - distributions_.begin();
    }
    if (axis[0] == axis[1]) return wrong("a range is not correlated with itself", "name two");
    if (!(std::abs(*coefficient) < 1)) return wrong(fmt::format("a coefficient of correlation is between -1 and 1, not {}", *coefficient), "");
    if (coefficients(axis[0], axis[1]) != 0) return wrong("these two are correlated twice", "");
    coefficients(axis[0], axis[1]) = coefficients(axis[1], axis[0]) = *coefficient;
  }
  const Eigen::LLT<Eigen::MatrixXd> factor(coefficients);
  if (factor.info() != Eigen::Success)
    return NoVariation{"no values have these correlations: their matrix is not positive definite",
                       "give smaller coefficients, or those between the other ranges too"};
  correlation_ = factor.matrixL();
  return {};
}

double Design::probability(long draw, std::size_t member, std::size_t range) const {
  const auto number = static_cast<std::uint64_t>(draw);
  const std::size_t count = distributions_.size();
  if (correlation_.size() == 0) {
    const bool second = member == 1 || member == range + 2;  // see Design::group
    return points_.coordinate(number, second ? count + range : range);
  }
  double score = 0;
  for (std::size_t k = 0; k <= range; ++k)
    score += correlation_(static_cast<Eigen::Index>(range), static_cast<Eigen::Index>(k)) * normal_score(points_.coordinate(number, k));
  return probability_of_score(score);
}

bool Design::all_of(std::size_t path, const std::function<bool(const std::string& value)>& holds) const {
  if (const std::size_t listed = list_ ? list_->paths().size() : 0; path < listed)
    return list_->all_of([&](const std::vector<std::string>& values) { return holds(values[path]); });
  else
    path -= listed;
  if (path < variations_.size()) return std::all_of(variations_[path].values.begin(), variations_[path].values.end(), holds);
  const Distribution& distribution = distributions_[path - variations_.size()];
  return distribution.values.empty() ? holds(distribution.quantile(0.5)) : std::all_of(distribution.values.begin(), distribution.values.end(), holds);
}

std::vector<std::string> Design::point(long run) const {
  std::vector<std::string> values;
  const long inner = drawn_ * group_ * grid_;
  if (list_) values = list_->row(run / inner);
  long rest = run % inner, stride = inner;
  for (const Variation& variation : variations_) {
    stride /= static_cast<long>(variation.values.size());
    values.push_back(variation.values[static_cast<std::size_t>(rest / stride)]);
    rest %= stride;
  }
  for (std::size_t range = 0; range < distributions_.size(); ++range)
    values.push_back(distributions_[range].quantile(probability(rest / group_, static_cast<std::size_t>(rest % group_), range)));
  return values;
}

}  // namespace rheonet::tool
