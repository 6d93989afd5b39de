#include "core/result/subscene.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/base/index.hpp"
#include "core/network/component.hpp"

namespace rheonet {

namespace {

/// Indices into a scene of the members of a subscene, in the order of the scene. Ground is always contained.
struct Taking {
  std::vector<int> nodes, elements, blocks, feeds;
  /// For each recorded, claimed or sensed assembly: the terms of its force whose elements the subscene contains.
  std::vector<std::pair<int, SceneAssembly::Term>> terms;
};

/// The index in the subscene of each node, element, assembly and block of a scene; -1: not contained. The arrays are shared
/// by successive subscenes, each of which resets only the entries that it has set.
struct Numbers {
  explicit Numbers(const Scene& whole)
      : node(whole.nodes.size(), -1), element(whole.elements.size(), -1), assembly(whole.assemblies.size(), -1), block(whole.blocks.size(), -1) {}
  std::vector<int> node, element, assembly, block;
};

/// Copies a subscene into a scene of its own. The cost grows with the subscene, not with the whole scene.
class Taker {
 public:
  Taker(const Scene& whole, const Taking& taking, Numbers& numbers) : whole_(whole), taking_(taking), numbers_(numbers) {
    take_settings();
    number(taking.blocks, numbers.block);
    take_node(ground);
    for (const int k : taking.nodes) {
      if (k != ground) take_node(k);
    }
    for (const int e : taking.elements) take_element(e);
    for (const int k : taking.blocks) take_block(whole.blocks[at(k)]);
    if (whole.stop_when >= 0) scene_.stop_when = numbers.block[at(whole.stop_when)];
    for (const int k : taking.feeds) {
      const SceneFeed& feed = whole.feeds[at(k)];
      scene_.feeds.push_back({numbers.element[at(feed.element)], feed.parameter, numbers.block[at(feed.block)], feed.sign});
    }
  }
  ~Taker() {
    numbers_.node[ground] = -1;
    for (const int k : taking_.nodes) numbers_.node[at(k)] = -1;
    for (const int k : taking_.elements) numbers_.element[at(k)] = -1;
    for (const int k : taking_.blocks) numbers_.block[at(k)] = -1;
    for (const int k : assemblies_) numbers_.assembly[at(k)] = -1;
  }
  Taker(const Taker&) = delete;
  Taker& operator=(const Taker&) = delete;

  Scene& scene() { return scene_; }

  /// A record of the whole scene as a record of the subscene; absent if the subscene lacks its subject.
  std::optional<Record> taken(const Record& whole) {
    Record record = whole;
    record.index = number(whole);
    if (record.index < 0) return {};
    if (record.subject == Record::Subject::expression) return record;
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
    scene_.method = whole_.method;
    scene_.method_spot = whole_.method_spot;
    scene_.common_units = whole_.common_units;
    scene_.start = whole_.start;
    scene_.stop = whole_.stop;
    scene_.accuracy = whole_.accuracy;
    scene_.output_every = whole_.output_every;
    scene_.output_intervals = whole_.output_intervals;
    scene_.output_events = whole_.output_events;
  }

  static void number(const std::vector<int>& taken, std::vector<int>& numbers) {
    for (std::size_t k = 0; k < taken.size(); ++k) numbers[at(taken[k])] = static_cast<int>(k);
  }

  void take_node(int k) {
    numbers_.node[at(k)] = static_cast<int>(scene_.nodes.size());
    scene_.nodes.push_back(whole_.nodes[at(k)]);
  }

  void take_element(int e) {
    numbers_.element[at(e)] = static_cast<int>(scene_.elements.size());
    SceneElement& element = scene_.elements.emplace_back(whole_.elements[at(e)]);
    element.a = numbers_.node[at(element.a)];
    if (!element.at) element.b = numbers_.node[at(element.b)];
    element.support = numbers_.node[at(element.support)];
  }

