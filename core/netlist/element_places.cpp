// The nodes of an entry, and its repetition.
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/netlist/element_templates.hpp"
#include "core/netlist/table_reader.hpp"

namespace rheonet {

void TemplateReader::read_place(ElementTemplate& plan, Scope* scope, std::size_t ports, bool may_be_at, bool may_be_between, TableReader& reader) {
  DiagnosticList& diagnostics = context_.diagnostics;
  const TomlEntry* at = may_be_at && scope ? reader.find("at") : reader.find_quietly("at");
  const TomlEntry* between = may_be_between && scope ? reader.find("between") : reader.find_quietly("between");
  if (!scope) {
    for (const TomlEntry* entry : {at, between})
      if (entry)
        diagnostics.error(entry->spot, "a member of `series` or `parallel` has no `" + entry->key + "`",
                       "its place in the group says between which nodes it is");
    return;
  }
  const auto nodes = [&] { return ports == 2 ? "two nodes" : std::to_string(ports) + " nodes"; };
  const auto between_hint = [&]() -> std::string {
    if (plan.model && ports != 2) return "one for each port of the model";
    if (ports != 3) return "between = [\"a\", \"ground\"]";
    const std::vector<std::string>& three = context_.declarations[static_cast<std::size_t>(plan.declaration)]->three;
    return "between = [\"" + three[0] + "\", \"" + three[1] + "\", \"" + three[2] + "\"]";
  };
  if (at && !may_be_at) {
    diagnostics.error(at->spot, "`" + plan.name + "` is between " + nodes() + ", not `at` one", between_hint());
    return;
  }
  if (between && !may_be_between) {
    diagnostics.error(between->spot, "`" + plan.name + "` is `at` one node, not `between` several", "at = \"a\"");
    return;
  }
  if (at && between) {
    refuse_both(*at, *between, "`" + plan.name + "`", diagnostics);
    return;
  }
  if (!at && !between) {
    diagnostics.error(plan.spot,
                   "`" + plan.name + "` needs " +
                       list_names(may_be_at && may_be_between ? std::vector<std::string>{"at", "between"}
                                  : may_be_at                 ? std::vector<std::string>{"at"}
                                                              : std::vector<std::string>{"between"}),
                   may_be_between ? between_hint() : "at = \"a\"");
    return;
  }
  const auto take = [&](const TomlValue& value) {
    if (!expect_string(value, "the name of a node", diagnostics, value.kind == TomlValue::Kind::array ? "one node: at = \"cart\"" : "")) return;
    if (!expect_name(value.text, value.spot, "a node", diagnostics)) return;
    plan.nodes.push_back(scope->node(value.text, value.spot));
  };
  if (at) {
    plan.at = true;
    take(at->value);
    return;
  }
  if (!expect_array(between->value, "`between`", diagnostics, between_hint())) return;
  const auto& items = between->value.items;
  if (items.size() != ports && ports > 0) {
    diagnostics.error(between->value.spot, "`between` must name " + nodes() + ", but names " + std::to_string(items.size()),
                   between_hint());
    return;
  }
  for (const TomlValue& item : items) take(item);
  // The support comes last.
  if (!plan.model && plan.nodes.size() == 3) std::swap(plan.nodes[1], plan.nodes[2]);
  for (std::size_t i = 0; i < items.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (items[i].is_string() && items[j].is_string() && items[i].text == items[j].text)
        diagnostics.error(items[i].spot, "`between` names the node `" + items[i].text + "` twice",
                       "an element is between different nodes");
}

void TemplateReader::read_support(ElementTemplate& plan, Scope* scope, TableReader& reader) {
  DiagnosticList& diagnostics = context_.diagnostics;
  const TomlEntry* entry = reader.find("support");
  if (!entry || !expect_string(entry->value, "`support`", diagnostics, "the node against which it turns: support = \"carrier\"")) return;
  if (!scope) {
    diagnostics.error(entry->spot, "a member of `series` or `parallel` has no `support`", "give it an entry of its own in [elements]");
    return;
  }
  if (!expect_name(entry->value.text, entry->value.spot, "a node", diagnostics)) return;
  const int support = scope->node(entry->value.text, entry->value.spot);
  if (std::find(plan.nodes.begin(), plan.nodes.end(), support) != plan.nodes.end()) {
    diagnostics.error(entry->value.spot, "`support` names the node `" + entry->value.text + "`, which `between` names too",
                      "a transmission turns against a third node; without `support` that is ground");
    return;
  }
  plan.nodes.push_back(support);
}

void TemplateReader::read_domain(ElementTemplate& plan, TableReader& reader) {
  const TomlEntry* entry = reader.find("domain");
  if (!entry || !expect_string(entry->value, "`domain`", context_.diagnostics)) return;
  const std::string& text = entry->value.text;
  if (text == "translation" || text == "rotation") {
    plan.domain = text == "rotation" ? Domain::rotation : Domain::translation;
  } else {
    context_.diagnostics.error(entry->value.spot, "`domain` must be `translation` or `rotation`, but is `" + text + "`",
                               did_you_mean(text, {"translation", "rotation"}));
  }
}

void TemplateReader::read_repeat(ElementTemplate& plan, TableReader& reader) {
  DiagnosticList& diagnostics = context_.diagnostics;
  const TomlEntry* entry = reader.find("repeat");
  if (!entry ||
      !expect_table(entry->value, "`repeat`", diagnostics, "repeat = { count = 10, as = \"i\", arrange = \"series\" }"))
    return;
  TableReader repeat_keys(entry->value, "`repeat`");
  Repeat repeat;
  const auto is_block = [&] { return context_.declarations[static_cast<std::size_t>(plan.declaration)]->ports == Declaration::Ports::block; };
  const bool chainable = plan.kind == ElementTemplate::Kind::element    ? !plan.at && !is_block() && plan.nodes.size() <= 2
                         : plan.kind == ElementTemplate::Kind::instance ? plan.model->ports.size() == 2
                                                             : true;
  repeat.series = chainable;
  if (const TomlEntry* count = repeat_keys.require("count", entry->spot, "repeat = { count = 10 }"))
    repeat.count = Formula(count->value, "`count`", diagnostics);
  if (const TomlEntry* as = repeat_keys.find("as"); as && expect_string(as->value, "`as`", diagnostics)) {
    if (as->value.text == "n")
      diagnostics.error(as->value.spot, "`as` cannot be `n`: that is the count", "choose another name");
    else if (expect_identifier(as->value.text, as->value.spot, "the number of a member", diagnostics))
      repeat.as = as->value.text;
  }
  if (const TomlEntry* arrange = repeat_keys.find("arrange");
      arrange && expect_string(arrange->value, "`arrange`", diagnostics)) {
    const std::string& text = arrange->value.text;
    if (text != "series" && text != "parallel")
      diagnostics.error(arrange->value.spot, "`arrange` must be `series` or `parallel`, but is `" + text + "`",
                     did_you_mean(text, {"series", "parallel"}));
    else if (text == "series" && !chainable)
      diagnostics.error(arrange->value.spot, "only what is between two nodes can be repeated in series",
                     "arrange = \"parallel\"");
    else
      repeat.series = text == "series";
  }
  repeat_keys.finish(diagnostics);
  plan.repeat = std::move(repeat);
}

}  // namespace rheonet
