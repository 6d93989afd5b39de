#include "tools/rheonet/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

#include "core/netlist/signals.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

/// A parameter as text, for both forms of the reference.
struct Row {
  std::string name, symbol, quantity, units, bounds, fallback, description;
};

std::string short_number(double x) { return fmt::format("{:g}", x); }

const Parameter* find_parameter(const Declaration& declaration, const std::string& name) {
  const auto found = std::find_if(declaration.parameters.begin(), declaration.parameters.end(),
                                  [&name](const Parameter& p) { return p.name == name; });
  return found == declaration.parameters.end() ? nullptr : &*found;
}

// A damping whose unit depends on a flow index is printed with the symbol of the index: N*(s/m)^n.
std::string unit(const Parameter& parameter, const Declaration& declaration, Domain domain) {
  const Parameter* index = find_parameter(declaration, parameter.flow_index);
  if (index == nullptr) return unit_of(parameter.quantity, domain);
  const std::string sample = "0.5";  // Any index other than 1, so that the exponent is printed.
  std::string text = unit_of(parameter.quantity, domain, 0.5);
  if (const std::size_t at = text.rfind(sample); at != std::string::npos) {
    text.replace(at, sample.size(), index->symbol.empty() ? index->name : index->symbol);
  }
  return text;
}

std::string units(const Parameter& parameter, const Declaration& declaration) {
  if (parameter.unit == Parameter::Unit::own || parameter.unit == Parameter::Unit::divides || parameter.kind == Parameter::Kind::expression || parameter.kind == Parameter::Kind::table) return "any";
  if (parameter.unit == Parameter::Unit::input) return "of the input";
  if (parameter.unit == Parameter::Unit::output) return "of the output";
  const std::string translation = unit(parameter, declaration, Domain::translation);
  const std::string rotation = unit(parameter, declaration, Domain::rotation);
  if (translation == "1") return "-";
  return translation == rotation ? translation : translation + " | " + rotation;
}

std::string inputs(const Declaration::Inputs& inputs) {
  return inputs.most == 0 ? "none" : inputs.most == 1 ? "in = signal" : "in = [signal, ...]";
}

std::string quantity(const Parameter& parameter) {
  if (parameter.unit != Parameter::Unit::quantity) return "any";
  const std::string translation = name_of(parameter.quantity, Domain::translation);
  const std::string rotation = name_of(parameter.quantity, Domain::rotation);
  return translation == rotation ? translation : translation + " | " + rotation;
}

std::string bounds(const Parameter& p) {
  if (p.kind == Parameter::Kind::signal) return "a signal";
  if (p.kind == Parameter::Kind::characteristic) return "points";
  if (p.kind == Parameter::Kind::expression) return "an expression";
  if (p.kind == Parameter::Kind::table) return "points or a CSV file";
  if (p.kind == Parameter::Kind::coefficients) return "coefficients";
  std::string text;
  if (std::isinf(p.lower)) {
    text = std::isinf(p.upper) ? "any" : "<= " + short_number(p.upper);
  } else {
    text = (p.lower_open ? "> " : ">= ") + short_number(p.lower);
    if (!std::isinf(p.upper)) text += ", <= " + short_number(p.upper);
  }
  if (p.may_be_infinite) text += ", or inf";
  if (p.may_vary) text += ", or a signal";
  if (p.may_be_curve) text += ", or a curve over w";
  return text;
}

std::string fallback(const Parameter& p, const Declaration& declaration) {
  if (p.fallback) return short_number(*p.fallback);
  if (!p.same_as.empty()) return (p.opposite ? "-" : "") + p.same_as;
  if (p.kind == Parameter::Kind::initial || p.optional) return "not given";
  const std::vector<std::string>& choice = declaration.one_of;
  if (std::find(choice.begin(), choice.end(), p.name) != choice.end()) {
    return fmt::format("one of {}", fmt::join(choice, ", "));
  }
  return "required";
}

Row row(const Parameter& p, const Declaration& declaration) {
  return {
      .name = p.rotational_name.empty() ? p.name : p.name + " | " + p.rotational_name,
      .symbol = p.symbol,
      .quantity = quantity(p),
      .units = units(p, declaration),
      .bounds = bounds(p),
      .fallback = fallback(p, declaration),
      .description = p.description,
  };
}

