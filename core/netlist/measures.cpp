#include "core/netlist/measures.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "core/netlist/characters.hpp"
#include "core/netlist/claim_values.hpp"
#include "core/netlist/records.hpp"

namespace rheonet {

namespace {

using Figure = Claim::Figure;

constexpr std::string_view option = "--measure ";
constexpr std::string_view spaces = " \t";

constexpr std::pair<const char*, Figure> measure_names[] = {
    {"max", Figure::max},
    {"min", Figure::min},
    {"mean", Figure::mean},
    {"rms", Figure::rms},
    {"final", Figure::final},
    {"value", Figure::at},
    {"time of max", Figure::time_of_max},
    {"time of min", Figure::time_of_min},
    {"time of crossing", Figure::crossing},
};

/// The parts of a measure, each a string with its place.
struct Parts {
  Figure figure = Figure::max;
  std::string name;   ///< of the figure
  TomlValue path;
  std::optional<TomlValue> argument;  ///< the time of `value`, the level of a crossing
  std::optional<TomlValue> from, to;
};

class Splitter {
 public:
  Splitter(const std::string& text, Sources& sources, DiagnosticList& diagnostics) : text_(text), diagnostics_(diagnostics) {
    sources.command_line.push_back(std::string(option) + text);
    line_ = static_cast<int>(sources.command_line.size());
  }

  std::optional<Parts> run() {
    Parts parts;
    const std::size_t open = text_.find('('), close = text_.find_last_not_of(spaces);
    if (open == text_.npos || text_[close] != ')') {
      diagnostics_.error(spot(0), "`" + printable(text_) + "` is no measure", "for instance max(k1.force)");
      return {};
    }
    if (!read_figure(parts, trimmed(0, open).text)) return {};
    std::size_t begin = open + 1;
    for (int number = 0; begin <= close; ++number) {
      const std::size_t end = std::min(text_.find(',', begin), close);
      if (!take(parts, trimmed(begin, end), number)) return {};
      begin = end + 1;
    }
    const bool takes_one = parts.figure == Figure::at || parts.figure == Figure::crossing;
    if (takes_one && !parts.argument) {
      const bool crossing = parts.figure == Figure::crossing;
      diagnostics_.error(spot(close), crossing ? "which level is crossed is missing" : "the time is missing",
                      parts.name + "(" + parts.path.text + (crossing ? ", 2 N)" : ", 0.2 s)"));
      return {};
    }
    return parts;
  }

 private:
  Spot spot(std::size_t byte) const {
    return {Spot::command_line, line_,
            static_cast<int>(1 + option.size() + count_characters(std::string_view(text_).substr(0, byte)))};
  }

  TomlValue trimmed(std::size_t begin, std::size_t end) const {
    begin = std::min(text_.find_first_not_of(spaces, begin), end);
    while (end > begin && spaces.find(text_[end - 1]) != spaces.npos) --end;
    TomlValue part;
    part.kind = TomlValue::Kind::string;
    part.spot = spot(begin);
    part.text = text_.substr(begin, end - begin);
    return part;
  }

  bool read_figure(Parts& parts, const std::string& name) {
    for (const auto& [known, figure] : measure_names) {
      if (name != known) continue;
      parts.figure = figure;
      parts.name = name;
      return true;
    }
    std::vector<std::string> names;
    for (const auto& [known, figure] : measure_names) names.emplace_back(known);
    diagnostics_.error(spot(0), "there is no measure `" + printable(name) + "` of a record",
                    did_you_mean(name, names, name == "crossing" ? "did you mean `time of crossing`?"
                                                                 : "there are " + list_names(names, "and")));
    return false;
  }

  bool take(Parts& parts, TomlValue part, int number) {
    if (part.text.empty()) {
      diagnostics_.error(part.spot, number == 0 ? "the record is missing that is to be measured" : "nothing stands here",
                      "for instance max(k1.force, from 1 s, to 2 s)");
      return false;
    }
    if (number == 0) {
      parts.path = std::move(part);
      return true;
    }
    const bool instant = parts.figure == Figure::at || parts.figure == Figure::final;
    for (const auto& [word, window] : {std::pair{"from ", &parts.from}, std::pair{"to ", &parts.to}}) {
      if (instant || *window || !part.text.starts_with(word)) continue;
      const std::size_t length = std::string_view(word).size();
      part.text.erase(0, length);
      part.spot.column += static_cast<int>(length);
      *window = std::move(part);
      return true;
    }
    const bool takes_one = parts.figure == Figure::at || parts.figure == Figure::crossing;
    if (takes_one && number == 1) {
      parts.argument = std::move(part);
      return true;
    }
    diagnostics_.error(part.spot, "`" + parts.name + "` does not take `" + printable(part.text) + "`",
                    instant ? "" : "`from TIME` and `to TIME` say where to look: max(k1.force, from 1 s, to 2 s)");
    return false;
  }

  const std::string& text_;
  DiagnosticList& diagnostics_;
  int line_ = 0;
};

}  // namespace

void read_measures(const std::vector<std::string>& texts, const Environment& environment,
                   const std::set<std::string>& doubtful, Context& context, Sources& sources, Scene& scene) {
  std::vector<Parts> measures;
  std::vector<TomlValue> paths;
  for (const std::string& text : texts)
    if (auto parts = Splitter(text, sources, context.diagnostics).run()) {
      paths.push_back(parts->path);
      measures.push_back(std::move(*parts));
    }
  const auto records = find_records(paths, doubtful, context, scene);
  const ClaimValues values(environment, context, scene);
  for (std::size_t i = 0; i < measures.size(); ++i) {
    const Parts& parts = measures[i];
    if (!records[i]) continue;
    Claim claim;
    claim.figure = parts.figure;
    claim.spot = parts.path.spot;
    if (parts.figure == Figure::at) claim.time = values.time(*parts.argument, "the time");
    if (parts.figure == Figure::crossing)
      claim.level = values.level(*parts.argument, "the level", one_of(unit_of(scene, *records[i])));
    claim.from = parts.from ? values.time(*parts.from, "`from`") : scene.start;
    claim.to = parts.to ? values.time(*parts.to, "`to`") : scene.stop;
    if (claim.from >= claim.to && claim.from <= scene.stop && claim.to >= scene.start)
      context.diagnostics.error((parts.to ? parts.to : parts.from)->spot, "`to` must be later than `from`");
    claim.record = claimed_index(*records[i], scene);
    scene.claims.push_back(claim);
  }
}

}  // namespace rheonet
