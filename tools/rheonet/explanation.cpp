#include "tools/rheonet/explanation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/base/format_list.hpp"
#include "core/netlist/characters.hpp"
#include "core/network/reductions.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

constexpr std::size_t names_shown = 6;

std::string plural(std::size_t count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

/// As in "2.3 ms": two digits, because a prediction is no more accurate.
std::string duration(double seconds) {
  const std::pair<double, const char*> units[] = {{1, "s"}, {1e-3, "ms"}, {1e-6, "us"}};
  const auto* unit = std::find_if(std::begin(units), std::end(units) - 1, [&](const auto& u) { return seconds >= u.first; });
  const double value = seconds / unit->first;
  const double step = value > 0 ? std::pow(10, std::floor(std::log10(value)) - 1) : 1;
  return fmt::format("{:g} {}", std::round(value / step) * step, unit->second);
}

Passage::Line plain(std::string text) { return {.label = "", .text = std::move(text)}; }

Passage effects_of(const Explanation& e) {
  Passage passage{.heading = "effects"};
  std::string absent;
  for (const Explanation::EffectFound& effect : e.effects) {
    const std::string name = in_words(effect.effect);
    if (effect.by.empty() && effect.left_out.empty()) absent += (absent.empty() ? "" : ", ") + name;
    if (!effect.by.empty()) passage.lines.push_back({.label = name, .text = format_list(effect.by, names_shown)});
    if (!effect.left_out.empty()) passage.lines.push_back({.label = name, .text = "left out of " + format_list(effect.left_out, names_shown)});
  }
  if (!absent.empty()) passage.lines.push_back(plain("nothing here brings " + absent));
  return passage;
}

Passage unknowns_of(const Explanation& e) {
  const Explanation::Structure& s = e.structure;
  Passage passage{.heading = fmt::format("unknowns: {} at the start, {} integrated and {} that follow at every instant", e.cost.unknowns,
                                         s.differential, s.algebraic)};
  for (const Explanation::Unknowns& u : e.unknowns) {
    passage.lines.push_back(plain(fmt::format("{} of {}{}: {}", u.quantity, format_list(u.names, names_shown),
                                              u.unit.empty() ? "" : " [" + u.unit + "]", u.equation)));
  }
  if (e.cost.unknowns == 0) passage.lines.push_back(plain("none: every motion is given, and each force follows from it"));
  return passage;
}

Passage omissions_of(const Explanation& e) {
  Passage passage{.heading = "left out"};
  for (const Explanation::Omission& o : e.left_out) {
    const std::string keep = o.reduction.empty() ? "" : fmt::format(" (--keep {})", o.reduction);
    passage.lines.push_back(plain(fmt::format("{} {}: {}{}", o.what, format_list(o.names, names_shown), o.reason, keep)));
  }
  if (e.left_out.empty()) passage.lines.push_back(plain("nothing"));
  return passage;
}

std::string integrations_of(const Explanation::Structure& s) {
  if (s.integrations < 2) return "";
  return fmt::format("; {} are integrated with steps of their own (--keep {})",
                     s.integrations == s.parts ? "they" : fmt::format("{} groups of them", s.integrations), name_of(Reduction::parts));
}

Passage structure_of(const Explanation& e) {
  const Explanation::Structure& s = e.structure;
  Passage passage{.heading = "structure"};
  const auto add = [&passage](std::string text) { passage.lines.push_back(plain(std::move(text))); };
  add(fmt::format("index {} as wired, {} as solved{}", s.index_as_wired, s.index, s.because.empty() ? "" : "; " + s.because));
  if (s.loops > 0) add(fmt::format("{} through which deflections depend on each other", plural(static_cast<std::size_t>(s.loops), "loop")));
  add(s.parts == 1 ? "one part: everything in it may feel everything else"
                   : fmt::format("{} independent parts: what happens in one is not felt in another{}", s.parts, integrations_of(s)));
  return passage;
}

Passage events_of(const Explanation& e) {
  if (e.events.empty()) return {.heading = "events: none can occur, and none is looked for"};
  Passage passage{.heading = "events that can occur"};
  for (const Explanation::Events& event : e.events)
    passage.lines.push_back(plain(fmt::format("{}: {}", format_list(event.names, names_shown), event.kinds)));
  return passage;
}

Passage cost_of(const Scene& scene, const Explanation& e) {
  const Explanation::Cost& c = e.cost;
  Passage passage{.heading = "cost"};
  const auto add = [&passage](std::string text) { passage.lines.push_back(plain(std::move(text))); };
  add(c.why_ida.empty() ? "solved in closed form between events: laws and inputs are linear there" : "solved by SUNDIALS IDA: " + c.why_ida + (e.structure.integrations > 1 ? "; parts without it by themselves" : ""));
  if (c.unknowns > 0)
    add(fmt::format("entries of the Jacobian: {}, factorised {}", c.entries, c.sparse ? "as a sparse matrix (KLU)" : "as a dense matrix"));
  std::vector<std::string> times;
  const auto add_time = [&times](const char* of, double rate) {
    if (rate > 0 && std::isfinite(1 / rate)) times.push_back(fmt::format("{} ({})", duration(1 / rate), of));
  };
  add_time("the network", c.fastest_rate);
  add_time("the drives", c.fastest_drive);
  if (!times.empty()) add(fmt::format("shortest time scale, 1/omega: {}", fmt::join(times, ", ")));
  if (c.known_instants > 0) add(plural(static_cast<std::size_t>(c.known_instants), "start") + " of the integrator at jumps and corners of signals");
  if (c.tried >= 1) {
    add(fmt::format("{} to accuracy {:g}: {} of CPU time", plural(static_cast<std::size_t>(c.steps), "step"), scene.accuracy, duration(c.seconds())));
  } else if (c.tried_steps > 0) {
    add(fmt::format("about {:.2g} steps to accuracy {:g}, {} each: {} of CPU time, if the rest of the run resembles the first {} steps, "
                    "{:.2g} % of it",
                    c.steps, scene.accuracy, duration(c.seconds_a_step), duration(c.seconds()), c.tried_steps, 100 * c.tried));
  }
  return passage;
}

}  // namespace

