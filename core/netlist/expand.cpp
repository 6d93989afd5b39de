#include "core/netlist/expand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/netlist/characteristic.hpp"
#include "core/netlist/group_names.hpp"
#include "core/netlist/laws.hpp"

namespace rheonet {

namespace {

/// Limit on nested groups and models: each level takes stack.
constexpr int most_nested = 500;

constexpr NodeId no_node = std::numeric_limits<NodeId>::min();

std::string joined(const std::string& path, const std::string& name) { return path.empty() ? name : path + '.' + name; }

/// The number of members of a repeat, a whole number of at least 1; absent, with a mistake, otherwise.
std::optional<double> member_count(const Repeat& repeat, const Environment& environment, Context& context) {
  const auto wanted = repeat.count.evaluate(environment, Quantity::number, context.domain, context.diagnostics);
  if (!wanted || (*wanted >= 1 && *wanted == std::floor(*wanted))) return wanted;
  context.diagnostics.error(repeat.count.source().spot,
                         "`count` must be a whole number of at least 1, but is " + number_text(*wanted));
  return {};
}

/// The overrides inside a repeat of `count` members, each with the index of its member.
std::vector<std::pair<std::size_t, ActiveOverride>> by_member(const ActiveOverrides& overrides, std::size_t count,
                                                              const std::string& path, DiagnosticList& diagnostics) {
  std::vector<std::pair<std::size_t, ActiveOverride>> members;
  for (const ActiveOverride& active : overrides) {
    const std::string& name = active.next().name;
    const double index = name.size() < 10 ? std::stod(name) : std::numeric_limits<double>::infinity();
    if (index < static_cast<double>(count)) {
      members.emplace_back(static_cast<std::size_t>(index), active.deeper());
    } else {
      diagnostics.error(active.next().spot, "`" + path + "` has no member " + name,
                     "its members are `" + path + ".0` to `" + path + "." + std::to_string(count - 1) + "`");
    }
  }
  return members;
}

/// Gives `variable` another value during its lifetime.
template <class T>
class Instead {
 public:
  Instead(T& variable, T value) : variable_(variable), before_(std::exchange(variable, std::move(value))) {}
  ~Instead() { variable_ = std::move(before_); }
  Instead(const Instead&) = delete;
  Instead& operator=(const Instead&) = delete;

