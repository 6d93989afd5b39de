#include "core/netlist/domains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "core/base/format_list.hpp"

namespace rheonet {

namespace {

std::size_t at_index(int i) { return static_cast<std::size_t>(i); }

/// Elements on the way of a domain that a message names: chains may have a million.
constexpr std::size_t most_named = 8;

const char* in_words(Domain domain) { return domain == Domain::rotation ? "rotation" : "translation"; }

/// The domain that a type of the scene gives its nodes, if it differs from that of the scene for any of them.
bool of_other_domain(const std::string& type, const Context& context) {
  return std::any_of(context.declarations.begin(), context.declarations.end(), [&](const Declaration* d) {
    if (!d->rotational_type.empty() && d->rotational_type == type) return context.domain != Domain::rotation;
    return d->type == type && std::any_of(d->domains.begin(), d->domains.end(), [&](Domain domain) { return domain != context.domain; });
  });
}

/// Spreads the domains over the nodes, nearest giver first, so that the two ways to a contradiction are the shortest ones.
class Spread {
 public:
  Spread(const Scene& scene, Context& context) : scene_(scene), context_(context), places_(scene.nodes.size()), around_(scene.nodes.size()) {
    for (std::size_t e = 0; e < scene.elements.size(); ++e) {
      if (!passes(e)) continue;
      for_each_node(scene.elements[e], [&](NodeId node) {
        if (node != ground) around_[at_index(node)].push_back(static_cast<int>(e));
      });
    }
    for (std::size_t e = 0; e < scene.elements.size(); ++e) begin_at(static_cast<int>(e));
    for (std::size_t k = 0; k < reached_.size(); ++k) go_on(reached_[k]);
  }

  bool contradicts() const { return contradicts_; }

  Domain of(std::size_t e) const {
    const SceneElement& element = scene_.elements[e];
    if (!declaration(e).domains.empty()) return declaration(e).domains.front();
    return at({element.a, element.b, element.support}, element.domain.value_or(context_.domain));
  }

  /// The elements that give an element its domain: see FoundDomain.
  std::string given_by(std::size_t e) const {
    const SceneElement& element = scene_.elements[e];
    for (const NodeId node : {element.a, element.b, element.support}) {
      if (node == ground || !places_[at_index(node)].domain) continue;
      const Place& place = places_[at_index(node)];
      return place.by == static_cast<int>(e) && place.from == ground ? "" : way(place);
    }
    return "";
  }

  /// The domain of the first of these nodes that has one; otherwise `usual`.
  Domain at(std::initializer_list<NodeId> nodes, Domain usual) const {
    for (const NodeId node : nodes) {
      if (node != ground && places_[at_index(node)].domain) return *places_[at_index(node)].domain;
    }
    return usual;
  }

 private:
  /// How a node came to its domain.
  struct Place {
    std::optional<Domain> domain = {};
    int by = -1;           ///< the element that gave it
    NodeId from = ground;  ///< the node at the other end of `by`; ground if the element has the domain itself
    int giver = -1;        ///< the element that has the domain itself
    int passed = 0;        ///< number of elements that pass it on from there
  };

  const Declaration& declaration(std::size_t e) const { return *context_.declarations[at_index(scene_.elements[e].declaration)]; }
  bool passes(std::size_t e) const { return declaration(e).domains.empty() && declaration(e).ports != Declaration::Ports::block; }

  void begin_at(int e) {
    const SceneElement& element = scene_.elements[at_index(e)];
    const Declaration& declared = declaration(at_index(e));
    if (declared.ports == Declaration::Ports::block) return;
    const std::vector<Domain>& own = declared.domains;
    if (own.empty() && !element.domain) return;
    give(element.a, own.empty() ? *element.domain : own[0], e, ground);
    if (!element.at) give(element.b, own.empty() ? *element.domain : own[1], e, ground);
    give(element.support, own.empty() ? *element.domain : own[0], e, ground);
  }

  void go_on(NodeId node) {
    for (const int e : around_[at_index(node)]) {
      for_each_node(scene_.elements[at_index(e)], [&](NodeId other) {
        if (other != node) give(other, *places_[at_index(node)].domain, e, node);
      });
    }
  }

