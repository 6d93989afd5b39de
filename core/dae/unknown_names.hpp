#pragma once

#include <string>

#include "core/dae/dae.hpp"

namespace rheonet {

/// Unknowns in the words of the netlist, for messages.
class UnknownNames {
 public:
  /// The equations must outlive this.
  explicit UnknownNames(const Dae& dae) : dae_(dae) {}

  /// The node or element of the scene that an unknown belongs to.
  struct Subject {
    enum class Kind { node, element };
    Kind kind;
    int index;  ///< Into Scene::nodes or Scene::elements.
    auto operator<=>(const Subject&) const = default;
  };
  Subject subject(int unknown) const;
  /// Place of that node or element in the netlist.
  const Spot& spot_of(int unknown) const;
  /// "the velocity of node `m`", "the force of `k1`".
  std::string describe(int unknown) const;
  /// "`m`, `k1`": the elements around that node or element.
  std::string around(int unknown) const;

 private:
  const Dae& dae_;
};

}  // namespace rheonet
