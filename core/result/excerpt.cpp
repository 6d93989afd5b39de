#include "core/result/excerpt.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "core/network/component.hpp"
#include "core/network/index.hpp"

namespace rheonet {

namespace {

/// One of the scenes, and the numbers that things of the whole have in it; -1: none.
struct Numbers {
  std::vector<int> node, element, assembly, block;
};

class Cutter {
 public:
  Cutter(const Scene& scene, const Parts& parts, const std::vector<int>& job_of, int jobs, int unasked)
      : scene_(scene), jobs_(jobs), of_node_(scene.nodes.size()), of_element_(scene.elements.size()) {
    const auto job = [&](int part) { return job_of[at(part)]; };
    for (std::size_t e = 0; e < scene.elements.size(); ++e) {
      if (parts.of_element[e] < 0) continue;
      const SceneElement& element = scene.elements[e];
      of_element_[e].insert(job(parts.of_element[e]));
      if (role(e) == Role::block) continue;
      of_node_[at(element.a)].insert(job(parts.of_element[e]));
      if (!element.at) of_node_[at(element.b)].insert(job(parts.of_element[e]));
    }
    for (std::size_t e = 0; e < scene.elements.size(); ++e) {
      if (parts.of_element[e] >= 0 || role(e) == Role::block) continue;
      std::set<int>& there = of_node_[at(scene.elements[e].a)];
      if (std::all_of(there.begin(), there.end(), [&](int j) { return j == unasked; })) there.insert(0);
      if (role(e) == Role::motion) {
        of_element_[e] = there;
      } else {
        of_element_[e].insert(*there.begin());
      }
    }
  }

  std::vector<Excerpt> cut() {
    std::vector<Excerpt> result;
    for (int job = 0; job < jobs_; ++job) result.push_back(excerpt(job));
    return result;
  }

 private:
  Role role(std::size_t e) const { return components()[at(scene_.elements[e].declaration)]->role; }

  Excerpt excerpt(int job) {
    Excerpt result;
    Scene& s = result.scene;
    s.title = scene_.title;
    s.domain = scene_.domain;
    s.without = scene_.without;
    s.keep = scene_.keep;
    s.start_from = scene_.start_from;
    s.start = scene_.start;
    s.stop = scene_.stop;
    s.accuracy = scene_.accuracy;
    s.output_every = scene_.output_every;
    s.output_intervals = scene_.output_intervals;
    s.output_events = scene_.output_events;
    Numbers n;
    n.node.assign(scene_.nodes.size(), -1);
    n.element.assign(scene_.elements.size(), -1);
    for (std::size_t k = 0; k < scene_.nodes.size(); ++k) {
      if (k != ground && !of_node_[k].contains(job)) continue;
      n.node[k] = static_cast<int>(s.nodes.size());
      s.nodes.push_back(scene_.nodes[k]);
    }
    for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
      if (!of_element_[e].contains(job)) continue;
      n.element[e] = static_cast<int>(s.elements.size());
      s.elements.push_back(scene_.elements[e]);
      s.elements.back().a = n.node[at(scene_.elements[e].a)];
      if (!scene_.elements[e].at) s.elements.back().b = n.node[at(scene_.elements[e].b)];
    }
    take_assemblies(s, n);
    take_blocks(s, n);
    take_records(result, n);
    return result;
  }

  void take_assemblies(Scene& s, Numbers& n) const {
    n.assembly.assign(scene_.assemblies.size(), -1);
    for (std::size_t k = 0; k < scene_.assemblies.size(); ++k) {
      SceneAssembly assembly = scene_.assemblies[k];
      assembly.a = n.node[at(assembly.a)];
      assembly.b = n.node[at(assembly.b)];
      std::erase_if(assembly.force, [&](SceneAssembly::Term& term) { return (term.element = n.element[at(term.element)]) < 0; });
      if (assembly.force.empty() && (assembly.a < 0 || assembly.b < 0)) continue;
      n.assembly[k] = static_cast<int>(s.assemblies.size());
      s.assemblies.push_back(std::move(assembly));
    }
  }