  Place reached_by(Domain domain, int by, NodeId from) const {
    if (from == ground) return {domain, by, from, by, 0};
    return {domain, by, from, places_[at_index(from)].giver, places_[at_index(from)].passed + 1};
  }

  void give(NodeId node, Domain domain, int by, NodeId from) {
    if (node == ground) return;
    Place& place = places_[at_index(node)];
    if (!place.domain) {
      place = reached_by(domain, by, from);
      reached_.push_back(node);
    } else if (*place.domain != domain) {
      refuse(node, domain, by, from);
    }
  }

  void refuse(NodeId node, Domain domain, int by, NodeId from) {
    contradicts_ = true;
    const SceneElement& element = scene_.elements[at_index(by)];
    const Place& place = places_[at_index(node)];
    const std::string& name = scene_.nodes[at_index(node)].name;
    context_.diagnostics.error(
        element.spot,
        fmt::format("node `{}` would be of {}, by {}, and of {}, by {}", name, in_words(*place.domain), way(place), in_words(domain),
                    way(reached_by(domain, by, from))),
        "a `rack` or a `screw` joins a rotating node and one that moves along a line; all other elements have both nodes in one domain");
  }

  /// "`motor`", "`motor` through `k1`, `k2`": the element that has the domain, and those that pass it on.
  std::string way(const Place& place) const {
    const std::string name = "`" + scene_.elements[at_index(place.giver)].name + "`";
    int by = place.by;
    NodeId from = place.from;
    std::vector<std::string> through;
    while (from != ground && through.size() < most_named) {
      through.push_back(scene_.elements[at_index(by)].name);
      by = places_[at_index(from)].by;
      from = places_[at_index(from)].from;
    }
    std::reverse(through.begin(), through.end());
    if (from != ground) return fmt::format("{} through {} elements, the last ones {}", name, place.passed, format_list(through));
    return through.empty() ? name : name + " through " + format_list(through);
  }

  const Scene& scene_;
  Context& context_;
  std::vector<Place> places_;
  std::vector<std::vector<int>> around_;  ///< of each node: the elements through which a domain goes on
  std::vector<NodeId> reached_;
  bool contradicts_ = false;
};

}  // namespace

bool names_other_domain(const TomlValue& part, const Context& context) {
  for (const TomlValue& item : part.items) {
    if (names_other_domain(item, context)) return true;
  }
  for (const TomlEntry& entry : part.entries) {
    if (entry.key == "domain" && entry.value.is_string() && entry.value.text != in_words(context.domain)) return true;
    if (entry.key == "type" && entry.value.is_string() && of_other_domain(entry.value.text, context)) return true;
    if (names_other_domain(entry.value, context)) return true;
  }
  return false;
}

DomainOfElement find_domains(const Scene& scene, Context& context) {
  const Spread spread(scene, context);
  if (spread.contradicts()) throw TooManyDiagnostics{};  // units that do not fit would only repeat it
  DomainOfElement result;
  for (std::size_t e = 0; e < scene.elements.size(); ++e) result.emplace(scene.elements[e].name, FoundDomain{spread.of(e), spread.given_by(e)});
  for (const SceneAssembly& assembly : scene.assemblies)
    result.emplace(assembly.name, FoundDomain{spread.at({assembly.a, assembly.b}, context.domain), ""});
  return result;
}

void set_node_domains(Scene& scene, const Declarations& declarations) {
  for (const SceneElement& element : scene.elements) {
    const Declaration& declaration = *declarations[at_index(element.declaration)];
    if (declaration.ports == Declaration::Ports::block) continue;
    const Domain first = domain_of(scene, element), second = declaration.domains.empty() ? first : declaration.domains[1];
    if (element.a != ground) scene.nodes[at_index(element.a)].domain = first;
    if (!element.at && element.b != ground) scene.nodes[at_index(element.b)].domain = second;
    if (element.support != ground) scene.nodes[at_index(element.support)].domain = first;
  }
}

}  // namespace rheonet
