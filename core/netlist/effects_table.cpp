#include "core/netlist/effects_table.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/netlist/table_reader.hpp"
#include "core/netlist/values.hpp"

namespace rheonet {

namespace {

/// A list of effects, from the netlist or the command line.
class EffectList {
 public:
  enum class Purpose { leave_out, keep };
  EffectList(Context& context, const Scene& scene, Purpose purpose)
      : declarations_(context.declarations), diagnostics_(context.diagnostics), scene_(scene), purpose_(purpose) {}

  void add(const TomlValue& word) {
    if (!expect_string(word, "an effect", diagnostics_, "one of " + list_names(names()))) return;
    const std::size_t colon = word.text.find(':');
    const std::string name = word.text.substr(0, colon);
    const std::optional<Effect> effect = find_effect(name);
    if (!effect) {
      diagnostics_.error(diagnostics_.inside(word, 0), "there is no effect `" + name + "`",
                      did_you_mean(name, names(), "the effects are " + list_names(names(), "and")));
      return;
    }
    EffectLeftOut out{*effect, colon == std::string::npos ? "" : word.text.substr(colon + 1)};
    if (colon != std::string::npos && !names_something(out)) {
      diagnostics_.error(diagnostics_.inside(word, colon + 1), "nothing is called `" + out.of + "`", did_you_mean(out.of, paths()));
      return;
    }
    if (purpose_ == Purpose::leave_out && !brought(out)) {
      diagnostics_.warning(diagnostics_.inside(word, 0), "nothing" + (out.of.empty() ? " in the scene" : " in `" + out.of + "`") + " has " +
                                                       in_words(*effect) + ": to leave it out changes nothing", what_is_brought(out.of));
    }
    found_.push_back(std::move(out));
  }

  void add_all(const TomlEntry& list) {
    if (!expect_array(list.value, "`" + list.key + "`", diagnostics_, list.key + " = [\"inertia\", \"delay\"]")) return;
    for (const TomlValue& word : list.value.items) add(word);
  }

  const std::vector<EffectLeftOut>& found() const { return found_; }

  /// All effects except those of the list. An effect kept for some elements is left out of all others.
  std::vector<EffectLeftOut> all_others() const {
    std::vector<EffectLeftOut> result;
    for (const Effect effect : effects()) {
      const auto kept = [&](const std::string& element) {
        return std::any_of(found_.begin(), found_.end(),
                           [&](const EffectLeftOut& e) { return e.effect == effect && e.concerns(element); });
      };
      const bool anywhere = std::any_of(found_.begin(), found_.end(), [&](const EffectLeftOut& e) { return e.effect == effect; });
      if (!anywhere) {
        result.push_back({effect});
        continue;
      }
      for (const SceneElement& element : scene_.elements) {
        if (!kept(element.name)) result.push_back({effect, element.name});
      }
    }
    return result;
  }

 private:
  static std::vector<std::string> names() {
    std::vector<std::string> result;
    for (const Effect effect : effects()) result.push_back(name_of(effect));
    return result;
  }
  bool names_something(const EffectLeftOut& out) const {
    return !out.of.empty() && std::any_of(scene_.elements.begin(), scene_.elements.end(),
                                          [&](const SceneElement& e) { return out.concerns(e.name); });
  }
  bool brought(const EffectLeftOut& out) const {
    if (out.effect == Effect::feedback) return !scene_.sensed.empty();
    return std::any_of(scene_.elements.begin(), scene_.elements.end(), [&](const SceneElement& e) {
      const std::vector<Effect> here = declared_effects(*declarations_[static_cast<std::size_t>(e.declaration)], e.values);
      return out.concerns(e.name) && std::find(here.begin(), here.end(), out.effect) != here.end();
    });
  }
  std::string what_is_brought(const std::string& of) const {
    std::vector<std::string> names;
    for (const Effect effect : effects()) {
      if (brought({effect, of})) names.push_back(name_of(effect));
    }
    return names.empty() ? "" : "its effects are " + list_names(names, "and");
  }
  /// Paths of all elements, and of the assemblies and instances around them.
  std::vector<std::string> paths() const {
    std::set<std::string> result;
    for (const SceneElement& element : scene_.elements) {
      for (std::size_t end = element.name.find('.'); end != std::string::npos; end = element.name.find('.', end + 1)) {
        result.insert(element.name.substr(0, end));
      }
      result.insert(element.name);
    }
    return {result.begin(), result.end()};
  }

  Declarations declarations_;
  DiagnosticList& diagnostics_;
  const Scene& scene_;
  Purpose purpose_;
  std::vector<EffectLeftOut> found_;
};

/// Adds words of the command line as values with places, so that messages can point at them.
void add_words(const std::vector<std::string>& words, const std::string& option, Sources& sources, EffectList& list) {
  for (const std::string& word : words) {
    sources.command_line.push_back(option + " " + word);
    TomlValue value;
    value.kind = TomlValue::Kind::string;
    value.text = word;
    value.spot = {Spot::command_line, static_cast<int>(sources.command_line.size()), 2 + static_cast<int>(option.size())};
    list.add(value);
  }
}

}  // namespace

std::vector<Effect> declared_effects(const Declaration& declaration, std::span<const double> values) {
  std::vector<Effect> result;
  for (const Brought& brought : declaration.effects) {
    const auto parameter = std::find_if(declaration.parameters.begin(), declaration.parameters.end(),
                                        [&](const Parameter& p) { return p.name == brought.parameter; });
    const double value = values[static_cast<std::size_t>(parameter - declaration.parameters.begin())];
    // A parameter that varies in time has no value here. A contact remains one where it is rigid.
    const bool there = brought.otherwise ? value != *brought.absent : !(value <= 0) && (!std::isinf(value) || brought.effect == Effect::contact);
    if (there && std::find(result.begin(), result.end(), brought.effect) == result.end()) result.push_back(brought.effect);
  }
  return result;
}

void read_effects(const TomlEntry* table, const std::vector<std::string>& without, const std::optional<std::vector<std::string>>& only,
                  Context& context, Sources& sources, Scene& scene) {
  EffectList out(context, scene, EffectList::Purpose::leave_out), stay(context, scene, EffectList::Purpose::keep);
  bool some_stay = only.has_value();
  if (table && expect_table(table->value, "`effects`", context.diagnostics, "[effects] with without = [...] or only = [...]")) {
    TableReader reader(table->value, "[effects]");
    const TomlEntry* table_without = reader.find("without");
    const TomlEntry* table_only = reader.find("only");
    reader.finish(context.diagnostics);
    if (table_without && table_only) refuse_both(*table_without, *table_only, "[effects]", context.diagnostics);
    if (table_without && !only) out.add_all(*table_without);
    if (table_only && !only) {
      stay.add_all(*table_only);
      some_stay = true;
    }
  }
  add_words(without, "--without", sources, out);
  if (only) add_words(*only, "--only", sources, stay);
  if (some_stay) scene.without = stay.all_others();
  scene.without.insert(scene.without.end(), out.found().begin(), out.found().end());
}

}  // namespace rheonet