std::string ports(const Declaration& declaration) {
  if (const auto& three = declaration.three; !three.empty()) return fmt::format("between = [{}, {}, {}]", three[0], three[1], three[2]);
  if (declaration.supported) return "between = [a, b], support = node";
  switch (declaration.ports) {
    case Declaration::Ports::between:
      return "between = [a, b]";
    case Declaration::Ports::at:
      return "at = node";
    case Declaration::Ports::at_or_between:
      return "at = node, or between = [a, b]";
    case Declaration::Ports::block:
      break;  // see inputs
  }
  return "";
}

/// The parameter values at which a limit applies, finite except for one or two infinite ones; empty for a limit at 0.
std::vector<double> values_at(const Limit& limit, const Declaration& declaration) {
  const std::size_t count = declaration.parameters.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      std::vector<double> values(count, 1);
      for (const std::size_t k : {i, j})
        if (declaration.parameters[k].may_be_infinite) values[k] = std::numeric_limits<double>::infinity();
      if (limit.applies(values)) return values;
    }
  }
  return {};
}

/// Whether the limit is a slip law that never slips.
bool is_rigid(const Limit& limit, const Declaration& declaration) {
  const Component* component = find_component(limit.becomes);
  if (component == nullptr || component->role != Role::slip) return false;
  const std::vector<double> values = values_at(limit, declaration);
  return !values.empty() && constant_box(*component, limit.values(values)).rigid();
}

std::string becomes(const Limit& limit, const Declaration& declaration) {
  if (limit.becomes.empty()) return "no force at all";
  if (is_rigid(limit, declaration)) return fmt::format("a rigid link (a `{}` that never slips)", limit.becomes);
  return find_component(limit.becomes)->hidden ? "a " + limit.becomes : fmt::format("a `{}`", limit.becomes);
}

/// The effects of an element, each with the value that removes it: "inertia (without it `mass = 0`)".
std::string effects_of(const Declaration& d) {
  std::vector<std::string> parts;
  for (const Brought& b : d.effects) {
    parts.push_back(in_words(b.effect) + (b.absent ? fmt::format(" (without it `{} = {:g}`)", b.parameter, *b.absent) : " (not left out alone)"));
  }
  std::string text = fmt::format("{}", fmt::join(parts, ", "));
  for (const Absence& a : d.absences) {
    if (a.effects.size() < 2) continue;
    std::vector<std::string> without;
    for (const Effect effect : a.effects) without.push_back(in_words(effect));
    for (const auto& [name, value] : a.values) text += fmt::format("; without both {}: `{} = {:g}`", fmt::join(without, " and "), name, value);
  }
  return text;
}

/// The notes, one for each line of the declaration.
std::vector<std::string> notes(const Declaration& d) { return d.notes.empty() ? std::vector<std::string>{} : split(d.notes, '\n'); }

// Escapes stars outside code, which would set text in italics.
std::string prose(const std::string& text) {
  std::string result;
  bool code = false;
  for (char c : text) {
    if (c == '`') code = !code;
    if (c == '*' && !code) result += '\\';
    result += c;
  }
  return result;
}

// Adds a capital letter and a full stop; a name in backquotes is not changed.
std::string sentence(std::string text) {
  if (text.empty()) return text;
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text.ends_with('.') ? text : text + '.';
}

// Names and units as code; alternatives separated by a bar are quoted separately.
std::string code(const std::string& text) {
  const std::size_t bar = text.find(" | ");
  if (text == "-" || text == "any" || text.starts_with("of the ")) return text;
  if (bar == std::string::npos) return "`" + text + "`";
  return "`" + text.substr(0, bar) + "` | `" + text.substr(bar + 3) + "`";
}

// Escapes bars, which would end the cell of a table.
std::string reference_cell(std::string text) {
  for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, "\\");
  return text;
}

}  // namespace

std::string as_list(const std::vector<const Component*>& components) {
  std::string text;
  for (const bool blocks : {false, true}) {
    text += blocks ? "\nsignal blocks\n" : "mechanical elements\n";
    for (const Component* component : components) {
      const Declaration& d = component->declaration;
      if ((d.ports == Declaration::Ports::block) != blocks) continue;
      const std::string names = d.rotational_type.empty() ? d.type : d.type + ", " + d.rotational_type;
      text += fmt::format("  {:<18}{}\n", names, wrapped(d.summary, 20));
    }
  }
  return text + "\n`rheonet components spring` shows the law and the parameters of one type\n";
}