  int take_assembly(int k) {
    int& mine = numbers_.assembly[at(k)];
    if (mine >= 0) return mine;
    mine = static_cast<int>(scene_.assemblies.size());
    assemblies_.push_back(k);
    const SceneAssembly& whole = whole_.assemblies[at(k)];
    SceneAssembly& assembly = scene_.assemblies.emplace_back(
        SceneAssembly{.name = whole.name, .a = numbers_.node[at(whole.a)], .b = numbers_.node[at(whole.b)], .force = {}, .spot = whole.spot});
    const auto before = [](const auto& term, int index) { return term.first < index; };
    auto term = std::lower_bound(taking_.terms.begin(), taking_.terms.end(), k, before);
    for (; term != taking_.terms.end() && term->first == k; ++term)
      assembly.force.push_back({numbers_.element[at(term->second.element)], term->second.sign});
    return mine;
  }

  void take_block(const SceneBlock& whole) {
    SceneBlock block = whole;
    block.element = numbers_.element[at(block.element)];
    for (SceneBlock::Input& input : block.inputs) {
      if (input.from_block) {
        input.index = numbers_.block[at(input.index)];
        continue;
      }
      Record sensed = whole_.sensed[at(input.index)];
      sensed.index = number(sensed);
      input.index = static_cast<int>(scene_.sensed.size());
      scene_.sensed.push_back(std::move(sensed));
    }
    scene_.blocks.push_back(std::move(block));
  }

  int number(const Record& record) {
    switch (record.subject) {
      case Record::Subject::node:
        return numbers_.node[at(record.index)];
      case Record::Subject::element:
        return numbers_.element[at(record.index)];
      case Record::Subject::assembly:
        return take_assembly(record.index);
      case Record::Subject::expression:
        return take_expression(record.index);
      case Record::Subject::block:
        break;
    }
    return numbers_.block[at(record.index)];
  }

  /// -1 if the subscene lacks an operand.
  int take_expression(int k) {
    SceneExpression expression = whole_.expressions[at(k)];
    for (Record& operand : expression.operands) {
      const std::optional<Record> mine = taken(operand);
      if (!mine) return -1;
      operand = *mine;
    }
    scene_.expressions.push_back(std::move(expression));
    return static_cast<int>(scene_.expressions.size()) - 1;
  }

  const Scene& whole_;
  const Taking& taking_;
  Numbers& numbers_;
  Scene scene_;
  std::vector<int> assemblies_;  ///< those that have been copied
};

/// Flags the assemblies that records, claims or blocks refer to.
std::vector<char> asked_assemblies(const Scene& scene) {
  std::vector<char> asked(scene.assemblies.size(), 0);
  for (const std::vector<Record>* records : {&scene.records, &scene.claimed, &scene.sensed}) {
    for (const Record& record : *records) {
      for_each_operand(scene, record, [&](const Record& operand) {
        if (operand.subject == Record::Subject::assembly) asked[at(operand.index)] = 1;
      });
    }
  }
  return asked;
}

class Cutter {
 public:
  Cutter(const Scene& scene, const Parts& parts, const std::vector<int>& job_of, int jobs, int unasked)
      : scene_(scene), numbers_(scene), jobs_of_node_(scene.nodes.size()), jobs_of_element_(scene.elements.size()), jobs_(at(jobs)) {
    find_jobs(parts, job_of, unasked);
    deal(jobs_of_node_, &Taking::nodes);
    deal(jobs_of_element_, &Taking::elements);
    for (std::size_t k = 0; k < scene.blocks.size(); ++k)
      for (const int job : jobs_of_element_[at(scene.blocks[k].element)]) jobs_[at(job)].taking.blocks.push_back(static_cast<int>(k));
    for (std::size_t k = 0; k < scene.feeds.size(); ++k)
      for (const int job : jobs_of_element_[at(scene.feeds[k].element)]) jobs_[at(job)].taking.feeds.push_back(static_cast<int>(k));
    const std::vector<char> asked = asked_assemblies(scene);
    for (std::size_t k = 0; k < asked.size(); ++k) {
      if (!asked[k]) continue;
      for (const SceneAssembly::Term& term : scene.assemblies[k].force)
        for (const int job : jobs_of_element_[at(term.element)]) jobs_[at(job)].taking.terms.emplace_back(static_cast<int>(k), term);
    }
    deal_records();
  }

  std::vector<Subscene> cut() {
    std::vector<Subscene> result;
    for (const Job& job : jobs_) result.push_back(subscene(job));
    return result;
  }

