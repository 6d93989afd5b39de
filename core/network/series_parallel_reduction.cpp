#include "core/network/series_parallel_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "core/base/index.hpp"
#include "core/network/component.hpp"
#include "core/network/linear_law.hpp"
#include "core/network/linear_network.hpp"
#include "core/network/reductions.hpp"

namespace rheonet {

namespace {

constexpr int spring = 1, dashpot = 2;

class Merger {
 public:
  explicit Merger(const Scene& scene)
      : scene_(scene), kind_(scene.elements.size(), 0), laws_(scene.elements.size()), stays_(scene.nodes.size(), 0), alone_(scene.elements.size(), 0) {}

  std::optional<SeriesParallelReduction> merge() {
    if (!worth_it()) return {};
    keep_what_is_asked();
    LinearNetwork net(scene_, kind_, laws_, stays_, alone_);
    net.merge_all();
    if (!net.any()) return {};
    net_ = &net;
    build();
    return std::move(result_);
  }

 private:
  const Component& component(std::size_t e) const { return *components()[at(scene_.elements[e].declaration)]; }

  /// Finds the linear elements. Returns false if no two of a kind are in series or in parallel.
  bool worth_it() {
    std::vector<char> count(scene_.nodes.size(), 0);
    std::vector<std::pair<std::uint64_t, int>> between;
    for (std::size_t e = 0; e < kind_.size(); ++e) {
      const SceneElement& element = scene_.elements[e];
      const auto touch = [&](NodeId node) { count[at(node)] = static_cast<char>(std::min(3, count[at(node)] + 1)); };
      for_each_node(element, touch);
      find_law(e);
      if (kind_[e] == 0) continue;
      const auto [low, high] = std::minmax(element.a, element.b);
      between.emplace_back(static_cast<std::uint64_t>(low) << 32 | static_cast<std::uint64_t>(high), kind_[e]);
    }
    std::sort(between.begin(), between.end());
    if (std::adjacent_find(between.begin(), between.end()) != between.end()) return true;
    std::vector<char> kinds(scene_.nodes.size(), 0);
    for (std::size_t e = 0; e < kind_.size(); ++e) {
      if (kind_[e] == 0) continue;
      for (const NodeId node : {scene_.elements[e].a, scene_.elements[e].b}) {
        if (node != ground && count[at(node)] == 2 && kinds[at(node)] == kind_[e]) return true;
        kinds[at(node)] = static_cast<char>(kind_[e]);
      }
    }
    return false;
  }

  void find_law(std::size_t e) {
    const SceneElement& element = scene_.elements[e];
    const Role role = component(e).role;
    if (element.at || element.a == element.b || (role != Role::deflection && role != Role::rate) || starts_by_itself(element)) return;
    const std::optional<LinearLaw> law = linear_law(law_of(scene_, element));
    if (!law) return;
    kind_[e] = law->spring ? spring : dashpot;
    laws_[e] = {law->coefficient, law->rest};
  }

  void stay(NodeId node) { stays_[at(node)] = 1; }
  void stay_with_ends(int e) {
    alone_[at(e)] = 1;
    stay(scene_.elements[at(e)].a);
    stay(scene_.elements[at(e)].b);
  }

  void keep_what_is_asked() {
    stay(ground);
    for (std::size_t n = 0; n < stays_.size(); ++n) {
      if (!std::isnan(scene_.nodes[n].position) || !std::isnan(scene_.nodes[n].velocity)) stays_[n] = 1;
    }
    for (const Record& record : scene_.records) {
      if (record.subject == Record::Subject::expression) stay_with(record);
      if (record.subject == Record::Subject::node) stay(record.index);
      // The energy of an element is no linear function of the quantities of its merger.
      const bool linear = record.channel == Record::Channel::force || record.channel == Record::Channel::displacement || record.channel == Record::Channel::velocity;
      if (record.subject == Record::Subject::element && !linear) stay_with_ends(record.index);
      // A dashpot's displacement is no multiple of its merger's: it depends on where it began.
      const bool place = record.channel == Record::Channel::displacement;
      if (record.subject == Record::Subject::element && place && kind_[at(record.index)] != spring) {
        stay(scene_.elements[at(record.index)].a);
        stay(scene_.elements[at(record.index)].b);
      }
      if (record.subject == Record::Subject::assembly && record.channel != Record::Channel::force) {
        stay(scene_.assemblies[at(record.index)].a);
        stay(scene_.assemblies[at(record.index)].b);
      }
    }
    for (const std::vector<Record>* records : {&scene_.claimed, &scene_.sensed}) {
      for (const Record& record : *records) stay_with(record);
    }
  }

  /// Keeps all that a record refers to.
  void stay_with(const Record& record) {
    for_each_operand(scene_, record, [this](const Record& operand) {
      if (operand.subject == Record::Subject::node) stay(operand.index);
      if (operand.subject == Record::Subject::element) stay_with_ends(operand.index);
      if (operand.subject != Record::Subject::assembly) return;
      stay(scene_.assemblies[at(operand.index)].a);
      stay(scene_.assemblies[at(operand.index)].b);
      for (const SceneAssembly::Term& term : scene_.assemblies[at(operand.index)].force) stay_with_ends(term.element);
    });
  }

