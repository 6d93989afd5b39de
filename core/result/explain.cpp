#include "core/result/explain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/base/format_list.hpp"
#include "core/base/index.hpp"
#include "core/base/numerics.hpp"
#include "core/network/effects.hpp"
#include "core/network/influence_cone.hpp"
#include "core/network/limits.hpp"
#include "core/network/linearity.hpp"
#include "core/network/network.hpp"
#include "core/network/parts.hpp"
#include "core/network/reductions.hpp"
#include "core/network/resolved.hpp"
#include "core/network/series_parallel_reduction.hpp"
#include "core/network/transmission.hpp"
#include "core/result/cpu_time.hpp"
#include "core/result/grouped.hpp"
#include "core/result/output_sampler.hpp"
#include "core/result/partition.hpp"
#include "core/result/possible_events.hpp"
#include "core/result/run.hpp"
#include "core/result/subscene.hpp"
#include "core/solve/simulation.hpp"

namespace rheonet {

namespace {

class Explainer {
 public:
  explicit Explainer(const Scene& whole)
      : whole_(whole), reach_(influence_cone(whole)), cut_out_(reach_ ? cut_out(whole, reach_->node, reach_->element) : Scene{}),
        near_(reach_ ? cut_out_ : whole), asked_(divide(near_, {.apart = false})),
        unmerged_(asked_.subscenes.empty() ? near_ : asked_.subscenes.front().scene), reduction_(merge(unmerged_)),
        scene_(reduction_ ? reduction_->scene : unmerged_), by_method_(scene_, scene_.method), network_(by_method_.network()) {}

  Explanation explain() {
    find_effects();
    find_beyond();
    find_merged();
    find_limits();
    find_pairs();
    find_free_ends();
    find_parts_of_it();
    Observed observed(*this);
    const SimulationSettings settings{.stop = scene_.stop - scene_.start, .accuracy = scene_.accuracy, .interrupt = nullptr,
                                      .progress = {}, .profile = nullptr};
    const SimulationStatistics statistics = check_start(network_, needed_positions(network_), settings, observed);
    result_.notes = network_.notes;
    result_.notes.insert(result_.notes.end(), statistics.notes.begin(), statistics.notes.end());
    PossibleEvents possible = possible_events(network_);
    result_.events = std::move(possible.events);
    result_.cost.known_instants = possible.known_instants;
    predict();
    result_.left_out = omissions_.take();
    return std::move(result_);
  }

 private:
  /// Examines the equations at the start.
  class Observed final : public Observer {
   public:
    explicit Observed(Explainer& explainer) : explainer_(explainer) {}
    void begin(Dae& dae, Consistency& consistency, double t, const std::vector<double>& y, const std::vector<double>& yp,
               double) override {
      explainer_.find_unknowns(dae);
      explainer_.find_followers(dae);
      explainer_.find_structure(dae);
      explainer_.find_rates(dae, consistency, t, y, yp);
    }
    void step(const Integrator&) override {}
    void event(const Event&) override {}
    void end(double) override {}

   private:
    Explainer& explainer_;
  };

  const std::string& element(int e) const { return scene_.elements[at(e)].name; }

  void leave_out(Explanation::Omission line, const std::string& name) {
    omissions_.add(line.reduction + '\n' + line.what + '\n' + line.reason, line, name);
  }

  void find_parts_of_it() {
    result_.structure.parts = find_parts(near_).count;
    const Partition partition = divide(near_, {.apart = !near_.output_events});
    result_.structure.integrations = static_cast<int>(std::max<std::size_t>(partition.subscenes.size(), 1));
    for (const std::string& name : partition.left_out) {
      leave_out({.reduction = name_of(Reduction::unasked),
                 .what = "element",
                 .reason = "nothing that is recorded or claimed depends on its part of the network"},
                name);
    }
  }

  void find_beyond() {
    if (!reach_) return;
    const std::string reason = fmt::format(
        "nothing comes there before the stop: it is more than {} elements away from all that moves, starts or is recorded",
        reach_->farthest);
    for (std::size_t e = 0; e < whole_.elements.size(); ++e) {
      if (reach_->element[e]) continue;
      const std::string& type = components()[at(whole_.elements[e].declaration)]->declaration.type;
      leave_out({.reduction = name_of(Reduction::reach), .what = type, .reason = reason}, whole_.elements[e].name);
    }
  }

  void find_merged() {
    if (!reduction_) return;
    const std::string& chains = name_of(Reduction::chains);
    for (const int e : reduction_->elements) {
      const SceneElement& element = unmerged_.elements[at(e)];
      leave_out({.reduction = chains,
                 .what = components()[at(element.declaration)]->declaration.type,
                 .reason = "another one stands for all that are in series or side by side with it"},
                element.name);
    }
    for (const NodeId node : reduction_->nodes) {
      leave_out({.reduction = chains, .what = "node", .reason = "it lies between elements for which one stands", .of_nodes = true},
                unmerged_.nodes[at(node)].name);
    }
  }