 private:
  T& variable_;
  T before_;
};

/// Reserves for `count` copies of the items added since there were `before`. At least doubles the room: an exact reserve in each of nested
/// repeats would copy the list each time.
template <class T>
void make_room(std::vector<T>& items, std::size_t before, std::size_t count) {
  const std::size_t wanted = before + (items.size() - before) * count;
  if (wanted > items.capacity()) items.reserve(std::max(wanted, 2 * items.capacity()));
}

}  // namespace

void Expander::run(Scope& scope, const Environment& environment, const ActiveOverrides& overrides) {
  if (scene_.nodes.empty()) scene_.nodes.push_back({"ground", 0, 0, {}});
  const std::string top;
  Locals locals{scope, top, {}};
  entries(locals, top, environment, overrides, 0);
}

NodeId Expander::new_node(std::string name, Spot spot) {
  scene_.nodes.push_back({std::move(name), not_given, not_given, spot});
  return static_cast<NodeId>(scene_.nodes.size()) - 1;
}

bool Expander::refuse_number(Spot spot) {
  context_.diagnostics.error(spot, "the scene has more than " + std::to_string(most_elements) + " elements");
  stopped_ = true;
  return false;
}

NodeId Expander::node(Locals& locals, int index) {
  if (index == Scope::ground) return ground;
  const auto i = static_cast<std::size_t>(index);
  if (locals.ids.size() < locals.scope.nodes.size()) locals.ids.resize(locals.scope.nodes.size(), no_node);
  if (locals.ids[i] == no_node) {
    const Scope::Node& named = locals.scope.nodes[i];
    locals.ids[i] = new_node(joined(locals.prefix, named.name), named.spot);
  }
  return locals.ids[i];
}

bool Expander::entries(Locals& locals, const std::string& prefix, const Environment& environment,
                       const ActiveOverrides& overrides, int depth) {
  bool good = true;
  std::vector<NodeId> ends;
  for (std::size_t i = 0; i < locals.scope.entries.size() && !stopped_; ++i) {
    const ElementTemplate& plan = locals.scope.entries[i];
    ActiveOverrides own, deeper;
    for (const ActiveOverride& active : overrides)
      if (active.next().name == plan.name) own.push_back(active.deeper());
    const ElementTemplate& final_plan = own.empty() ? plan : overridden(plan, &locals.scope, own, false, deeper);
    bool expanded = final_plan.sound;
    if (expanded) {
      ends.clear();
      for (const int index : final_plan.nodes) ends.push_back(node(locals, index));
      // The element of a law has the path of the instance.
      const std::string path = inside_.law && plan.name == law_element ? prefix : joined(prefix, plan.name);
      expanded = entry(final_plan, ends, path, {&locals.scope, environment, deeper, depth, nullptr});
    }
    if (!expanded && depth == 0) failed_.insert(plan.name);
    good = good && expanded;
  }
  return good;
}

bool Expander::entry(const ElementTemplate& plan, Ends ends, const std::string& path, const Surroundings& around) {
  return plan.repeat ? repeat(plan, ends, path, around) : body(plan, ends, path, around);
}

bool Expander::body(const ElementTemplate& plan, Ends ends, const std::string& path, const Surroundings& around) {
  if (around.depth > most_nested) {
    context_.diagnostics.error(plan.spot,
                            "groups and models are nested deeper than " + std::to_string(most_nested) + " levels");
    return false;
  }
  const Instead domain(domain_, plan.domain ? plan.domain : domain_);
  switch (plan.kind) {
    case ElementTemplate::Kind::element:
      return element(plan, ends, path, around);
    case ElementTemplate::Kind::instance:
      return instance(plan, ends, path, around);
    default:
      return group(plan, ends, path, around);
  }
}

bool Expander::element(const ElementTemplate& plan, Ends ends, const std::string& path, const Surroundings& around) {
  if (scene_.elements.size() >= most_elements) return refuse_number(plan.spot);
  SceneElement element;
  if (without_values_) element.domain = domain_;
  const Domain usual = context_.domain;
  if (domains_) element.domain = domain_at(path);
  const Instead in_its_domain(context_.domain, element.domain.value_or(usual));
  if (!without_values_ && !(fits_domain(plan, path) && element_values(plan, around.environment, element))) return false;
  element.name = path;
  element.declaration = plan.declaration;
  element.a = ends.empty() ? ground : ends[0];
  element.b = plan.at ? ground : ends[1];
  if (ends.size() == 3) element.support = ends[2];
  element.at = plan.at;
  const Declaration& declared = *context_.declarations[static_cast<std::size_t>(plan.declaration)];
  if (inside_.law && declared.ports == Declaration::Ports::block)
    element.part = declared.inputs.integrates ? SceneElement::Part::state : SceneElement::Part::inner;
  element.spot = plan.spot;
  // A source (motion or force) has the force that it applies; any other element has the force applied to it.
  if (around.force)
    around.force->push_back({static_cast<int>(scene_.elements.size()), declared.is_source() ? -1.0 : 1.0});
  scene_.elements.push_back(std::move(element));
  if (!without_values_) connection(plan, around.environment, static_cast<int>(scene_.elements.size()) - 1);
  return true;
}

Domain Expander::domain_at(const std::string& path) const {
  if (!domains_) return context_.domain;
  const auto found = domains_->find(path);
  return found == domains_->end() ? context_.domain : found->second.domain;
}

/// Whether the names of the parameters are those of the element's domain. A model may use the names of translation in both.
bool Expander::fits_domain(const ElementTemplate& plan, const std::string& path) {
  if (!domains_) return true;
  for (const Parameter& parameter : context_.declarations[static_cast<std::size_t>(plan.declaration)]->parameters) {
    const bool rotation = context_.domain == Domain::rotation;
    if (parameter.rotational_name.empty() || (plan.in_model && rotation)) continue;
    const std::string& other = rotation ? parameter.name : parameter.rotational_name;
    const TomlEntry* entry = plan.source->find(other);
    if (!entry) continue;
    const char* here = rotation ? "rotation" : "translation";
    const auto found = domains_->find(path);
    const std::string by = found == domains_->end() || found->second.by.empty() ? "" : ", by " + found->second.by;
    const std::string meant = by.empty() ? "" : fmt::format("; if `{}` is to be of {}, only a `rack` or a `screw` joins it to the other", plan.name, rotation ? "translation" : "rotation");
    context_.diagnostics.error(
        entry->spot, fmt::format("`{}` is called `{}` in {}, and `{}` is of {}{}", other, parameter.name_in(context_.domain), here, plan.name, here, by),
        "write `" + parameter.name_in(context_.domain) + "`" + meant);
    return false;
  }
  return true;
}

/// Evaluates one value, or takes its default; false if the value is invalid.
bool Expander::element_value(const ElementTemplate& plan, const Environment& environment, std::size_t i, double flow_index, SceneElement& element) {
  const Parameter& parameter = context_.declarations[static_cast<std::size_t>(plan.declaration)]->parameters[i];
  const Formula& formula = plan.values[i];
  const auto characteristic = plan.characteristics.find(i);
  const auto is_curve = [&] { return parameter.kind == Parameter::Kind::characteristic || (parameter.may_be_curve && !(formula.given() && environment.find("w"))); };
  if (characteristic != plan.characteristics.end() && is_curve()) {
    const auto made = characteristic->second.evaluate(environment, context_);
    element.given.set(i);
    double slope;
    if (made) values_[i] = parameter.may_be_curve ? made->force(0, slope) : 1;
    characteristics_[i] = made;
    return made != nullptr;
  }
  if (!formula.given()) {
    if (parameter.fallback && parameter.kind == Parameter::Kind::value && !plan.varies(i)) values_[i] = *parameter.fallback;
    return true;
  }
  element.given.set(i);
  std::optional<double> value;
  const Quantity quantity = plan.quantity_of(parameter);
  if (parameter.unit == Parameter::Unit::quantity) {
    value = formula.evaluate(environment, quantity, context_.domain, context_.diagnostics, flow_index);
  } else if (const auto number = formula.evaluate(environment, context_.diagnostics)) {
    value = number->value;
    flow_index = 1;
  }
  if (!value) return false;
  values_[i] = *value;
  if (quantity != parameter.quantity) {
    Parameter coefficient = parameter;
    coefficient.quantity = quantity;
    coefficient.may_be_infinite = false;
    return check_bounds(*value, coefficient, formula, context_.domain, flow_index, context_.diagnostics);
  }
  return check_bounds(*value, parameter, formula, context_.domain, flow_index, context_.diagnostics);
}

bool Expander::element_values(const ElementTemplate& plan, const Environment& environment, SceneElement& element) {
  const Declaration& declaration = *context_.declarations[static_cast<std::size_t>(plan.declaration)];
  const std::vector<Parameter>& parameters = declaration.parameters;
  const auto index_of = [&](const std::string& name) {
    std::size_t i = 0;
    while (i < parameters.size() && parameters[i].name != name) ++i;
    return i;
  };
  bool good = true;
  values_.assign(parameters.size(), not_given);
  characteristics_.clear();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].flow_index.empty()) good = element_value(plan, environment, i, 1, element) && good;
  // Parameters whose unit depends on a flow index, or that default to another parameter, come after those parameters.
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].flow_index.empty()) continue;
    const double n = values_[index_of(parameters[i].flow_index)];
    if (!std::isnan(n)) good = element_value(plan, environment, i, n, element) && good;
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].same_as.empty() || plan.values[i].given() || plan.varies(i) || characteristics_.contains(i)) continue;
    const auto same = characteristics_.find(index_of(parameters[i].same_as));
    if (same != characteristics_.end() && !parameters[i].second_of.empty()) characteristics_[i] = same->second;
    values_[i] = (parameters[i].opposite ? -1 : 1) * values_[index_of(parameters[i].same_as)];
  }
  for (const auto& [i, characteristic] : characteristics_)
    if (parameters[i].may_be_curve) values_[i] = not_given;  // as of a signal
  if (!characteristics_.empty()) element.characteristics = std::make_shared<const Characteristics>(characteristics_);
  if (good && declaration.check) {
    if (const std::optional<Misfit> misfit = declaration.check(values_)) {
      const Formula& formula = plan.values[index_of(misfit->parameter)];
      context_.diagnostics.error(formula.given() ? formula.source().spot : plan.spot,
                              fmt::format("`{}` {}", misfit->parameter, misfit->what));
      good = false;
    }
  }
  element.values = shared_values(plan.declaration);
  const Characteristic* curve = characteristics_.empty() ? nullptr : characteristics_.begin()->second.get();
  for (std::size_t i = 0; curve && i < parameters.size(); ++i) {
    const double force = values_[i];
    if (parameters[i].kind != Parameter::Kind::initial || parameters[i].quantity != Quantity::force || std::isnan(force)) continue;
    const bool never = std::isinf(curve->where(force));
    if (!never && !curve->falls_at()) continue;
    context_.diagnostics.error(plan.values[i].source().spot, fmt::format("`{}` is a force that the curve {}", parameters[i].name, never ? "never has" : "may have at several displacements"),
                               "give the displacement at the start, `d0`");
    good = false;
  }
  return element_signals(plan, environment, element) && good;
}

