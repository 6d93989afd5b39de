#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "core/netlist/scene.hpp"

namespace rheonet::test {

/// Builds a scene without a netlist, as the reader of netlists would. Naming a node creates it; parameters are given by name, and the others
/// take their defaults.
class SceneBuilder {
 public:
  using Given = std::initializer_list<std::pair<const char*, double>>;

  explicit SceneBuilder(Domain domain = Domain::translation);

  /// The node of this name, made when first named; "ground" is node 0.
  NodeId node(const std::string& name);
  void start(const std::string& node, double position, double velocity = not_given);

  /// Elements; each returns its index.
  int between(const std::string& name, const std::string& type, const std::string& a, const std::string& b,
              Given given = {});
  int at(const std::string& name, const std::string& type, const std::string& node, Given given = {});
  int motion(const std::string& name, const std::string& node, const std::string& parameter, Signal signal);
  int force(const std::string& name, const std::string& node, Signal signal);
  int force(const std::string& name, const std::string& a, const std::string& b, Signal signal);
  int add(SceneElement element, const std::string& a, const std::string& b);  ///< b is ignored for one that is `at`

  /// Default values of a declaration; the given ones need not be.
  static SceneElement element(const std::string& name, const std::string& type, Given given = {});

  void record(const std::string& path);  ///< `k1.force`, `mid.position`: an element before a node of the same name
  /// The scene so far, with `intervals` + 1 rows from 0 to `stop` [s]; all records if none was asked for.
  Scene finish(double stop, int intervals, double accuracy) const;

 private:
  std::vector<Record> everything() const;

  Scene scene_;
};

}  // namespace rheonet::test
