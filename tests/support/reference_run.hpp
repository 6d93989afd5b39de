#pragma once

#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/netlist/declaration.hpp"
#include "core/netlist/scene.hpp"
#include "tests/support/reference_step.hpp"

namespace rheonet::test {

/// One run with steps of a given length.
class ReferenceRun {
 public:
  ReferenceRun(const Scene& scene, Declarations declarations, int steps, int refinement)
      : scene_(scene), declarations_(declarations), h_((scene.stop - scene.start) / steps), refinement_(refinement),
        network_(build()) {}

  bool go();
  const std::vector<std::vector<double>>& rows() const { return rows_; }
  const std::vector<char>& open() const { return open_; }
  const std::vector<std::vector<double>>& late() const { return late_; }
  /// For each row, the pieces of its laws' maps that the network is on.
  const std::vector<std::vector<ReferenceLaw::Piece>>& pieces() const { return pieces_; }
  /// True if a law turned within `distance` of t.
  bool turned_near(double t, double distance) const;
  double end() const { return t_; }
  /// When the laws left open how it goes on; infinite if they never did.
  double fork() const { return fork_; }

 private:
  struct Motion { Signal signal; bool by_position; NodeId node; int element; Piece piece; };
  struct Force { Signal signal; NodeId a, b; int element; Piece piece; };
  struct Mass { double mass; NodeId node; int element; };
  struct Varying { const SceneElement* element; std::size_t bundle, member; std::vector<Piece> pieces; };

  /// Where a step began, on the present stretches of the signals.
  struct Start { double time; ReferenceNetwork network; };
  struct Step { double from, length; };

  const std::string& type_of(const SceneElement& e) const { return declarations_[static_cast<std::size_t>(e.declaration)]->type; }
  ReferenceNetwork build();
  bool enter(double t);
  bool advance(double to, int least_steps);
  bool whole_step(double after);
  bool step(double after, int depth, double ahead);
  bool turns_ahead(double ahead) const;
  void note_turn(double from, double to);
  ReferenceNetwork::Input input(double before, double after) const;
  std::vector<ReferenceNetwork::Input::Bound> bounds(double t) const;
  bool jump(const std::vector<double>& steps);
  double next_break() const;
  double row_time(std::int64_t k) const;
  std::vector<double> values() const;
  void record(const std::vector<double>* early = nullptr);
  double element_force(int element) const;
  double force_of(const Record& record) const;

  const Scene& scene_;
  Declarations declarations_;
  double h_;
  int refinement_;
  std::vector<Motion> motions_;
  std::vector<Force> forces_;
  std::vector<Mass> masses_;
  std::vector<Varying> varying_;  ///< sliders whose bounds vary
  std::map<int, std::pair<std::size_t, std::size_t>> law_of_;  ///< element: bundle, member
  std::map<int, std::size_t> gear_of_;  ///< element: gear
  std::vector<double> mass_;          ///< of each node
  std::vector<double> acceleration_;  ///< of each node, at the end of the last step
  std::vector<double> applied_;
  std::vector<std::vector<double>> rows_;
  std::vector<std::vector<double>> late_;  ///< for each row, what it changes by in the time that it is late
  std::vector<char> open_;
  std::vector<std::vector<ReferenceLaw::Piece>> pieces_;
  double t_ = 0;
  int halvings_ = 0;                  ///< Number of bisections in the present search for a turn.
  bool at_instant_ = false;  ///< True in the short steps just after a break.
  int searches_ = 0;
  double fork_ = INFINITY;
  std::optional<Step> first_turn_;  ///< The shortest step that shows the first turn.
  std::optional<Start> last_;  ///< Start of the step before, if it had no turn.
  std::vector<double> turns_;  ///< Times of the turns [s].
  ReferenceNetwork network_;  ///< The last member, because it is built from the members above.
};

}  // namespace rheonet::test