/// The values of the element being made; shared with the last element of its type if they are equal.
Shared<double> Expander::shared_values(int declaration) {
  if (made_.empty()) made_.resize(context_.declarations.size());
  Shared<double>& last = made_[static_cast<std::size_t>(declaration)];
  if (!same_values(last, values_)) last = values_;
  return last;
}

bool Expander::element_signals(const ElementTemplate& plan, const Environment& environment, SceneElement& element) {
  bool good = true;
  for (std::size_t i = 0; i < plan.signals.size(); ++i) {
    const auto signal = plan.signals[i].evaluate(environment, context_);
    good = signal && good;
    if (!signal) continue;
    element.signals.own().push_back(*signal);
    element.signal_parameters.own().push_back(plan.signal_parameters[i]);
  }
  for (const SignalConnection& feed : plan.feeds) {
    element.signals.own().emplace_back(Signal::Constant{0});  // until the output of the block replaces it
    element.signal_parameters.own().push_back(feed.parameter);
  }
  for (const std::size_t i : plan.default_signals) {
    const Parameter& parameter = context_.declarations[static_cast<std::size_t>(plan.declaration)]->parameters[i];
    element.signals.own().emplace_back(Signal::Constant{*parameter.fallback});
    element.signal_parameters.own().push_back(static_cast<int>(i));
  }
  return good;
}

