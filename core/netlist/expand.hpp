#pragma once

#include <deque>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/netlist/overrides.hpp"
#include "core/netlist/plan.hpp"
#include "core/netlist/wires.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Makes the elements, nodes and assemblies of a scene from plans: values are evaluated, groups, models and repeats
/// resolved.
class Expander {
 public:
  Expander(Context& context, Planner& planner, Scene& scene) : context_(context), planner_(planner), scene_(scene) {}

  /// Expands all entries of the scene's own `elements`. Overrides are those whose path begins with an element.
  void run(Scope& scope, const Environment& environment, const ActiveOverrides& overrides);
  /// The entries of `elements` that nothing, or only a part, came of: something is wrong with them.
  const std::set<std::string>& failed() const { return failed_; }
  /// What the wires name that have been met.
  const LooseEnds& loose_ends() const { return loose_; }

 private:
  using Terms = std::vector<SceneAssembly::Term>;
  using Ends = std::span<const NodeId>;

  /// What is around an entry.
  struct Surroundings {
    Scope* scope;  ///< where its nodes are named; nullptr within a group
    const Environment& environment;
    const ActiveOverrides& overrides;  ///< those that concern the entry
    int depth;                         ///< levels of groups and models that it is in
    Terms* force;                      ///< receives the forces of the elements at its first end, if not nullptr
  };
  /// An assembly whose inner nodes are being made.
  struct Level {
    const std::string& path;
    int joints = 0;
  };
  /// The nodes of a scope, by index; made when they are first named.
  struct Locals {
    Scope& scope;
    const std::string& prefix;
    std::vector<NodeId> ids;
  };

  // Each returns false if something is wrong with what it expands.
  bool entries(Locals& locals, const std::string& prefix, const Environment& environment,
               const ActiveOverrides& overrides, int depth);
  bool entry(const Plan& plan, Ends ends, const std::string& path, const Surroundings& around);
  bool body(const Plan& plan, Ends ends, const std::string& path, const Surroundings& around);
  bool element(const Plan& plan, Ends ends, const std::string& path, const Surroundings& around);
  bool group(const Plan& plan, Ends ends, const std::string& path, const Surroundings& around);
  bool members(const Plan& plan, Ends ends, Level& level, const Surroundings& around);
  bool instance(const Plan& plan, Ends ends, const std::string& path, const Surroundings& around);
  bool repeat(const Plan& plan, Ends ends, const std::string& path, const Surroundings& around);

  bool element_value(const Plan& plan, const Environment& environment, std::size_t i, double flow_index, SceneElement& element);
  bool element_values(const Plan& plan, const Environment& environment, SceneElement& element);
  Shared<double> shared_values(int declaration);
  bool element_signals(const Plan& plan, const Environment& environment, SceneElement& element);
  /// What is peculiar to the element made last: the inputs and units of a block, what feeds a source.
  void wire(const Plan& plan, const Environment& environment, int element);
  std::string path_of(const Wire& wire) const;
  bool instance_parameters(const Plan& plan, const Environment& around, Environment& inside);
  Terms take_port_forces(NodeId port, NodeId actual, std::size_t first_element, std::size_t first_assembly);
  std::size_t begin_assembly(const Plan& plan, Ends ends, const std::string& path);
  void end_assembly(std::size_t assembly, Terms force, const Surroundings& around);
  bool refuse_number(Spot spot);
  NodeId new_node(std::string name, Spot spot);
  NodeId node(Locals& locals, int index);

  /// The plan with the overrides that change its own keys applied; `deeper` receives those that concern what is in it.
  const Plan& overridden(const Plan& plan, Scope* scope, const ActiveOverrides& overrides, bool is_member,
                         ActiveOverrides& deeper);

  /// More than a machine of today can simulate, and what takes a few GB to hold.
  static constexpr std::size_t most_elements = 5'000'000;

  Context& context_;
  Planner& planner_;
  Scene& scene_;
  std::deque<TomlValue> patched_values_;
  std::deque<Plan> patched_plans_;
  std::vector<double> values_;        ///< of the element that is being made
  std::vector<Shared<double>> made_;  ///< of each declaration: those of the last element
  std::set<std::string> failed_;
  LooseEnds loose_;
  /// The instance that is being expanded: where its wires lead.
  struct Inside {
    std::string path;                                  ///< "" at the top
    std::unordered_map<std::string, std::string> ports;  ///< and the scene's name of each
  };
  Inside inside_;
  std::unordered_map<NodeId, std::string> port_names_;  ///< of what stands for a first port
  NodeId next_port_ = -1;  ///< stands for the first port of an instance while it is expanded
  bool stopped_ = false;   ///< there are too many elements
};

}  // namespace rheonet