 private:
  struct Job {
    Taking taking;
    std::vector<std::size_t> records, claims;
  };

  Role role(std::size_t e) const { return components()[at(scene_.elements[e].declaration)]->role; }

  void find_jobs(const Parts& parts, const std::vector<int>& job_of, int unasked) {
    const auto job = [&](int part) { return job_of[at(part)]; };
    for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
      if (parts.of_element[e] < 0) continue;
      const SceneElement& element = scene_.elements[e];
      jobs_of_element_[e].insert(job(parts.of_element[e]));
      if (role(e) == Role::block) continue;
      for_each_node(element, [&](NodeId node) { jobs_of_node_[at(node)].insert(job(parts.of_element[e])); });
    }
    for (const SceneBlock& block : scene_.blocks) {
      const int part = parts.of_element[at(block.element)];
      if (part >= 0) find_jobs_of_sensed(block, job(part));
    }
    for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
      if (parts.of_element[e] >= 0 || role(e) == Role::block) continue;
      std::set<int>& there = jobs_of_node_[at(scene_.elements[e].a)];
      if (std::all_of(there.begin(), there.end(), [&](int j) { return j == unasked; })) there.insert(0);
      if (role(e) == Role::motion) {
        jobs_of_element_[e] = there;
      } else {
        jobs_of_element_[e].insert(*there.begin());
      }
    }
  }

  /// A block may sense a node with a given motion although no element of its part is there: copies the node and motion too.
  void find_jobs_of_sensed(const SceneBlock& block, int job) {
    for (const SceneBlock::Input& input : block.inputs) {
      if (input.from_block) continue;
      const Record& sensed = scene_.sensed[at(input.index)];
      const auto need_motion = [&](int e) {
        if (role(at(e)) == Role::motion) jobs_of_node_[at(scene_.elements[at(e)].a)].insert(job);
      };
      if (sensed.subject == Record::Subject::node) jobs_of_node_[at(sensed.index)].insert(job);
      if (sensed.subject == Record::Subject::element) need_motion(sensed.index);
      if (sensed.subject != Record::Subject::assembly) continue;
      const SceneAssembly& assembly = scene_.assemblies[at(sensed.index)];
      for (const NodeId end : {assembly.a, assembly.b}) jobs_of_node_[at(end)].insert(job);
      for (const SceneAssembly::Term& term : assembly.force) need_motion(term.element);
    }
  }

  void deal(const std::vector<std::set<int>>& jobs_of, std::vector<int> Taking::*list) {
    for (std::size_t k = 0; k < jobs_of.size(); ++k)
      for (const int job : jobs_of[k]) (jobs_[at(job)].taking.*list).push_back(static_cast<int>(k));
  }

  /// A force may be a sum over jobs; other records come from the first job that contains their subject.
  static bool sums(const Record& record) { return record.channel == Record::Channel::force; }

  void deal_records() {
    for (std::size_t k = 0; k < scene_.records.size(); ++k) {
      const std::set<int> jobs = jobs_of(scene_.records[k]);
      for (const int job : jobs) {
        jobs_[at(job)].records.push_back(k);
        if (!sums(scene_.records[k])) break;
      }
    }
    for (std::size_t k = 0; k < scene_.claims.size(); ++k) {
      const Claim& claim = scene_.claims[k];
      std::set<int> jobs = jobs_of(scene_.claimed[at(claim.record)]);
      if (claim.per >= 0) jobs = common(jobs, jobs_of(scene_.claimed[at(claim.per)]));
      if (!jobs.empty()) jobs_[at(*jobs.begin())].claims.push_back(k);
    }
  }

  static std::set<int> common(const std::set<int>& one, const std::set<int>& other) {
    std::set<int> both;
    std::set_intersection(one.begin(), one.end(), other.begin(), other.end(), std::inserter(both, both.end()));
    return both;
  }