std::size_t Expander::begin_assembly(const ElementTemplate& plan, Ends ends, const std::string& path) {
  scene_.assemblies.push_back({path, ends[0], ends[1], {}, plan.spot});
  return scene_.assemblies.size() - 1;
}

void Expander::end_assembly(std::size_t assembly, Terms force, const Surroundings& around) {
  if (around.force) around.force->insert(around.force->end(), force.begin(), force.end());
  force.shrink_to_fit();
  scene_.assemblies[assembly].force = std::move(force);
}

bool Expander::group(const ElementTemplate& plan, Ends ends, const std::string& path, const Surroundings& around) {
  const std::size_t assembly = begin_assembly(plan, ends, path);
  Terms force;
  Level level{path};
  const bool good =
      members(plan, ends, level, {nullptr, around.environment, around.overrides, around.depth + 1, &force});
  end_assembly(assembly, std::move(force), around);
  return good;
}

bool Expander::members(const ElementTemplate& plan, Ends ends, Level& level, const Surroundings& around) {
  const Instead domain(domain_, plan.domain ? plan.domain : domain_);
  const bool series = plan.kind == ElementTemplate::Kind::series;
  if (around.depth > most_nested) return body(plan, ends, level.path, around);  // which reports the mistake
  bool good = true;
  NodeId before = ends[0];
  for (std::size_t i = 0; i < plan.members.size() && !stopped_; ++i) {
    const ElementTemplate& member = plan.members[i];
    const bool last = i + 1 == plan.members.size();
    const NodeId after = !series || last ? ends[1] : new_node({}, plan.spot);
    const NodeId member_ends[] = {series ? before : ends[0], after};
    Terms* force = series && i > 0 ? nullptr : around.force;
    if (!has_level(member)) {
      good = member.sound &&
             members(member, member_ends, level,
                     {nullptr, around.environment, around.overrides, around.depth + 1, force}) &&
             good;
    } else {
      ActiveOverrides own, deeper;
      for (const ActiveOverride& active : around.overrides)
        if (active.next().name == member.name) own.push_back(active.deeper());
      const ElementTemplate& final_member = own.empty() ? member : overridden(member, nullptr, own, false, deeper);
      good = final_member.sound &&
             entry(final_member, member_ends, joined(level.path, member.name),
                   {nullptr, around.environment, deeper, around.depth + 1, force}) &&
             good;
    }
    // Inner nodes are numbered in reading order: nodes within a member before the node behind it.
    if (series && !last)
      scene_.nodes[static_cast<std::size_t>(after)].name = joined(level.path, "node" + std::to_string(++level.joints));
    before = after;
  }
  return good;
}

