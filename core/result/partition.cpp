#include "core/result/partition.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "core/base/disjoint_sets.hpp"
#include "core/base/index.hpp"
#include "core/network/linear_law.hpp"
#include "core/network/network.hpp"
#include "core/network/parts.hpp"
#include "core/network/reductions.hpp"
#include "core/result/subscene.hpp"

namespace rheonet {

namespace {

/// Properties of a part that decide how it is integrated.
struct Nature {
  bool asked = false;
  bool may_fail = false;  ///< during a run: through bounded forces, delays, blocks or nonlinear damping
  bool switches = false;  ///< has events of its own
  bool delays = false;    ///< needs a delay history
  double stiffness = 0, mass = 0;  ///< largest stiffness and least mass in the part
  double drive = 0;                ///< largest angular frequency of its inputs [rad/s]

  /// Decade of its largest angular frequency, from stiffness and mass or inputs; decaying transients are ignored.
  int decade() const {
    const double own = stiffness > 0 && mass > 0 ? std::sqrt(stiffness / mass) : 0;
    const double fastest = std::max(own, drive);
    return fastest > 0 ? static_cast<int>(std::floor(std::log10(fastest))) : std::numeric_limits<int>::min();
  }
};

class Divider {
 public:
  Divider(const Scene& scene, const DivisionWishes& wishes)
      : scene_(scene), wishes_(wishes), idle_(wishes.drop ? idle_blocks() : std::vector<char>()), parts_(find_parts(scene, idle_)), joined_(static_cast<std::size_t>(std::max(parts_.count, 1))) {}

  Partition divide() {
    if (parts_.count < 2 && !any_idle()) return {};
    join_bundles();
    join_by_claims();
    for (const std::vector<Record>* records : {&scene_.records, &scene_.claimed}) {
      for (const Record& record : *records) ask(record);
    }
    return number_jobs() ? cut_up() : Partition{};
  }

 private:
  /// Flags blocks whose output reaches no motion, force, record or claim.
  std::vector<char> idle_blocks() const {
    std::vector<int> needed;
    std::vector<char> idle(scene_.blocks.size(), 1);
    const auto need = [&](int block) {
      if (std::exchange(idle[at(block)], 0)) needed.push_back(block);
    };
    for (const SceneFeed& feed : scene_.feeds) need(feed.block);
    if (scene_.stop_when >= 0) need(scene_.stop_when);
    for (const std::vector<Record>* records : {&scene_.records, &scene_.claimed}) {
      for (const Record& record : *records) {
        for_each_operand(scene_, record, [&](const Record& operand) {
          if (operand.subject == Record::Subject::block) need(operand.index);
        });
      }
    }
    for (std::size_t k = 0; k < needed.size(); ++k) {
      for (const SceneBlock::Input& input : scene_.blocks[at(needed[k])].inputs) {
        if (input.from_block) need(input.index);
      }
    }
    return idle;
  }
  bool any_idle() const { return std::find(idle_.begin(), idle_.end(), 1) != idle_.end(); }

  int part_of(NodeId node) { return parts_.of_node[at(node)] < 0 ? -1 : joined_.find(parts_.of_node[at(node)]); }
  int part_of_element(int e) { return parts_.of_element[at(e)] < 0 ? -1 : joined_.find(parts_.of_element[at(e)]); }
  const Component& component(int e) const { return *components()[at(scene_.elements[at(e)].declaration)]; }

  void join(int part, int other) {
    if (part >= 0 && other >= 0) joined_.join(part, other);
  }

  /// All parts at the node of a motion: they contribute to its force.
  std::vector<int> parts_at(NodeId node) {
    if (at_node_.empty()) {
      at_node_.resize(scene_.nodes.size());
      for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
        const int part = parts_.of_element[e];
        if (part < 0) continue;
        for_each_node(scene_.elements[e], [&](NodeId end) {
          if (end != ground && parts_.of_node[at(end)] < 0) at_node_[at(end)].insert(part);
        });
      }
    }
    return {at_node_[at(node)].begin(), at_node_[at(node)].end()};
  }

