#pragma once

#include <deque>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/netlist/domains.hpp"
#include "core/netlist/element_templates.hpp"
#include "core/netlist/overrides.hpp"
#include "core/netlist/scene.hpp"
#include "core/netlist/signal_connections.hpp"

namespace rheonet {

/// Makes the elements, nodes and assemblies of a scene from plans: evaluates values and resolves groups, models and
/// repeats.
class Expander {
 public:
  Expander(Context& context, TemplateReader& planner, Scene& scene) : context_(context), planner_(planner), scene_(scene) {}

  /// From now on elements get neither values nor signals: only their names, nodes, and domains as far as the file gives them.
  void leave_out_values() { without_values_ = true; }
  /// From now on each element is in its domain of `domains`, which must outlive this.
  void use(const DomainOfElement& domains) { domains_ = &domains; }

  /// Expands all entries of the scene's own `elements`. `overrides` are those whose path begins with an element.
  void run(Scope& scope, const Environment& environment, const ActiveOverrides& overrides);
  /// Entries of `elements` with mistakes, which gave no elements or only a part of them.
  const std::set<std::string>& failed() const { return failed_; }
  /// The wires met so far, not yet connected.
  const LooseEnds& loose_ends() const { return loose_; }

 private:
  using Terms = std::vector<SceneAssembly::Term>;
  using Ends = std::span<const NodeId>;

  /// The context in which an entry is expanded.
  struct Surroundings {
    Scope* scope;  ///< scope that names its nodes; nullptr within a group
    const Environment& environment;
    const ActiveOverrides& overrides;  ///< those that apply to the entry
    int depth;                         ///< number of groups and models around it
    Terms* force;                      ///< receives the forces of the elements at its first end, if not nullptr
  };
  /// An assembly whose inner nodes are being made.
  struct Level {
    const std::string& path;
    int joints = 0;
  };
  /// The nodes of a scope, by index; each is made when it is first named.
  struct Locals {
    Scope& scope;
    const std::string& prefix;
    std::vector<NodeId> ids;
  };

  /// The instance being expanded, to resolve its wires.
  struct Inside {
    std::string path;                                  ///< path of the instance; "" at the top level
    std::unordered_map<std::string, std::string> ports;  ///< ports of the model, with their names in the scene
    const Model* law = nullptr;                          ///< the law, if it is an instance of one
    std::unordered_map<std::string, LooseEnd> inputs;    ///< of a law, where wires give them
  };

  // Each returns false if the entry that it expands has a mistake.
  bool entries(Locals& locals, const std::string& prefix, const Environment& environment,
               const ActiveOverrides& overrides, int depth);
  bool entry(const ElementTemplate& plan, Ends ends, const std::string& path, const Surroundings& around);
  bool body(const ElementTemplate& plan, Ends ends, const std::string& path, const Surroundings& around);
  bool element(const ElementTemplate& plan, Ends ends, const std::string& path, const Surroundings& around);
  bool group(const ElementTemplate& plan, Ends ends, const std::string& path, const Surroundings& around);
  bool members(const ElementTemplate& plan, Ends ends, Level& level, const Surroundings& around);
  bool instance(const ElementTemplate& plan, Ends ends, const std::string& path, const Surroundings& around);
  bool repeat(const ElementTemplate& plan, Ends ends, const std::string& path, const Surroundings& around);

  /// The domain of an element or an assembly, by its path.
  Domain domain_at(const std::string& path) const;
  bool fits_domain(const ElementTemplate& plan, const std::string& path);
  bool element_value(const ElementTemplate& plan, const Environment& environment, std::size_t i, double flow_index, SceneElement& element);
  bool element_values(const ElementTemplate& plan, const Environment& environment, SceneElement& element);
  Shared<double> shared_values(int declaration);
  bool element_signals(const ElementTemplate& plan, const Environment& environment, SceneElement& element);
  /// Records the wires of the element made last: inputs and units of a block, the feed of a source.
  void connection(const ElementTemplate& plan, const Environment& environment, int element);
  void polynomials(const ElementTemplate& plan, const Environment& environment);
  std::string path_of(const SignalConnection& connection) const;
  LooseEnd end_of(const SignalConnection& input, int block, int element) const;
  bool law_inputs(const ElementTemplate& plan, const std::string& path, const Surroundings& around, Inside& inside);
  bool checked(const Model& model, const std::string& path, const Environment& environment);
  bool instance_parameters(const ElementTemplate& plan, const std::string& path, const Environment& around, Environment& inside);
  Terms take_port_forces(NodeId port, NodeId actual, std::size_t first_element, std::size_t first_assembly);
  std::size_t begin_assembly(const ElementTemplate& plan, Ends ends, const std::string& path);
  void end_assembly(std::size_t assembly, Terms force, const Surroundings& around);
  bool refuse_number(Spot spot);
  NodeId new_node(std::string name, Spot spot);
  NodeId node(Locals& locals, int index);

  /// The plan with the overrides of its own keys applied; `deeper` receives the overrides of entries inside it.
  const ElementTemplate& overridden(const ElementTemplate& plan, Scope* scope, const ActiveOverrides& overrides, bool is_member,
                         ActiveOverrides& deeper);

  /// More than today's machines can simulate; that many elements take a few GB.
  static constexpr std::size_t most_elements = 5'000'000;

  Context& context_;
  TemplateReader& planner_;
  Scene& scene_;
  std::deque<TomlValue> patched_values_;
  std::deque<ElementTemplate> patched_plans_;
  std::vector<double> values_;        ///< of the element being made
  Characteristics characteristics_;   ///< of the element being made
  std::vector<Shared<double>> made_;  ///< for each declaration, the values of its last element
  std::set<std::string> failed_;
  bool without_values_ = false;
  const DomainOfElement* domains_ = nullptr;  ///< if elements may be in different domains
  std::optional<Domain> domain_;              ///< given by the entry being expanded, or by what it is in
  LooseEnds loose_;
  Inside inside_;
  std::unordered_map<NodeId, std::string> port_names_;  ///< of the node ids that stand for first ports
  NodeId next_port_ = -1;  ///< next id to stand for the first port of an instance during its expansion
  bool stopped_ = false;   ///< the limit of elements is exceeded
};

}  // namespace rheonet
