#include "tests/series/chain.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tests/series/chain_force.hpp"
#include "tests/support/random.hpp"

namespace rheonet::test {

namespace {

constexpr std::uint64_t seed = 0x5e121e5;
constexpr std::array<const char*, 7> types = {"spring", "dashpot", "dashpot", "slider", "sfm", "vfm", "cfm"};
constexpr std::array<double, 5> exponents = {0, 0.5, 1, 1.5, 2};
constexpr std::array<double, 4> flow_indices = {0.5, 0.7, 1.4, 2};
constexpr double half_range = 1e6;  // 12 decades

/// With three digits, so that a netlist can be read and copied.
double short_number(double x) { return std::stod(fmt::format("{:.3g}", x)); }

class Maker {
 public:
  explicit Maker(int number) : random_(seed + static_cast<std::uint64_t>(number)) {
    chain_.number = number;
    chain_.kind = static_cast<Chain::Kind>(number % Chain::kinds);
  }

  Chain make() {
    const int count = 2 + random_.below(4);
    int elements = 0;
    for (int k = 0; k < count; ++k) {
      const bool several = chain_.kind != Chain::Kind::steady && random_.below(4) == 0;
      chain_.stages.emplace_back();
      for (int m = several ? 2 + random_.below(2) : 1; m > 0; --m) chain_.stages.back().push_back(member(elements++));
    }
    write();
    return std::move(chain_);
  }

 private:
  double value() { return short_number(random_.around(1, half_range)); }
  template <std::size_t n>
  double one_of(const std::array<double, n>& values) { return values[static_cast<std::size_t>(random_.below(static_cast<int>(n)))]; }

  Chain::Member member(int number) {
    const std::string type = types[static_cast<std::size_t>(random_.below(static_cast<int>(types.size())))];
    Chain::Member result{fmt::format("e{}", number), type, {}, 1};
    const auto add = [&](const char* name, double x) { result.values.emplace_back(name, x); };
    if (type == "spring" || type == "sfm" || type == "vfm" || type == "cfm") add("stiffness", value());
    if (type == "dashpot" || type == "vfm" || type == "cfm") add("damping", value());
    if (type == "slider" || type == "sfm" || type == "cfm") add("coulomb", value());
    if (type == "sfm" || type == "cfm") add("exponent", one_of(exponents));
    if (type == "dashpot" && random_.below(3) == 0) add("flow_index", one_of(flow_indices));
    if (chain_.kind != Chain::Kind::grouped) result.sign = random_.sign();
    return result;
  }

  std::string signal(bool steps) {
    const double x = value() * random_.sign();
    switch (random_.below(steps ? 4 : 3)) {
      case 0: return fmt::format("{{ ramp = {}, time = {:.3g} }}", x, random_.uniform(0.05, 0.4));
      case 1: return fmt::format("{{ sine = {}, frequency = {:.3g} }}", x, random_.uniform(0.5, 3));
      case 2: return fmt::format("{{ triangle = {}, frequency = {:.3g} }}", x, random_.uniform(0.5, 3));
      default: return fmt::format("{{ step = {}, time = {:.3g} }}", x, random_.uniform(0.05, 0.4));
    }
  }
  /// No steps of a position: what they do to dashpots is another matter.
  std::string motion(const char* name, const std::string& node) {
    const bool velocity = random_.below(2) == 0;
    return fmt::format("{} = {{ type = \"motion\", at = \"{}\", {} = {} }}\n", name, node, velocity ? "velocity" : "position",
                       signal(velocity));
  }

  static std::string law(const Chain::Member& m) {
    std::string text = fmt::format("type = \"{}\"", m.type);
    for (const auto& [name, x] : m.values) text += fmt::format(", {} = {}", name, x);
    return text;
  }