  std::vector<int> parts_of(const Record& record) {
    std::vector<int> found;
    const auto add = [&](int part) {
      if (part >= 0) found.push_back(part);
    };
    const auto add_force = [&](int e) {
      add(part_of_element(e));
      if (component(e).role != Role::motion) return;
      for (const int part : parts_at(scene_.elements[at(e)].a)) add(part);
    };
    switch (record.subject) {
      case Record::Subject::node:
        add(part_of(record.index));
        break;
      case Record::Subject::element:
        record.channel == Record::Channel::force || record.channel == Record::Channel::power ? add_force(record.index) : add(part_of_element(record.index));
        if (scene_.elements[at(record.index)].at) add(part_of(scene_.elements[at(record.index)].a));
        break;
      case Record::Subject::block:
        add(part_of_element(scene_.blocks[at(record.index)].element));
        break;
      case Record::Subject::assembly: {
        const SceneAssembly& assembly = scene_.assemblies[at(record.index)];
        if (record.channel == Record::Channel::force) {
          for (const SceneAssembly::Term& term : assembly.force) add_force(term.element);
        } else {
          add(part_of(assembly.a));
          add(part_of(assembly.b));
        }
        break;
      }
      case Record::Subject::expression:
        for_each_operand(scene_, record, [&](const Record& operand) {
          for (const int part : parts_of(operand)) found.push_back(part);
        });
        break;
    }
    for (int& part : found) part = joined_.find(part);
    return found;
  }

  /// Joins parts that a bundle connects: spring-slider pairs between the same two nodes are one element with a closed form.
  void join_bundles() {
    std::vector<Reduced> laws;
    for (const SceneElement& element : scene_.elements) laws.push_back(law_of(scene_, element));
    std::map<std::pair<NodeId, NodeId>, int> part_between;
    for (const Pair& pair : find_pairs(scene_, laws)) {
      const int part = parts_.of_element[at(pair.slider)];
      join(part_between.try_emplace(std::minmax(pair.spring_end, pair.slider_end), part).first->second, part);
    }
  }

  /// Joins the parts that one claim, or one record other than a force, refers to.
  void join_by_claims() {
    const auto join_all = [&](const std::vector<int>& parts) {
      for (const int part : parts) join(parts.front(), part);
    };
    for (const Claim& claim : scene_.claims) {
      std::vector<int> parts = parts_of(scene_.claimed[at(claim.record)]);
      if (claim.per >= 0) {
        const std::vector<int> per = parts_of(scene_.claimed[at(claim.per)]);
        parts.insert(parts.end(), per.begin(), per.end());
      }
      join_all(parts);
    }
    for (const Record& record : scene_.records) {
      if (record.channel != Record::Channel::force) join_all(parts_of(record));
    }
  }

  void ask(const Record& record) {
    for (const int part : parts_of(record)) nature_[part].asked = true;
  }

