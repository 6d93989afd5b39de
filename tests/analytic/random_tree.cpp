#include "tests/analytic/random_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <random>

namespace rheonet::test {

namespace {

class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_(seed), named_(seed % 2 == 0) {}

  RandomTree tree() {
    RandomTree result;
    const bool series = pick(2) == 0;
    const std::string members = group(series, "end", "ground", 0);
    result.composed = fmt::format("[elements.tree]\nbetween = [\"end\", \"ground\"]\n{} = {}\n",
                                  series ? "series" : "parallel", members);
    for (const std::string& line : lines_) result.wired += line;
    std::shuffle(lines_.begin(), lines_.end(), random_);
    for (const std::string& line : lines_) result.shuffled += line;
    result.elements = elements_;
    return result;
  }

 private:
  std::size_t pick(std::size_t count) { return random_() % count; }
  /// Between 1 and `ratio` times `low`; no round numbers.
  double value(double low, double ratio) { return low * (1 + (ratio - 1) * double(random_() % 99991) / 99991); }

  // Members of the same kind as their group would only be more members of it, so the kinds alternate.
  std::string group(bool series, const std::string& a, const std::string& b, int depth) {
    const std::size_t count = 2 + pick(3);
    std::string text = "[ ", from = a;
    for (std::size_t j = 0; j < count; ++j) {
      const std::string to = !series || j + 1 == count ? b : fmt::format("n{:02}", nodes_++);
      if (depth < 3 && pick(3) == 0) {
        text += fmt::format("{{ {} = {} }}, ", series ? "parallel" : "series", group(!series, from, to, depth + 1));
      } else {
        text += leaf(from, to);
      }
      if (series) from = to;
    }
    return text + "]";
  }

  std::string leaf(const std::string& a, const std::string& b) {
    static const char* const types[] = {"spring", "dashpot", "vfm", "sfm", "cfm"};
    const std::string type = types[pick(5)];
    std::string values;
    if (type != "dashpot") values += fmt::format(", stiffness = {:.17g}", value(70, 4));
    if (type == "sfm" || type == "cfm") {
      values += fmt::format(", coulomb = {:.17g}, exponent = {}", value(1.3, 3), 1 + 0.5 * double(pick(3)));
    }
    if (type == "dashpot" || type == "vfm" || type == "cfm") values += fmt::format(", damping = {:.17g}", value(4, 5));

    const std::string wired = fmt::format("e{:02}", lines_.size());
    lines_.push_back(
        fmt::format("{} = {{ type = \"{}\", between = [\"{}\", \"{}\"]{} }}\n", wired, type, a, b, values));
    const int number = ++count_[type];
    elements_.emplace_back("tree." + (named_ ? wired : fmt::format("{}{}", type, number)), wired);
    return fmt::format("{{ {}type = \"{}\"{} }}, ", named_ ? fmt::format("name = \"{}\", ", wired) : "", type, values);
  }

  std::mt19937_64 random_;
  bool named_;
  int nodes_ = 0;
  std::map<std::string, int> count_;
  std::vector<std::string> lines_;
  std::vector<std::pair<std::string, std::string>> elements_;
};

}  // namespace

RandomTree random_tree(std::uint64_t seed) { return Maker(seed).tree(); }

}  // namespace rheonet::test