  void find_effects() {
    std::map<Effect, Explanation::EffectFound> found;
    for (const SceneElement& e : whole_.elements) {
      const std::vector<Effect> out = left_out_of(whole_, e);
      for (const Effect effect : brought_by(e)) {
        const bool absent = std::find(out.begin(), out.end(), effect) != out.end();
        (absent ? found[effect].left_out : found[effect].by).push_back(e.name);
      }
    }
    for (const int e : feedback_of(network_)) found[Effect::feedback].by.push_back(element(e));
    find_open_loops(found[Effect::feedback]);
    for (const Effect effect : effects()) {
      found[effect].effect = effect;
      result_.effects.push_back(found[effect]);
    }
  }

  /// Finds blocks that would be in feedback loops if the scene did not leave feedback out.
  void find_open_loops(Explanation::EffectFound& feedback) {
    Scene closed = scene_;
    const auto left_out = std::erase_if(closed.without, [](const EffectLeftOut& e) { return e.effect == Effect::feedback; });
    if (left_out == 0) return;
    for (const int e : feedback_of(build_network(closed))) {
      if (std::find(feedback.by.begin(), feedback.by.end(), element(e)) == feedback.by.end()) feedback.left_out.push_back(element(e));
    }
  }

  static std::string what_is_left(const Reduced& law) {
    if (!law.component) return "carries no force";
    return "is " + name_of(law);
  }

  void find_limits() {
    for (const SceneElement& e : scene_.elements) {
      const Reduced law = take_limits(components()[at(e.declaration)], resolved_values(scene_, e));
      if (!law.limit) continue;
      const std::vector<Effect> out = left_out_of(scene_, e);
      const std::string type = components()[at(e.declaration)]->declaration.type;
      std::string reason = law.limit->when;
      if (!out.empty()) {
        std::vector<std::string> words;
        for (const Effect effect : out) words.push_back(in_words(effect));
        reason = fmt::format("the scene leaves out {}", fmt::join(words, ", "));
      }
      leave_out({.what = type, .reason = reason + ", so that it " + what_is_left(law)}, e.name);
    }
  }

  void find_pairs() {
    const std::string& name = name_of(Reduction::bundles);
    for (const Pair& pair : network_.pairs) {
      leave_out({.reduction = name,
                 .what = "node",
                 .reason = "nothing but a spring and a slider touch it: they are one element, whose force is a closed form of its displacement",
                 .of_nodes = true},
                scene_.nodes[at(pair.node)].name);
    }
    std::map<int, std::vector<std::string>> bundles;
    for (const Pair& pair : network_.pairs) bundles[pair.bundle].push_back(element(pair.slider));
    for (const auto& [bundle, sliders] : bundles) {
      if (sliders.size() < 2) continue;
      leave_out({.reduction = name,
                 .what = fmt::format("deflections of {} spring-slider pairs but", sliders.size()),
                 .reason = "all stand between the same two nodes: a bundle has one unknown, and no event at each yield"},
                sliders.front());
    }
  }

  void find_free_ends() {
    const FreeEnds& ends = network_.free_ends;
    for (std::size_t n = 0; n < ends.on.size(); ++n) {
      if (ends.on[n] == static_cast<NodeId>(n)) continue;
      leave_out({.what = "motion of", .reason = fmt::format("it hangs on `{}` alone, and moves with it", scene_.nodes[at(ends.on[n])].name),
                 .of_nodes = true},
                scene_.nodes[n].name);
    }
    for (const int e : ends.elements) {
      leave_out({.what = "force of", .reason = "it hangs on one node alone, and no force goes through"}, element(e));
    }
  }

