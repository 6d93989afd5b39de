#include "core/netlist/group_names.hpp"

#include <unordered_map>

namespace rheonet {

namespace {

struct Naming {
  std::unordered_map<std::string, int> numbers;  // of unnamed members, by type
  std::unordered_map<std::string, Spot> taken;
  std::size_t joints = 0;
};

std::string type_of(const ElementTemplate& plan) {
  if (plan.kind == ElementTemplate::Kind::series) return "series";
  if (plan.kind == ElementTemplate::Kind::parallel) return "parallel";
  const TomlEntry* type = plan.source->find("type");
  return type ? type->value.text : "";
}

void name(ElementTemplate& group, Naming& naming, DiagnosticList& diagnostics) {
  if (group.kind == ElementTemplate::Kind::series && !group.members.empty()) naming.joints += group.members.size() - 1;
  for (ElementTemplate& member : group.members) {
    const bool is_group = member.kind == ElementTemplate::Kind::series || member.kind == ElementTemplate::Kind::parallel;
    if (member.name.empty() && is_group && !member.repeat) {
      name(member, naming, diagnostics);
      continue;
    }
    const bool unnamed = member.name.empty();
    if (unnamed) {
      const std::string type = type_of(member);
      if (type.empty()) continue;  // this mistake has been reported
      member.name = type + std::to_string(++naming.numbers[type]);
    }
    if (!naming.taken.emplace(member.name, member.spot).second)
      diagnostics.error(member.spot, "the name `" + member.name + "` stands twice in this assembly",
                     unnamed ? "an unnamed member is called by its type and number: name one of them otherwise"
                             : "names within an assembly must differ");
  }
}

}  // namespace

bool has_level(const ElementTemplate& member) { return !member.name.empty(); }

void name_members(ElementTemplate& assembly, DiagnosticList& diagnostics) {
  Naming naming;
  name(assembly, naming, diagnostics);
  for (std::size_t joint = 1; joint <= naming.joints; ++joint)
    if (const auto found = naming.taken.find("node" + std::to_string(joint)); found != naming.taken.end())
      diagnostics.error(found->second, "`" + found->first + "` is the name of an inner node of this assembly",
                     "choose another name");
}

void check_names(const Scope& scope, DiagnosticList& diagnostics) {
  for (const ElementTemplate& plan : scope.entries)
    if (plan.sound && !plan.at && scope.node_index.contains(plan.name))
      diagnostics.error(plan.spot, "`" + plan.name + "` is both an element between nodes and a node",
                     "`" + plan.name + ".velocity` would have two meanings: rename one of them");
}

}  // namespace rheonet
