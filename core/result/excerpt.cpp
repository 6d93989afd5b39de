#include "core/result/excerpt.hpp"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "core/network/component.hpp"
#include "core/network/index.hpp"

namespace rheonet {

namespace {

/// Takes some of the nodes and elements of a scene, and what belongs to these.
class Taker {
 public:
  /// node(k), element(e): whether it is taken; ground always is.
  template <class Node, class Element>
  Taker(const Scene& whole, Node node, Element element)
      : whole_(whole), node_(whole.nodes.size(), -1), element_(whole.elements.size(), -1) {
    take_settings();
    for (std::size_t k = 0; k < whole.nodes.size(); ++k) {
      if (k != ground && !node(k)) continue;
      node_[k] = static_cast<int>(scene_.nodes.size());
      scene_.nodes.push_back(whole.nodes[k]);
    }
    for (std::size_t e = 0; e < whole.elements.size(); ++e) {
      if (!element(e)) continue;
      element_[e] = static_cast<int>(scene_.elements.size());
      scene_.elements.push_back(whole.elements[e]);
      scene_.elements.back().a = node_[at(whole.elements[e].a)];
      if (!whole.elements[e].at) scene_.elements.back().b = node_[at(whole.elements[e].b)];
    }
    take_assemblies();
    take_blocks();
  }

  Scene& scene() { return scene_; }

  /// What there is here of a record of the whole.
  std::optional<Record> taken(const Record& whole) const {
    Record record = whole;
    record.index = number(whole);
    if (record.index < 0) return {};
    if (record.subject == Record::Subject::assembly) {
      const SceneAssembly& assembly = scene_.assemblies[at(record.index)];
      const bool whole_ends = assembly.a >= 0 && assembly.b >= 0;
      if (record.channel == Record::Channel::force ? assembly.force.empty() : !whole_ends) return {};
    }
    return record;
  }

 private:
  void take_settings() {
    scene_.title = whole_.title;
    scene_.domain = whole_.domain;
    scene_.without = whole_.without;
    scene_.keep = whole_.keep;
    scene_.start_from = whole_.start_from;
    scene_.start = whole_.start;
    scene_.stop = whole_.stop;
    scene_.accuracy = whole_.accuracy;
    scene_.output_every = whole_.output_every;
    scene_.output_intervals = whole_.output_intervals;
    scene_.output_events = whole_.output_events;
  }

  void take_assemblies() {
    assembly_.assign(whole_.assemblies.size(), -1);
    for (std::size_t k = 0; k < whole_.assemblies.size(); ++k) {
      SceneAssembly assembly = whole_.assemblies[k];
      assembly.a = node_[at(assembly.a)];
      assembly.b = node_[at(assembly.b)];
      std::erase_if(assembly.force, [&](SceneAssembly::Term& term) { return (term.element = element_[at(term.element)]) < 0; });
      if (assembly.force.empty() && (assembly.a < 0 || assembly.b < 0)) continue;
      assembly_[k] = static_cast<int>(scene_.assemblies.size());
      scene_.assemblies.push_back(std::move(assembly));
    }
  }

  void take_blocks() {
    block_.assign(whole_.blocks.size(), -1);
    int count = 0;
    for (std::size_t k = 0; k < whole_.blocks.size(); ++k) {
      if (element_[at(whole_.blocks[k].element)] >= 0) block_[k] = count++;
    }
    for (std::size_t k = 0; k < whole_.blocks.size(); ++k) {
      if (block_[k] < 0) continue;
      SceneBlock block = whole_.blocks[k];
      block.element = element_[at(block.element)];
      for (SceneBlock::Input& input : block.inputs) {
        if (input.from_block) {
          input.index = block_[at(input.index)];
          continue;
        }
        Record sensed = whole_.sensed[at(input.index)];
        sensed.index = number(sensed);
        input.index = static_cast<int>(scene_.sensed.size());
        scene_.sensed.push_back(std::move(sensed));
      }
      scene_.blocks.push_back(std::move(block));
    }
    for (const SceneFeed& feed : whole_.feeds) {
      if (element_[at(feed.element)] >= 0) scene_.feeds.push_back({element_[at(feed.element)], block_[at(feed.block)], feed.sign});
    }
  }

  int number(const Record& record) const {
    switch (record.subject) {
      case Record::Subject::node:
        return node_[at(record.index)];
      case Record::Subject::element:
        return element_[at(record.index)];
      case Record::Subject::assembly:
        return assembly_[at(record.index)];
      case Record::Subject::block:
        break;
    }
    return block_[at(record.index)];
  }

  const Scene& whole_;
  Scene scene_;
  std::vector<int> node_, element_, assembly_, block_;  ///< the numbers that those of the whole have here; -1: none
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
    Taker taker(scene_, [&](std::size_t node) { return of_node_[node].contains(job); },
                [&](std::size_t element) { return of_element_[element].contains(job); });
    Excerpt result;
    take_records(result, taker);
    result.scene = std::move(taker.scene());
    return result;
  }

  /// A force may be a sum over jobs; all else is taken from the first job that has it.
  bool sums(const Record& record) const { return record.channel == Record::Channel::force; }

  void take_records(Excerpt& result, Taker& taker) {
    Scene& s = taker.scene();
    for (std::size_t k = 0; k < scene_.records.size(); ++k) {
      const auto record = taker.taken(scene_.records[k]);
      if (!record || (!sums(*record) && recorded_.contains(k))) continue;
      recorded_.insert(k);
      result.records.push_back(k);
      s.records.push_back(*record);
    }
    std::vector<int> claimed(scene_.claimed.size(), -1);
    const auto claim_record = [&](int whole) {
      int& mine = claimed[at(whole)];
      if (mine >= 0) return mine;
      s.claimed.push_back(*taker.taken(scene_.claimed[at(whole)]));
      return mine = static_cast<int>(s.claimed.size()) - 1;
    };
    for (std::size_t k = 0; k < scene_.claims.size(); ++k) {
      const Claim& claim = scene_.claims[k];
      const bool here = taker.taken(scene_.claimed[at(claim.record)]) && (claim.per < 0 || taker.taken(scene_.claimed[at(claim.per)]));
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

Scene cut_out(const Scene& scene, const std::vector<char>& nodes, const std::vector<char>& elements) {
  Taker taker(scene, [&](std::size_t node) { return nodes[node] != 0; }, [&](std::size_t element) { return elements[element] != 0; });
  Scene& s = taker.scene();
  for (const Record& record : scene.records) s.records.push_back(*taker.taken(record));
  for (const Record& record : scene.claimed) s.claimed.push_back(*taker.taken(record));
  s.claims = scene.claims;
  return std::move(s);
}

}  // namespace rheonet