  void find_unknowns(const Dae& dae) {
    Grouped<Explanation::Unknowns> unknowns;
    const auto add = [&](int unknown, Explanation::Unknowns line, const std::string& name) {
      if (unknown < 0) return;
      line.differential = dae.differential(unknown);
      unknowns.add(line.quantity + line.unit + line.equation + (line.differential ? "'" : ""), line, name);
      ++(line.differential ? result_.structure.differential : result_.structure.algebraic);
    };
    const auto unit = [&](const auto& of, Quantity quantity) { return unit_of(quantity, domain_of(scene_, of)); };
    const Structure& structure = dae.structure();
    for (const NodeId node : network_.node_order) {
      const bool massive = structure.kind[at(node)] == Kind::massive;
      const bool pivot = std::any_of(structure.train_equations.begin(), structure.train_equations.end(), [&](const Structure::TrainEquation& equation) { return equation.pivot == node; });
      add(dae.indices().velocity[at(node)],
          {.quantity = "velocity", .unit = unit(network_.node(node), Quantity::velocity),
           .equation = pivot ? "the velocities at its transmission fit together" : massive ? "mass times acceleration is the sum of forces" : "the forces at the node balance", .of_nodes = true},
          network_.node_name(node));
      add(dae.indices().position[at(node)],
          {.quantity = "position", .unit = unit(network_.node(node), Quantity::position), .equation = "its rate is the velocity", .of_nodes = true},
          network_.node_name(node));
    }
    std::vector<char> in_tree(network_.deflections.size(), 0);
    for (const Structure::Group& group : structure.groups) {
      if (group.tree_branch >= 0) in_tree[at(group.tree_branch)] = 1;
    }
    for (std::size_t j = 0; j < network_.deflections.size(); ++j) {
      const int branch = static_cast<int>(j);
      std::size_t i = 0;
      const bool creeps = dae.network().batch_of(branch, i).creeps(i);
      const std::string rate = creeps ? "its rate is the velocity of its ends, less what flows" : "its rate is the velocity of its ends";
      add(dae.indices().deflection[at(branch)],
          {.quantity = "deflection", .unit = unit(network_.element_of(network_.deflections[j]), Quantity::position), .equation = in_tree[j] ? "the forces at its end balance" : rate},
          network_.name_of(network_.deflections[j]));
    }
    for (std::size_t r = 0; r < network_.rates.size(); ++r) {
      add(dae.indices().force[r], {.quantity = "force", .unit = unit(network_.element_of(network_.rates[r]), Quantity::force), .equation = "its law"},
          network_.name_of(network_.rates[r]));
    }
    const BlockSignals& blocks = const_cast<Dae&>(dae).inputs().blocks();
    for (std::size_t k = 0; k < blocks.states(); ++k) {
      add(dae.indices().block[k], {.quantity = "state", .equation = "its rate follows from what it takes in"},
          element(network_.blocks.blocks[at(blocks.block_of_state(k))].element));
    }
    result_.unknowns = unknowns.take();
  }

  /// Lists quantities that follow from others and are not unknowns.
  void find_followers(const Dae& dae) {
    const Structure& structure = dae.structure();
    const std::string& given = name_of(Reduction::given);
    for (std::size_t j = 0; j < network_.deflections.size(); ++j) {
      if (!structure.driven[j]) continue;
      const bool joined = structure.deflections[j].a == structure.deflections[j].b;
      leave_out({.reduction = joined ? "" : given,
                 .what = "deflection of",
                 .reason = joined ? "sliders that stick hold its ends together" : "both its ends have given motions"},
                network_.name_of(network_.deflections[j]));
    }
    for (std::size_t r = 0; r < network_.rates.size(); ++r) {
      const Branch& b = structure.rates[r];
      if (structure.of_time[at(b.a)] && structure.of_time[at(b.b)]) {
        leave_out({.what = "velocity of", .reason = "both its ends have given motions"}, network_.name_of(network_.rates[r]));
      }
    }
    for (const NodeId node : network_.node_order) {
      if (node == ground) continue;
      const Kind kind = structure.kind[at(node)];
      if (kind == Kind::joined) {
        leave_out({.what = "velocity of", .reason = "it follows from another node: a sticking slider, a rigid link or a transmission joins them", .of_nodes = true},
                  network_.node_name(node));
      }
      if (kind == Kind::known && structure.of_time[at(node)] && structure.motion[at(node)] >= 0) {
        leave_out({.what = "motion of", .reason = "it is given as a function of time", .of_nodes = true}, network_.node_name(node));
      }
    }
    find_positions(dae);
  }

  void find_positions(const Dae& dae) {
    std::vector<char> followed(network_.nodes(), 0);
    for (const NodeId node : dae.positions().order) followed[at(node)] = 1;
    for (const NodeId node : network_.node_order) {
      if (node == ground || dae.structure().of_time[at(node)] || dae.indices().position[at(node)] >= 0) continue;
      const bool wanted = followed[at(node)] != 0;
      leave_out({.reduction = wanted ? "" : name_of(Reduction::positions),
                 .what = "position of",
                 .reason = wanted ? "it follows from the deflections of elements" : "nothing needs it",
                 .of_nodes = true},
                network_.node_name(node));
    }
  }

