#pragma once

#include <utility>
#include <vector>

#include "core/dae/block_signals.hpp"
#include "core/dae/dae.hpp"
#include "core/dae/inputs.hpp"
#include "core/network/network.hpp"
#include "core/network/structure.hpp"
#include "core/solve/integrator.hpp"

namespace rheonet {

/// A change of an element's mode.
struct Event {
  double t;          ///< s
  int element;       ///< index into Scene::elements
  const char* what;  ///< see ModeChangeLog; "jump" or "corner" of an input
  int direction;     ///< of its motion afterwards (of an input: of the jump of its signal or slope): 1, -1; or 0
};

/// Tracks the modes of sliders, laws with a memory, limiters and functions, and turns their changes into events. Only a net change at an
/// event time is an event: an element that reverses twice at the same time has none.
///
///   slider             "slip", "stick"; "breakaway": it begins to slip at more than its sliding force
///   law with a memory  "start", "stop": between rest and motion; "yield", "release": it reaches its bound, leaves it
///   both               "reversal"
///   law with contacts  "contact", "release"
///   limiter            "limit", "release"
///   function           "switch": a comparison or the like changes over
///
/// A slider in a pair (core/network/pairs.hpp) is reported like any other, although its bundle causes no event of the
/// integrator: the time at which it yields within a step follows from the deflection of the bundle.
class ModeChangeLog {
 public:
  /// Both must outlive this.
  ModeChangeLog(const Network& network, const Inputs& inputs);

  /// Events since the last call, given the deflections of all branches [m]. Valid until the next call.
  const std::vector<Event>& follow(double t, const Modes& modes, const std::vector<double>& p);
  /// Events of the pairs that yielded within the last step, given the deflections p at its end: at their times, in order; if
  /// not `timed`, all at its end.
  const std::vector<Event>& follow_step(const Integrator& integrator, const Dae& dae, const std::vector<double>& p,
                                        bool timed);

 private:
  struct Condition { int direction; bool bound; int contact; };
  struct Law {
    const DeflectionBatch* batch;
    std::size_t i;
    int element;
    Condition last;
    Condition now() const { return {batch->direction(i), batch->constant(i), batch->contact(i).value_or(0)}; }
  };
  /// The pairs of a bundle as last reported.
  struct Bundle {
    int branch;              ///< of the network
    const Iwan* law;
    std::vector<int> pairs;  ///< index into Network::pairs, of each
    std::vector<signed char> mode;      ///< of each: the direction in which it slips, 0: it sticks
    std::vector<std::size_t> slipping;  ///< pairs that slip on branch `on`, in the order in which they yielded
    long on = -1;                       ///< branch of the law as last seen
  };
  void follow(double t, Bundle& bundle, double p);
  void follow_blocks(double t);
  void yield(double t, Bundle& bundle, std::size_t pair);
  void tell(double t, const Bundle& bundle, std::size_t pair, int before, int after);
  void turn(double t, int element, int before, int after, const char* to_rest, const char* from_rest);

  const Network& network_;
  const Inputs& inputs_;
  const BlockSignals& blocks_;
  std::vector<int> sides_;  ///< of each block: see BlockSignals::side
  std::vector<std::vector<double>> switches_;  ///< of each block: sides of the switches of its function
  std::vector<Law> laws_;
  std::vector<Bundle> bundles_;
  Modes last_;
  std::vector<Event> events_;
};

}  // namespace rheonet
