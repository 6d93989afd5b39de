#include "tools/rheonet/design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "core/netlist/characters.hpp"
#include "core/netlist/csv_fields.hpp"
#include "core/netlist/file_cache.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

constexpr long most_runs = 10'000'000;  // of an evening on many cores, each a millisecond

using Checked = std::variant<std::monostate, NoVariation>;

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014): the number of a place in a sequence, the same on every machine.
std::uint64_t mixed(std::uint64_t z) {
  z += 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

std::uint64_t random_bits(std::uint64_t seed, std::uint64_t draw, std::uint64_t range) {
  return mixed(mixed(mixed(seed) ^ draw) ^ range);
}

/// Of [0, 1): 53 bits, as many as a double has.
double unit_interval(std::uint64_t bits) { return static_cast<double>(bits >> 11U) * 0x1p-53; }

/// A cell of the list, with the unit of its heading if it is a number without one.
std::string with_unit(std::string_view cell, std::string_view unit) {
  return unit.empty() || !csv_number(cell) ? std::string(cell) : fmt::format("{} {}", cell, unit);
}

}  // namespace

std::variant<Design, NoVariation> Design::read(const Arguments::Sweep& sweep) {
  Design design;
  if (!sweep.list.empty()) {
    Checked checked = design.read_list(sweep.list);
    if (auto* wrong = std::get_if<NoVariation>(&checked)) return std::move(*wrong);
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

std::variant<std::monostate, NoVariation> Design::read_list(const std::string& file) {
  std::string why;
  const auto text = rheonet::read_text(file, why);
  if (!text) return NoVariation{fmt::format("`--list {}` cannot be read: {}", file, why), ""};
  std::vector<std::string> units;
  int number = 0;
  for (const std::string& line : split(*text, '\n')) {
    ++number;
    if (is_csv_remark(line)) continue;
    const std::vector<CsvField> fields = csv_fields(line);
    if (paths_.empty()) {
      for (const CsvField& field : fields) {
        const CsvHeading heading = csv_heading(field.text);
        paths_.emplace_back(heading.name);
        units.emplace_back(heading.unit);
        if (heading.name.empty() || csv_number(field))
          return NoVariation{fmt::format("{}:{}:{}: expected the path of a value, found `{}`", file, number, field.column,
                                         field.text),
                             "the first row names what takes the values below it: k1.stiffness [N/m],c1.damping"};
      }
      continue;
    }
    if (fields.size() != paths_.size())
      return NoVariation{fmt::format("{}:{}: {} values, but the first row names {}", file, number, fields.size(), paths_.size()),
                         ""};
    std::vector<std::string>& row = list_.emplace_back();
    for (std::size_t k = 0; k < fields.size(); ++k) {
      if (fields[k].text.empty())
        return NoVariation{fmt::format("{}:{}:{}: `{}` has no value", file, number, fields[k].column, paths_[k]), ""};
      row.push_back(with_unit(csv_text(fields[k]), units[k]));
    }
  }
  if (list_.empty()) return NoVariation{fmt::format("`{}` has no row of values", file), "k1.stiffness [N/m],c1.damping, and below it 100,5"};
  rows_ = static_cast<long>(list_.size());
  return {};
}

std::variant<std::monostate, NoVariation> Design::read_ranges(const Arguments::Sweep& sweep) {
  const bool draws = sweep.random > 0 || sweep.latin > 0;
  if (sweep.random > 0 && sweep.latin > 0) return NoVariation{"`--random` and `--latin` exclude each other", ""};
  if (sweep.seed && !draws) return NoVariation{"`--seed` is for `--random` and `--latin`", ""};
  if (draws && sweep.vary.empty()) return NoVariation{"there is no range to draw from", "--vary k1.stiffness=100:1000"};
  seed_ = sweep.seed.value_or(1);
  drawn_ = std::max(1L, std::max(sweep.random, sweep.latin));
  for (const std::string& text : sweep.vary) {
    if (draws) {
      auto range = read_range(text);
      if (auto* wrong = std::get_if<NoVariation>(&range)) return std::move(*wrong);
      ranges_.push_back(std::get<Range>(std::move(range)));
      paths_.push_back(ranges_.back().path);
    } else {
      auto variation = read_variation(text);
      if (auto* wrong = std::get_if<NoVariation>(&variation)) return std::move(*wrong);
      variations_.push_back(std::get<Variation>(std::move(variation)));
      paths_.push_back(variations_.back().path);
      if (grid_ <= most_runs) grid_ *= static_cast<long>(variations_.back().values.size());
    }
  }
  if (grid_ > most_runs || drawn_ > most_runs || rows_ > most_runs / (drawn_ * grid_))
    return NoVariation{fmt::format("these are more than {} runs", most_runs), "draw some of them: --latin 1000"};
  if (sweep.latin > 0)
    for (std::size_t range = 0; range < ranges_.size(); ++range) {
      auto& of_range = strata_.emplace_back(static_cast<std::size_t>(drawn_));
      std::iota(of_range.begin(), of_range.end(), 0U);
      // Knuth's shuffle (The Art of Computer Programming 2, 3.4.2 P).
      for (std::size_t k = of_range.size(); k > 1; --k) {
        const double u = unit_interval(random_bits(~seed_, k, range));
        std::swap(of_range[k - 1], of_range[static_cast<std::size_t>(u * static_cast<double>(k))]);
      }
    }
  return {};
}

double Design::fraction(long draw, std::size_t range) const {
  const double u = unit_interval(random_bits(seed_, static_cast<std::uint64_t>(draw), range));
  if (strata_.empty()) return u;
  return (strata_[range][static_cast<std::size_t>(draw)] + u) / static_cast<double>(drawn_);
}

std::vector<std::string> Design::point(long run) const {
  std::vector<std::string> values;
  const long inner = drawn_ * grid_;
  if (!list_.empty()) values = list_[static_cast<std::size_t>(run / inner)];
  long rest = run % inner, stride = inner;
  for (const Variation& variation : variations_) {
    stride /= static_cast<long>(variation.values.size());
    values.push_back(variation.values[static_cast<std::size_t>(rest / stride)]);
    rest %= stride;
  }
  for (std::size_t range = 0; range < ranges_.size(); ++range) values.push_back(ranges_[range].at(fraction(rest, range)));
  return values;
}

}  // namespace rheonet::tool