bool Expander::repeat(const ElementTemplate& plan, Ends ends, const std::string& path, const Surroundings& around) {
  DiagnosticList& diagnostics = context_.diagnostics;
  const Repeat& repeat = *plan.repeat;
  const auto wanted = member_count(repeat, around.environment, context_);
  if (!wanted) return false;
  const auto refuse = [&](double elements) {
    diagnostics.error(repeat.count.source().spot, "this `repeat` makes " + number_text(elements) +
                                                   " elements; a scene may have at most " +
                                                   std::to_string(most_elements));
    stopped_ = true;
    return false;
  };
  if (*wanted > static_cast<double>(most_elements)) return refuse(*wanted);
  const auto count = static_cast<std::size_t>(*wanted);

  const auto overridden_members = by_member(around.overrides, count, path, diagnostics);
  const bool assembled = ends.size() == 2 && !plan.at;
  const std::size_t assembly = assembled ? begin_assembly(plan, ends, path) : 0;
  Terms force;
  Environment environment{.names = {}, .outer = &around.environment};
  environment.names["n"] = Number{.value = *wanted, .dimension = {}};
  Number& number = environment.names[repeat.as];
  const std::string prefix = path + '.';
  std::string member_path;
  const DiagnosticList::Within within(diagnostics, member_path);
  const std::size_t elements_before = scene_.elements.size(), nodes_before = scene_.nodes.size(), assemblies_before = scene_.assemblies.size();
  NodeId before = ends.empty() ? ground : ends[0];  // a block has no ends
  bool good = true;
  for (std::size_t i = 0; i < count && good; ++i) {
    number = Number{.value = static_cast<double>(i), .dimension = {}};
    member_path = prefix + std::to_string(i);
    ActiveOverrides own, deeper;
    for (const auto& [index, active] : overridden_members)
      if (index == i) own.push_back(active);
    const ElementTemplate& member = own.empty() ? plan : overridden(plan, around.scope, own, true, deeper);
    const Surroundings inside{around.scope, environment, deeper, around.depth + 1,
                              assembled && (!repeat.series || i == 0) ? &force : nullptr};
    if (repeat.series) {
      const NodeId after = i + 1 == count ? ends[1] : new_node(prefix + "node" + std::to_string(i + 1), plan.spot);
      const NodeId member_ends[] = {before, after};
      good = member.sound && body(member, member_ends, member_path, inside);
      before = after;
    } else {
      good = member.sound && body(member, ends, member_path, inside);
    }
    member_path = path;
    if (i > 0 || !good) continue;
    // The first member shows how many elements there would be in all.
    const double in_all =
        static_cast<double>(elements_before) + static_cast<double>(scene_.elements.size() - elements_before) * *wanted;
    if (in_all > static_cast<double>(most_elements)) {
      good = refuse(in_all);
    } else {
      make_room(scene_.elements, elements_before, count);
      make_room(scene_.nodes, nodes_before, count);
      make_room(scene_.assemblies, assemblies_before, count);
    }
  }
  if (assembled) end_assembly(assembly, std::move(force), around);
  return good;
}

}  // namespace rheonet