  void take_blocks(Scene& s, Numbers& n) const {
    n.block.assign(scene_.blocks.size(), -1);
    int count = 0;
    for (std::size_t k = 0; k < scene_.blocks.size(); ++k) {
      if (n.element[at(scene_.blocks[k].element)] >= 0) n.block[k] = count++;
    }
    for (std::size_t k = 0; k < scene_.blocks.size(); ++k) {
      if (n.block[k] < 0) continue;
      SceneBlock block = scene_.blocks[k];
      block.element = n.element[at(block.element)];
      for (SceneBlock::Input& input : block.inputs) {
        if (input.from_block) {
          input.index = n.block[at(input.index)];
          continue;
        }
        Record sensed = scene_.sensed[at(input.index)];
        sensed.index = number(sensed, n);
        input.index = static_cast<int>(s.sensed.size());
        s.sensed.push_back(std::move(sensed));
      }
      s.blocks.push_back(std::move(block));
    }
    for (const SceneFeed& feed : scene_.feeds) {
      if (n.element[at(feed.element)] >= 0) s.feeds.push_back({n.element[at(feed.element)], n.block[at(feed.block)], feed.sign});
    }
  }

  static int number(const Record& record, const Numbers& n) {
    switch (record.subject) {
      case Record::Subject::node:
        return n.node[at(record.index)];
      case Record::Subject::element:
        return n.element[at(record.index)];
      case Record::Subject::assembly:
        return n.assembly[at(record.index)];
      case Record::Subject::block:
        break;
    }
    return n.block[at(record.index)];
  }

  /// What this job has of a record.
  std::optional<Record> taken(const Record& whole, const Scene& s, const Numbers& n) const {
    Record record = whole;
    record.index = number(whole, n);
    if (record.index < 0) return {};
    if (record.subject == Record::Subject::assembly) {
      const SceneAssembly& assembly = s.assemblies[at(record.index)];
      const bool whole_ends = assembly.a >= 0 && assembly.b >= 0;
      if (record.channel == Record::Channel::force ? assembly.force.empty() : !whole_ends) return {};
    }
    return record;
  }

  /// A force may be a sum over jobs; all else is taken from the first job that has it.
  bool sums(const Record& record) const { return record.channel == Record::Channel::force; }

  void take_records(Excerpt& result, const Numbers& n) {
    Scene& s = result.scene;
    for (std::size_t k = 0; k < scene_.records.size(); ++k) {
      const auto record = taken(scene_.records[k], s, n);
      if (!record || (!sums(*record) && recorded_.contains(k))) continue;
      recorded_.insert(k);
      result.records.push_back(k);
      s.records.push_back(*record);
    }
    std::vector<int> claimed(scene_.claimed.size(), -1);
    const auto claim_record = [&](int whole) {
      int& mine = claimed[at(whole)];
      if (mine >= 0) return mine;
      s.claimed.push_back(*taken(scene_.claimed[at(whole)], s, n));
      return mine = static_cast<int>(s.claimed.size()) - 1;
    };
    for (std::size_t k = 0; k < scene_.claims.size(); ++k) {
      const Claim& claim = scene_.claims[k];
      const bool here = taken(scene_.claimed[at(claim.record)], s, n) && (claim.per < 0 || taken(scene_.claimed[at(claim.per)], s, n));
      if (!here || !claimed_.insert(k).second) continue;
      Claim mine = claim;
      mine.record = claim_record(claim.record);
      if (claim.per >= 0) mine.per = claim_record(claim.per);
      result.claims.push_back(k);
      s.claims.push_back(mine);
    }
  }

  const Scene& scene_;
  const int jobs_;
  std::vector<std::set<int>> of_node_, of_element_;
  std::set<std::size_t> recorded_, claimed_;
};

}  // namespace

std::vector<Excerpt> cut(const Scene& scene, const Parts& parts, const std::vector<int>& job_of, int jobs, int unasked) {
  return Cutter(scene, parts, job_of, jobs, unasked).cut();
}

}  // namespace rheonet