  /// Finds the index of the nodal equations (Estevez Schwarz and Tischendorf, Int. J. Circ. Theor. Appl. 28 (2000) 131), and
  /// that of the equations actually solved.
  void find_structure(const Dae& dae) {
    const Structure& structure = dae.structure();
    Explanation::Structure& s = result_.structure;
    s.loops = static_cast<int>(structure.closing.size());
    s.index = s.algebraic > 0 ? 1 : 0;
    std::vector<std::string> floating, carried, joined;
    for (const Structure::Group& group : structure.groups) {
      for (const NodeId node : group.nodes) floating.push_back(network_.node_name(node));
    }
    for (const Network::Mass& mass : network_.masses) {
      if (structure.kind[at(mass.node)] == Kind::known && mass.node != ground) carried.push_back(element(mass.element));
    }
    std::vector<int> masses(structure.rigid.size(), 0);
    for (std::size_t n = 1; n < masses.size(); ++n) masses[at(structure.rigid[n])] += structure.own_mass[n] > 0;
    for (const NodeId node : network_.node_order) {
      if (structure.own_mass[at(node)] > 0 && masses[at(structure.rigid[at(node)])] > 1) joined.push_back(network_.node_name(node));
    }
    const bool viscous = std::find(structure.kind.begin(), structure.kind.end(), Kind::viscous) != structure.kind.end();
    if (!floating.empty()) {
      s.index_as_wired = 2;
      s.because = "springs and friction alone hold " + format_list(floating) + ": the balance of forces there says nothing of the velocity";
    } else if (!carried.empty()) {
      s.index_as_wired = 2;
      s.because = "a given motion carries " + format_list(carried) + ": its force needs the rate of what is given";
    } else if (!joined.empty()) {
      s.index_as_wired = 2;
      s.because = "what joins the masses at " + format_list(joined) + " has a force that follows from their acceleration";
    } else if (viscous || !network_.motions.empty()) {
      s.index_as_wired = 1;
      s.because = viscous ? "forces balance at nodes without mass" : "the forces of given motions follow from the others";
    }
  }

  void find_rates(Dae& dae, Consistency& consistency, double t, const std::vector<double>& y, const std::vector<double>& yp) {
    Explanation::Cost& cost = result_.cost;
    cost.unknowns = dae.unknowns();
    if (scene_.method == Scene::Method::ida) cost.why_ida = "`method` asks for it";
    else if (by_method_.obstacle()) cost.why_ida = by_method_.obstacle()->reason;
    else if (scene_.method == Scene::Method::automatic && dae.unknowns() > numerics::arc_unknowns)
      cost.why_ida = fmt::format("{} unknowns are more than the {} up to which closed forms cost less", dae.unknowns(), numerics::arc_unknowns);
    cost.entries = dae.unknowns() > 0 ? dae.pattern().entries() : 0;
    cost.sparse = dae.unknowns() > numerics::dense_integration_limit;
    const double rate = dae.unknowns() > 0 ? consistency.fastest_rate(t, scene_.stop - scene_.start, y, yp) : 0;
    cost.fastest_rate = std::isfinite(rate) ? rate : 0;
    cost.fastest_drive = dae.inputs().fastest();
  }

  /// Runs a trial, and extrapolates from the second half of its steps.
  void predict() {
    Explanation::Cost& cost = result_.cost;
    std::atomic<bool> enough = false;
    std::vector<double> fractions;
    const double begin = thread_cpu_seconds();
    double spent = 0;
    const auto tried = [&](double fraction) {
      fractions.push_back(fraction);
      spent = thread_cpu_seconds() - begin;
      enough = spent > numerics::trial_run_time && fractions.size() >= numerics::trial_run_steps;
    };
    try {
      run(near_, {.interrupt = &enough, .progress = tried});
    } catch (const SimulationError& error) {
      if (!enough) result_.notes.push_back(std::string("the run will not come to its end: ") + error.what());
    }
    if (fractions.empty()) return;
    const std::size_t count = fractions.size(), half = count / 2;
    cost.tried_steps = static_cast<long>(count);
    cost.tried = fractions.back();
    cost.seconds_a_step = spent / static_cast<double>(count);
    cost.steps = static_cast<double>(count);
    const double later = fractions.back() - fractions[half];
    if (enough && later > 0) cost.steps += (1 - fractions.back()) * static_cast<double>(count - 1 - half) / later;
  }

  const Scene& whole_;
  const std::optional<InfluenceCone> reach_;
  const Scene cut_out_;
  const Scene& near_;      ///< `whole_` within reach
  const Partition asked_;
  const Scene& unmerged_;  ///< `near_` without unasked parts
  const std::optional<SeriesParallelReduction> reduction_;
  const Scene& scene_;     ///< the scene that is integrated
  const NetworkOfMethod by_method_;
  const Network& network_;
  Explanation result_;
  Grouped<Explanation::Omission> omissions_;
};

}  // namespace

Explanation explain(const Scene& scene) {
  const std::optional<Scene> converted = in_common_units(scene);
  return Explainer(converted ? *converted : scene).explain();
}

}  // namespace rheonet