  void write() {
    using enum Chain::Kind;
    const std::string last = chain_.kind == between || chain_.kind == hung ? "last" : "ground";
    std::string text = fmt::format("title = \"chain {}\"\n", chain_.number);
    if (chain_.kind == grouped) text += "domain = \"rotation\"\n";
    text += "[elements]\n";
    if (chain_.kind == steady) {
      chain_.speed = value() * random_.sign();
      text += fmt::format("drive = {{ type = \"motion\", at = \"n0\", velocity = {} }}\n", chain_.speed);
    } else if (chain_.kind == pushed) {
      text += fmt::format("drive = {{ type = \"force\", at = \"n0\", force = {} }}\n", signal(true));
      if (random_.below(2) == 0) text += fmt::format("mass = {{ type = \"mass\", at = \"n0\", mass = {} }}\n", value());
    } else {
      text += motion("drive", "n0");
    }
    if (chain_.kind == between) text += motion("other", last);
    if (chain_.kind == hung) text += fmt::format("mass = {{ type = \"mass\", at = \"{}\", mass = {} }}\n", last, value());
    std::string records;
    const auto record = [&](const std::string& path) { records += fmt::format("{}\"{}.force\"", records.empty() ? "" : ", ", path); };
    if (chain_.kind == grouped) {
      text += "[elements.chain]\nbetween = [\"n0\", \"ground\"]\nseries = [\n";
      for (std::size_t k = 0; k < chain_.stages.size(); ++k) {
        const auto& stage = chain_.stages[k];
        if (stage.size() > 1) text += fmt::format("  {{ name = \"p{}\", parallel = [\n", k);
        for (const Chain::Member& m : stage) {
          text += fmt::format("  {{ name = \"{}\", {} }},\n", m.name, law(m));
          record(stage.size() > 1 ? fmt::format("chain.p{}.{}", k, m.name) : "chain." + m.name);
        }
        if (stage.size() > 1) text += "  ] },\n";
      }
      text += "]\n";
    } else {
      for (std::size_t k = 0; k < chain_.stages.size(); ++k) {
        for (const Chain::Member& m : chain_.stages[k]) {
          std::string a = fmt::format("n{}", k), b = k + 1 < chain_.stages.size() ? fmt::format("n{}", k + 1) : last;
          if (m.sign < 0) std::swap(a, b);
          text += fmt::format("{} = {{ between = [\"{}\", \"{}\"], {} }}\n", m.name, a, b, law(m));
          record(m.name);
        }
      }
    }
    chain_.toml = text + fmt::format("[simulate]\nstop = 1\noutput = {{ points = 101 }}\nrecord = [{}]\n", records);
  }

  Chain chain_{};
  Random random_;
};

}  // namespace

double Chain::Member::value(const std::string& parameter) const {
  for (const auto& [name, x] : values) {
    if (name == parameter) return x;
  }
  FAIL(name << " has no " << parameter);
  return 0;
}

bool Chain::Member::has(const std::string& parameter) const {
  return std::any_of(values.begin(), values.end(), [&](const auto& v) { return v.first == parameter; });
}

Chain random_chain(int number) { return Maker(number).make(); }

double stages_apart(const Chain& chain, const std::vector<std::vector<double>>& rows) {
  constexpr double grains = 16;
  std::vector<std::vector<double>> sums(rows.size(), std::vector<double>(chain.stages.size(), 0));
  std::vector<double> largest(chain.stages.size(), 0), largest_member = largest;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::size_t column = 0;
    for (std::size_t k = 0; k < chain.stages.size(); ++k) {
      for (const Chain::Member& m : chain.stages[k]) {
        const double f = m.sign * rows[i][column++];
        sums[i][k] += f;
        largest_member[k] = std::max(largest_member[k], std::abs(f));
      }
      largest[k] = std::max(largest[k], std::abs(sums[i][k]));
    }
  }
  double worst = 0;
  for (std::size_t k = 1; k < chain.stages.size(); ++k) {
    const double scale = std::max(largest[k - 1], largest[k]);
    const double rounding = grains * std::numeric_limits<double>::epsilon() * std::max(largest_member[k - 1], largest_member[k]);
    for (const std::vector<double>& sum : sums) {
      const double off = std::abs(sum[k] - sum[k - 1]) - rounding;
      if (scale > 0) worst = std::max(worst, off / scale);
    }
  }
  return worst;
}

double off_closed_form(const Chain& chain, const std::vector<double>& times, const std::vector<std::vector<double>>& rows) {
  const std::vector<double> force = force_of_steady_chain(chain, times);
  double scale = 0, off = 0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    scale = std::max(scale, std::abs(force[i]));
    for (std::size_t k = 0; k < chain.stages.size(); ++k) {
      off = std::max(off, std::abs(chain.stages[k].front().sign * rows[i][k] - force[i]));
    }
  }
  return off / scale;
}

}  // namespace rheonet::test