std::string as_text(const Component& component) {
  const Declaration& d = component.declaration;
  std::string text = d.type;
  if (!d.rotational_type.empty()) text += " (in rotation also " + d.rotational_type + ")";
  text += " - " + d.summary + "\n";
  const auto line = [&text](const char* label, const std::string& value) {
    if (!value.empty()) text += fmt::format("  {:<8}{}\n", label, wrapped(value, 10));
  };
  const bool block = d.ports == Declaration::Ports::block;
  line(block ? "inputs" : "ports", block ? inputs(d.inputs) : ports(d));
  line("law", d.law);
  line("TeX", d.equation);

  const std::vector<std::string> titles = {"parameter", "symbol", "quantity", "unit", "value", "default"};
  std::vector<std::vector<std::string>> table = {titles};
  std::vector<std::string> descriptions = {""};
  for (const Parameter& p : d.parameters) {
    if (!p.second_of.empty()) continue;
    const Row r = row(p, d);
    table.push_back({r.name, r.symbol, r.quantity, r.units, r.bounds, r.fallback});
    descriptions.push_back(r.description);
  }
  std::vector<std::size_t> widths(titles.size());
  for (const auto& cells : table) {
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], cells[i].size());
  }
  for (std::size_t r = 0; r < table.size(); ++r) {
    std::string cells = " ";
    for (std::size_t i = 0; i < widths.size(); ++i) cells += fmt::format(" {:<{}} ", table[r][i], widths[i]);
    text += cells.substr(0, cells.find_last_not_of(' ') + 1) + "\n";
    if (!descriptions[r].empty()) text += "      " + wrapped(descriptions[r], 6) + "\n";
  }

  const bool signal = std::any_of(d.parameters.begin(), d.parameters.end(), [](const Parameter& p) { return p.kind == Parameter::Kind::signal || p.may_vary; });
  if (signal) line("signal", "a value, the output of a block ({ block = \"f\" }), or a table with one of " + list_names(SignalTemplate::shape_names(), "and") + ", which the netlist format explains");
  for (const Limit& limit : component.limits) line("limit", limit.when + ": " + becomes(limit, d));
  line("effects", effects_of(d));
  for (const std::string& note : notes(d)) line("note", note);
  line("source", d.source);
  return text;
}

std::string as_markdown(const std::vector<const Component*>& components) {
  std::string text =
      "<!-- generated by `rheonet components --markdown`: from here on nothing is written by hand -->\n\n"
      "Where two units or names are given, the first is for `domain = \"translation\"`, the second for `\"rotation\"`.\n";
  for (const Component* component : components) {
    const Declaration& d = component->declaration;
    text += fmt::format("\n## `{}`{}\n\n{}\n\n", d.type,
                        d.rotational_type.empty() ? "" : fmt::format(" (in rotation also `{}`)", d.rotational_type),
                        d.summary);
    const bool block = d.ports == Declaration::Ports::block;
    if (!d.equation.empty()) text += fmt::format("$${}$$\n\n", d.equation);
    text += fmt::format("    {}\n\n* {}: `{}`\n", d.law, block ? "Inputs" : "Ports", block ? inputs(d.inputs) : ports(d));
    for (const Limit& limit : component->limits) text += fmt::format("* `{}`: {}.\n", limit.when, becomes(limit, d));
    if (!d.effects.empty()) text += fmt::format("* Effects: {}.\n", effects_of(d));
    for (const std::string& note : notes(d)) text += fmt::format("* {}\n", prose(note));
    if (!d.source.empty()) text += fmt::format("* Source: {}.\n", prose(d.source));
    text += "\n| parameter | symbol | quantity | unit | value | default | |\n|---|---|---|---|---|---|---|\n";
    for (const Parameter& p : d.parameters) {
      if (!p.second_of.empty()) continue;
      const Row r = row(p, d);
      text +=
          fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", reference_cell(code(r.name)), reference_cell(r.symbol), reference_cell(r.quantity),
                      reference_cell(code(r.units)), reference_cell(r.bounds), reference_cell(r.fallback), reference_cell(prose(sentence(r.description))));
    }
  }
  return text;
}

}  // namespace rheonet::tool
