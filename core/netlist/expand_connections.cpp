#include <memory>
#include <utility>

#include "core/netlist/expand.hpp"
#include "core/netlist/records.hpp"

namespace rheonet {

/// Path of a wire's source in the scene. A wire in a model may name the model's elements and nodes, and its ports.
std::string Expander::path_of(const SignalConnection& connection) const {
  if (inside_.path.empty()) return connection.path;
  const std::size_t dot = connection.path.find('.');
  const auto port = inside_.ports.find(connection.path.substr(0, dot));
  if (port == inside_.ports.end()) return inside_.path + '.' + connection.path;
  return port->second + (dot == connection.path.npos ? "" : connection.path.substr(dot));
}

/// The end of a wire into a block. An input of a law comes from outside the law.
LooseEnd Expander::end_of(const SignalConnection& input, int block, int element) const {
  const auto given = inside_.inputs.find(input.path);
  LooseEnd end = given == inside_.inputs.end() ? LooseEnd{&input, path_of(input), inside_.path} : given->second;
  end.block = block;
  end.element = element;
  return end;
}

/// Resolves the wires to the inputs of a law where the instance stands, and makes generators for the inputs that are signals.
bool Expander::law_inputs(const ElementTemplate& plan, const std::string& path, const Surroundings& around, Inside& inside) {
  for (const SignalConnection& input : plan.inputs) inside.inputs.emplace(input.name, LooseEnd{&input, path_of(input), inside_.path});
  bool good = true;
  for (const ElementTemplate& generator : plan.members) {
    if (element(generator, {}, path + '.' + generator.name, around)) {
      scene_.elements.back().part = SceneElement::Part::inner;
    } else {
      good = false;
    }
  }
  return good;
}

void Expander::connection(const ElementTemplate& plan, const Environment& environment, int element) {
  for (const SignalConnection& feed : plan.feeds) loose_.ends.push_back({&feed, path_of(feed), inside_.path, -1, element});
  const Declaration& declaration = *context_.declarations[static_cast<std::size_t>(plan.declaration)];
  if (declaration.ports != Declaration::Ports::block) return;
  const int block = static_cast<int>(scene_.blocks.size());
  scene_.blocks.push_back({.element = element, .inputs = {}, .unit = {}});
  if (plan.function) {
    const auto parameters = std::make_shared<Environment>();
    for (const Environment* level = &environment; level; level = level->outer)
      parameters->names.insert(level->names.begin(), level->names.end());  // inner names hide outer ones
    loose_.functions.push_back({block, plan.function, parameters, {}, inside_.path, {}, inside_.law});
    for (const SignalConnection& input : plan.inputs) loose_.functions.back().names.push_back(input.name);
  }
  if (plan.lookup) {
    if (auto made = plan.lookup->evaluate(environment, context_)) loose_.functions.push_back({block, &plan.lookup->source(), {}, std::move(*made), inside_.path, {}});
  }
  polynomials(plan, environment);
  for (const SignalConnection& input : plan.inputs) loose_.ends.push_back(end_of(input, block, element));
  for (std::size_t i = 0; i < declaration.parameters.size(); ++i) {
    const Formula& formula = plan.values[i];
    if (declaration.parameters[i].unit == Parameter::Unit::quantity || !formula.given()) continue;
    if (const auto number = formula.evaluate(environment, context_.diagnostics))
      loose_.units.push_back({block, static_cast<int>(i), unit_of(*number), &formula.source()});
  }
  for (std::size_t i = 0; i < plan.signals.size(); ++i)
    loose_.units.push_back({block, plan.signal_parameters[i], plan.signals[i].unit(), nullptr});
}

/// Evaluates the coefficients of the block made last.
void Expander::polynomials(const ElementTemplate& plan, const Environment& environment) {
  const Declaration& declaration = *context_.declarations[static_cast<std::size_t>(plan.declaration)];
  SceneBlock& block = scene_.blocks.back();
  for (const CoefficientsTemplate& given : plan.coefficients) {
    auto made = given.evaluate(environment, context_);
    if (!made) return;
    block.coefficients.push_back(std::move(made->coefficients));
    loose_.units.push_back({static_cast<int>(scene_.blocks.size()) - 1, static_cast<int>(given.parameter()), unit_of(made->unit), &given.source()});
  }
  if (!declaration.check_coefficients) return;
  const std::optional<Misfit> misfit = declaration.check_coefficients(block.coefficients);
  if (!misfit) return;
  const TomlEntry* entry = plan.source->find(misfit->parameter);
  context_.diagnostics.error(entry->value.spot, "`" + misfit->parameter + "` " + misfit->what);
}

}  // namespace rheonet