  void look_at_elements() {
    for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
      const int part = part_of_element(static_cast<int>(e));
      if (part >= 0) look_at(scene_.elements[e], nature_[part]);
    }
    // Shared motions drive all parts at their nodes.
    for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
      if (parts_.of_element[e] >= 0 || component(static_cast<int>(e)).role != Role::motion) continue;
      for (const int part : parts_at(scene_.elements[e].a)) {
        Nature& nature = nature_[joined_.find(part)];
        for (const Signal& signal : scene_.elements[e].signals) nature.drive = std::max(nature.drive, fastest(signal));
      }
    }
  }

  double fastest(const Signal& signal) const {
    const Piece piece = signal.piece(scene_.start);
    const double of_period = std::isfinite(piece.end) && piece.end > scene_.start ? 1 / (piece.end - scene_.start) : 0;
    return std::max(std::abs(piece.omega), of_period);
  }

  void look_at(const SceneElement& element, Nature& nature) const {
    const Reduced law = law_of(scene_, element);
    if (!law.component) return;
    const std::vector<Parameter>& parameters = law.component->declaration.parameters;
    for (std::size_t k = 0; k < law.values.size(); ++k) {
      if (!std::isfinite(law.values[k]) || law.values[k] <= 0) continue;
      if (parameters[k].quantity == Quantity::stiffness) nature.stiffness = std::max(nature.stiffness, law.values[k]);
      if (parameters[k].quantity == Quantity::mass) nature.mass = nature.mass > 0 ? std::min(nature.mass, law.values[k]) : law.values[k];
    }
    for (const Signal& signal : element.signals) nature.drive = std::max(nature.drive, fastest(signal));
    const Values one = law.batch();
    switch (law.component->role) {
      case Role::slip:
        nature.switches = nature.may_fail = true;
        break;
      case Role::deflection: {
        const auto batch = law.component->deflection(one);
        nature.switches = nature.switches || batch->events(0) > 0;
        // A bounded force may be overloaded. A delayed force may drive the motion that it should damp.
        nature.may_fail = nature.may_fail || batch->events(0) > 0 || batch->delay(0) > 0;
        nature.delays = nature.delays || batch->delay(0) > 0;
        break;
      }
      case Role::rate:
        nature.may_fail = nature.may_fail || !law.component->rate(one)->linear(0);
        break;
      case Role::block:
        nature.may_fail = true;
        nature.switches = nature.switches || law.component->block(law.values).limits() || law.component->block(law.values).period > 0 || law.component->declaration.is_function();
        nature.delays = nature.delays || law.component->block(law.values).delay > 0;
        break;
      case Role::motion:
      case Role::force:
      case Role::mass:
      case Role::inerter:
      case Role::train:
      case Role::nothing:
        break;
    }
  }

  /// Assigns parts to jobs. Returns false if a division gains nothing.
  bool number_jobs() {
    for (int part = 0; part < parts_.count; ++part) nature_[joined_.find(part)];
    if (nature_.empty() || (nature_.size() < 2 && !any_idle())) return false;
    look_at_elements();
    // The error test does not cover the delay history of a part without mass: the steps of the other parts keep it accurate.
    if (std::any_of(nature_.begin(), nature_.end(), [](const auto& part) { return part.second.delays; })) return false;
    std::map<int, int> of_decade;
    for (const auto& [part, nature] : nature_) {
      if (wishes_.drop && !nature.asked && !nature.may_fail) {
        unasked_.push_back(part);
      } else if (!wishes_.apart) {
        job_[part] = 0;
        jobs_ = 1;
      } else if (nature.switches) {
        job_[part] = jobs_++;
      } else {
        const auto [found, fresh] = of_decade.try_emplace(nature.decade(), jobs_);
        if (fresh) ++jobs_;
        job_[part] = found->second;
      }
    }
    if (jobs_ == 0) {  // all records are of given motions, but something has to run
      job_[unasked_.front()] = jobs_++;
      unasked_.erase(unasked_.begin());
    }
    return jobs_ > 1 || !unasked_.empty() || any_idle();
  }

  Partition cut_up() {
    Partition partition;
    std::vector<int> job_of(static_cast<std::size_t>(parts_.count), -1);
    for (int part = 0; part < parts_.count; ++part) {
      const auto job = job_.find(joined_.find(part));
      job_of[at(part)] = job == job_.end() ? jobs_ : job->second;
    }
    std::vector<Subscene> subscenes = cut(scene_, parts_, job_of, unasked_.empty() ? jobs_ : jobs_ + 1, unasked_.empty() ? -1 : jobs_);
    for (int job = 0; job < jobs_; ++job) partition.subscenes.push_back(std::move(subscenes[at(job)]));
    if (!unasked_.empty()) partition.unasked.push_back(std::move(subscenes.back()));
    for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
      const int part = parts_.of_element[e];
      if (part >= 0 && job_of[at(part)] == jobs_) partition.left_out.push_back(scene_.elements[e].name);
    }
    for (std::size_t b = 0; b < idle_.size(); ++b) {
      if (idle_[b]) partition.left_out.push_back(scene_.elements[at(scene_.blocks[b].element)].name);
    }
    return partition;
  }

  const Scene& scene_;
  const DivisionWishes wishes_;
  const std::vector<char> idle_;  ///< of each block; empty: all are kept
  const Parts parts_;
  DisjointSets joined_;
  std::map<int, Nature> nature_;  ///< of each joined part, by its representative
  std::map<int, int> job_;
  std::vector<int> unasked_;
  std::vector<std::set<int>> at_node_;
  int jobs_ = 0;
};

}  // namespace

Partition divide(const Scene& scene, const DivisionWishes& asked) {
  const DivisionWishes wishes{.apart = asked.apart && !kept(scene, Reduction::parts), .drop = asked.drop && !kept(scene, Reduction::unasked)};
  if (!wishes.apart && !wishes.drop) return {};
  return Divider(scene, wishes).divide();
}

}  // namespace rheonet