  /// The jobs that contain the subject of a record, or a term of its force; for ground, which all contain, the first.
  std::set<int> jobs_of(const Record& record) const {
    switch (record.subject) {
      case Record::Subject::node:
        return record.index == ground ? std::set<int>{0} : jobs_of_node_[at(record.index)];
      case Record::Subject::element:
        return jobs_of_element_[at(record.index)];
      case Record::Subject::block:
        return jobs_of_element_[at(scene_.blocks[at(record.index)].element)];
      case Record::Subject::expression:
        return jobs_of_expression(scene_.expressions[at(record.index)]);
      case Record::Subject::assembly:
        break;
    }
    const SceneAssembly& assembly = scene_.assemblies[at(record.index)];
    if (sums(record)) {
      std::set<int> jobs;
      for (const SceneAssembly::Term& term : assembly.force) jobs.insert(jobs_of_element_[at(term.element)].begin(), jobs_of_element_[at(term.element)].end());
      return jobs;
    }
    if (assembly.a == ground || assembly.b == ground) return jobs_of({.path = {}, .subject = Record::Subject::node, .index = assembly.a == ground ? assembly.b : assembly.a});
    return common(jobs_of_node_[at(assembly.a)], jobs_of_node_[at(assembly.b)]);
  }

  /// The jobs that contain all operands. An expression over given motions alone may refer to nodes of several jobs.
  std::set<int> jobs_of_expression(const SceneExpression& expression) const {
    std::set<int> jobs;
    for (std::size_t job = 0; job < jobs_.size(); ++job) jobs.insert(static_cast<int>(job));
    for (const Record& operand : expression.operands) jobs = common(jobs, jobs_of(operand));
    return jobs;
  }

  Subscene subscene(const Job& job) {
    Subscene result{.scene = {}, .records = job.records, .claims = job.claims};
    Taker taker(scene_, job.taking, numbers_);
    Scene& s = taker.scene();
    for (const std::size_t k : job.records) s.records.push_back(*taker.taken(scene_.records[k]));
    std::map<int, int> claimed;
    const auto claim_record = [&](int whole) {
      const auto [mine, fresh] = claimed.try_emplace(whole, static_cast<int>(s.claimed.size()));
      if (fresh) s.claimed.push_back(*taker.taken(scene_.claimed[at(whole)]));
      return mine->second;
    };
    for (const std::size_t k : job.claims) {
      Claim mine = scene_.claims[k];
      mine.record = claim_record(mine.record);
      if (mine.per >= 0) mine.per = claim_record(mine.per);
      s.claims.push_back(mine);
    }
    result.scene = std::move(s);
    return result;
  }

  const Scene& scene_;
  Numbers numbers_;
  std::vector<std::set<int>> jobs_of_node_, jobs_of_element_;
  std::vector<Job> jobs_;
};

std::vector<int> marked(const std::vector<char>& marks) {
  std::vector<int> list;
  for (std::size_t k = 0; k < marks.size(); ++k) {
    if (marks[k]) list.push_back(static_cast<int>(k));
  }
  return list;
}

}  // namespace

std::vector<Subscene> cut(const Scene& scene, const Parts& parts, const std::vector<int>& job_of, int jobs, int unasked) {
  return Cutter(scene, parts, job_of, jobs, unasked).cut();
}

Scene cut_out(const Scene& scene, const std::vector<char>& nodes, const std::vector<char>& elements) {
  Taking taking{.nodes = marked(nodes), .elements = marked(elements), .blocks = {}, .feeds = {}, .terms = {}};
  for (std::size_t k = 0; k < scene.blocks.size(); ++k) {
    if (elements[at(scene.blocks[k].element)]) taking.blocks.push_back(static_cast<int>(k));
  }
  for (std::size_t k = 0; k < scene.feeds.size(); ++k) {
    if (elements[at(scene.feeds[k].element)]) taking.feeds.push_back(static_cast<int>(k));
  }
  const std::vector<char> asked = asked_assemblies(scene);
  for (std::size_t k = 0; k < asked.size(); ++k) {
    if (!asked[k]) continue;
    for (const SceneAssembly::Term& term : scene.assemblies[k].force) {
      if (elements[at(term.element)]) taking.terms.emplace_back(static_cast<int>(k), term);
    }
  }
  Numbers numbers(scene);
  Taker taker(scene, taking, numbers);
  Scene& s = taker.scene();
  for (const Record& record : scene.records) s.records.push_back(*taker.taken(record));
  for (const Record& record : scene.claimed) s.claimed.push_back(*taker.taken(record));
  s.claims = scene.claims;
  return std::move(s);
}

}  // namespace rheonet
