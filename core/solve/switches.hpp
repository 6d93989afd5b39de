#pragma once

#include <utility>
#include <vector>

#include "core/network/network.hpp"
#include "core/network/structure.hpp"

namespace rheonet {

/// One element goes over to something else.
struct Event {
  double t;          ///< s
  int element;       ///< index into Scene::elements
  const char* what;  ///< see Switches; of a drive "jump" or "corner"
  int direction;     ///< in which it moves from then on (of a drive: to which side its signal or slope goes): 1, -1; or 0
};

/// What every slider and every law with a memory does at present. Only what differs from one instant to the next is an
/// event: an element that turns and turns back within an instant has none.
///
///   slider             "slip", "stick"; "breakaway": it slips and lets go of more than its force of sliding
///   law with a memory  "start", "stop": between rest and motion; "yield", "release": it comes to its bound, leaves it
///   both               "reversal"
class Switches {
 public:
  /// The network must outlive this.
  explicit Switches(const Network& network);

  /// What has changed since the last call. Valid until the next one.
  const std::vector<Event>& follow(double t, const Modes& modes);

 private:
  struct Condition { int direction; bool bound; };
  struct Law {
    const DeflectionBatch* batch;
    std::size_t i;
    int element;
    Condition last;
    Condition now() const { return {batch->direction(i), batch->constant(i)}; }
  };
  void turn(double t, int element, int before, int after, const char* to_rest, const char* from_rest);

  const Network& network_;
  std::vector<Law> laws_;
  Modes last_;
  std::vector<Event> events_;
};

}  // namespace rheonet
