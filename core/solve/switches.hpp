#pragma once

#include <utility>
#include <vector>

#include "core/dae/block_signals.hpp"
#include "core/dae/dae.hpp"
#include "core/network/network.hpp"
#include "core/network/structure.hpp"
#include "core/solve/integrator.hpp"

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
///   limiter            "limit", "release"
///
/// A slider in a pair (core/network/pairs.hpp) is told of as any other, though a bundle goes on without an event: when it
/// yielded within a step follows from the deflection of the bundle.
class Switches {
 public:
  /// Both must outlive this.
  Switches(const Network& network, const BlockSignals& blocks);

  /// What has changed since the last call, with the deflections of all branches. Valid until the next one.
  const std::vector<Event>& follow(double t, const Modes& modes, const std::vector<double>& p);
  /// The same at the end of the last step, with the deflections there, of the pairs that have yielded within it: at their
  /// times, in their order; not `timed`, all at its end.
  const std::vector<Event>& follow_step(const Integrator& integrator, const Dae& dae, const std::vector<double>& p,
                                        bool timed);

 private:
  struct Condition { int direction; bool bound; };
  struct Law {
    const DeflectionBatch* batch;
    std::size_t i;
    int element;
    Condition last;
    Condition now() const { return {batch->direction(i), batch->constant(i)}; }
  };
  /// What has been told of the pairs of a bundle.
  struct Bundle {
    int branch;              ///< of the network
    const Iwan* law;
    std::vector<int> pairs;  ///< index into Network::pairs, of each
    std::vector<signed char> mode;      ///< of each: the direction in which it slips
    std::vector<std::size_t> slipping;  ///< since they yielded on a branch of the law, the first of its order
    long on = -1;                       ///< that branch
  };
  void follow(double t, Bundle& bundle, double p);
  void follow_blocks(double t);
  void yield(double t, Bundle& bundle, std::size_t pair);
  void tell(double t, const Bundle& bundle, std::size_t pair, int before, int after);
  void turn(double t, int element, int before, int after, const char* to_rest, const char* from_rest);

  const Network& network_;
  const BlockSignals& blocks_;
  std::vector<int> sides_;  ///< of each block, as for BlockSignals::side
  std::vector<Law> laws_;
  std::vector<Bundle> bundles_;
  Modes last_;
  std::vector<Event> events_;
};

}  // namespace rheonet