std::vector<Passage> passages(const Scene& scene, const Explanation& e) {
  std::vector<Passage> all{effects_of(e), unknowns_of(e), omissions_of(e), structure_of(e), events_of(e), cost_of(scene, e)};
  if (e.notes.empty()) return all;
  Passage& notes = all.emplace_back(Passage{.heading = "notes"});
  for (const std::string& note : e.notes) notes.lines.push_back(plain(note));
  return all;
}

std::string describe(const Scene& scene, const std::string& file, const Explanation& e) {
  std::string text = fmt::format("{}: {}\n", printable(file), scene.title.empty() ? "untitled" : printable(scene.title));
  for (const Passage& passage : passages(scene, e)) {
    text += "\n" + passage.heading + "\n";
    for (const auto& [label, words] : passage.lines) {
      // Continuation lines are indented to the text after the label, or by 4 without a label.
      text += label.empty() ? "  " + wrapped(words, 4) : fmt::format("  {:<13}", label) + wrapped(words, 15);
      text += "\n";
    }
  }
  return text;
}

std::string to_json(const Scene& scene, const Explanation& e) {
  using Json = nlohmann::ordered_json;
  Json json{{"title", scene.title}};
  for (const Explanation::EffectFound& effect : e.effects)
    json["effects"].push_back({{"effect", name_of(effect.effect)}, {"brought_by", effect.by}, {"left_out_of", effect.left_out}});
  json["unknowns"] = Json::array();
  for (const Explanation::Unknowns& u : e.unknowns)
    json["unknowns"].push_back({{"quantity", u.quantity}, {"unit", u.unit}, {"determined_by", u.equation}, {"integrated", u.differential},
                                {u.of_nodes ? "nodes" : "elements", u.names}});
  json["left_out"] = Json::array();
  for (const Explanation::Omission& o : e.left_out)
    json["left_out"].push_back({{"reduction", o.reduction}, {"what", o.what}, {"reason", o.reason}, {o.of_nodes ? "nodes" : "elements", o.names}});
  const Explanation::Structure& s = e.structure;
  json["structure"] = {{"index_as_wired", s.index_as_wired}, {"because", s.because},   {"index", s.index}, {"integrated", s.differential},
                       {"algebraic", s.algebraic},           {"loops", s.loops},       {"parts", s.parts},
                       {"integrations", s.integrations}};
  json["events"] = Json::array();
  for (const Explanation::Events& event : e.events) json["events"].push_back({{"kinds", event.kinds}, {"elements", event.names}});
  const Explanation::Cost& c = e.cost;
  json["cost"] = {{"unknowns", c.unknowns},           {"entries", c.entries},
                  {"sparse", c.sparse},               {"fastest_rate", c.fastest_rate},
                  {"fastest_drive", c.fastest_drive}, {"known_instants", c.known_instants},
                  {"tried_steps", c.tried_steps},     {"tried", c.tried},
                  {"steps", c.steps},                 {"seconds_a_step", c.seconds_a_step},
                  {"closed_form", c.why_ida.empty()}, {"why_ida", c.why_ida},
                  {"seconds", c.seconds()}};
  json["notes"] = e.notes;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace rheonet::tool
