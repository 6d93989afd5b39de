#pragma once

#include <string>
#include <unordered_map>

#include "core/netlist/context.hpp"
#include "core/netlist/document.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

/// Whether anything in a part of a file puts an element into the other domain than that of the scene: a `domain` that differs, or
/// a type that is of one domain. If not, all elements are in the domain of the scene, and need not be looked at.
bool names_other_domain(const TomlValue& part, const Context& context);

/// The domain of an element or of an assembly, and which others give it, in words: "`motor` through `k1`"; "" if it is its own, or that of
/// the scene.
struct FoundDomain {
  Domain domain;
  std::string by;
};

/// The domain of each element, and that of the first node of each assembly, by its path.
using DomainOfElement = std::unordered_map<std::string, FoundDomain>;

/// Finds the domain of each element of a scene whose elements have a `domain` where the file gives one. From these, and from
/// types with a domain of their own, it goes from node to node through all elements but those that join two domains. Other
/// nodes have the domain of the scene. Reports the elements at which two domains meet.
DomainOfElement find_domains(const Scene& scene, Context& context);

/// Gives each node of a scene the domain of its elements.
void set_node_domains(Scene& scene, const Declarations& declarations);

}  // namespace rheonet