  void build() {
    number();
    Scene& s = result_.scene;
    s = scene_;
    s.nodes.clear();
    for (std::size_t n = 0; n < node_.size(); ++n) {
      if (node_[n] >= 0) s.nodes.push_back(scene_.nodes[n]);
      else result_.nodes.push_back(static_cast<NodeId>(n));
    }
    s.elements.clear();
    for (std::size_t e = 0; e < element_.size(); ++e) {
      if (element_[e] >= 0) s.elements.push_back(standing(e));
      else result_.elements.push_back(static_cast<int>(e));
    }
    for (SceneAssembly& assembly : s.assemblies) {
      assembly.a = std::max(node_[at(assembly.a)], 0);
      assembly.b = std::max(node_[at(assembly.b)], 0);
      std::erase_if(assembly.force, [&](SceneAssembly::Term& term) { return (term.element = element_[at(term.element)]) < 0; });
    }
    for (SceneBlock& block : s.blocks) block.element = element_[at(block.element)];
    for (SceneFeed& feed : s.feeds) feed.element = element_[at(feed.element)];
    for (std::vector<Record>* records : {&s.sensed, &s.claimed}) {
      for (Record& record : *records) renumber(record);
    }
    for (SceneExpression& expression : s.expressions) {
      for (Record& operand : expression.operands) renumber(operand);
    }
    s.exact.clear();
    s.records.clear();
    for (const Record& record : scene_.records) take(record);
  }

  /// Numbers the remaining elements and nodes; -1: eliminated. A merged element takes the place of its first member.
  void number() {
    element_.assign(scene_.elements.size(), -1);
    stands_.assign(scene_.elements.size(), 0);
    int count = 0;
    for (std::size_t e = 0; e < element_.size(); ++e) {
      LinearNetwork::Share share;
      const std::size_t root = net_->find(e, share);
      if (net_->home(root) != e) continue;
      element_[e] = count++;
      stands_[e] = root;
    }
    count = 0;
    node_.assign(scene_.nodes.size(), -1);
    for (std::size_t n = 0; n < node_.size(); ++n) {
      if (!net_->left_out(static_cast<NodeId>(n))) node_[n] = count++;
    }
  }

  SceneElement standing(std::size_t e) const {
    SceneElement element = scene_.elements[e];
    const std::size_t id = stands_[e];
    element.a = node_[at(net_->first(id))];
    element.b = element.at ? ground : node_[at(net_->second(id))];
    if (id == e) return element;
    Reduced law = law_of(scene_, scene_.elements[e]);
    element.declaration = static_cast<int>(std::find(components().begin(), components().end(), law.component) - components().begin());
    std::vector<double> values = std::move(law.values);
    const std::vector<Parameter>& parameters = law.component->declaration.parameters;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      if (parameters[k].kind != Parameter::Kind::value) continue;
      if (parameters[k].quantity == (kind_[e] == spring ? Quantity::stiffness : Quantity::damping)) values[k] = net_->law(id).K;
      if (parameters[k].quantity == Quantity::position) values[k] = net_->law(id).R;
    }
    element.values = std::move(values);
    return element;
  }

  void renumber(Record& record) const {
    if (record.subject == Record::Subject::node) record.index = node_[at(record.index)];
    if (record.subject == Record::Subject::element) record.index = element_[at(record.index)];
  }

  void take(const Record& record) {
    SeriesParallelReduction::Sum sum;
    if (record.subject == Record::Subject::element && kind_[at(record.index)] != 0) {
      add(record.index, record.channel, record.factor, sum);
    } else if (record.subject == Record::Subject::assembly && record.channel == Record::Channel::force) {
      for (const SceneAssembly::Term& term : scene_.assemblies[at(record.index)].force) add(term.element, record.channel, record.factor * term.sign, sum);
    } else {
      Record same = record;
      renumber(same);
      same.factor = 1;
      sum.terms.emplace_back(base(same), record.factor);
    }
    result_.records.push_back(std::move(sum));
  }

  /// Adds a quantity of an element, expressed by its merger.
  void add(int e, Record::Channel channel, double sign, SeriesParallelReduction::Sum& sum) {
    LinearNetwork::Share share;
    const std::size_t home = net_->home(net_->find(at(e), share));
    double factor = share.P, offset = 0;
    if (channel == Record::Channel::force) {
      factor = share.G;
      offset = share.H;
    } else if (channel == Record::Channel::displacement) {
      offset = share.Q;
    }
    sum.offset += sign * offset;
    const Record record{.path = scene_.elements[home].name, .subject = Record::Subject::element, .index = element_[home], .channel = channel};
    sum.terms.emplace_back(base(record), sign * factor);
  }

  /// The index of a record in the reduced scene, where each record occurs once.
  std::size_t base(const Record& record) {
    std::vector<Record>& records = result_.scene.records;
    const auto [found, fresh] = known_.try_emplace({record.subject, record.index, record.channel}, records.size());
    if (fresh) records.push_back(record);
    return found->second;
  }

  const Scene& scene_;
  std::vector<int> kind_;
  std::vector<LinearNetwork::Law> laws_;
  std::vector<char> stays_, alone_;
  LinearNetwork* net_ = nullptr;
  std::vector<int> element_, node_;
  std::vector<std::size_t> stands_;  ///< of each remaining element: its id in the LinearNetwork
  std::map<std::tuple<Record::Subject, int, Record::Channel>, std::size_t> known_;
  SeriesParallelReduction result_;
};

}  // namespace

std::optional<SeriesParallelReduction> merge(const Scene& scene) {
  if (kept(scene, Reduction::chains)) return {};
  return Merger(scene).merge();
}

}  // namespace rheonet
