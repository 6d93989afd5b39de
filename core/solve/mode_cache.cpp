#include "core/solve/mode_cache.hpp"

#include "core/base/index.hpp"
#include "core/base/numerics.hpp"

namespace rheonet {

System::System(const Network& network, Structure s, Inputs& inputs, const std::vector<char>& needed, const Modes& modes,
               Tolerances& tolerances, const Integrator::Options& options)
    : structure(std::move(s)),
      dae(network, structure, inputs, needed),
      consistency(dae),
      events(dae, consistency, tolerances, modes),
      missed_events(dae, events),
      integrator(dae, events, tolerances.values(), tolerances.grains(), options) {}

ModeCache::ModeCache(const Network& network, const Structure& classified, Inputs& inputs, const std::vector<char>& needed,
                 const Modes& modes, Tolerances& tolerances, const Integrator::Options& options)
    : network_(network), inputs_(inputs), needed_(needed), modes_(modes), tolerances_(tolerances), options_(options) {
  for (const Laws<DeflectionBatch>& laws : network.deflection_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const Branch& b = network.deflections[at(laws.first) + i];
      const bool floating = classified.group[at(b.a)] >= 0 || classified.group[at(b.b)] >= 0;
      if (floating && laws.batch->events(i) > 0) may_tie_.push_back({laws.batch.get(), i});
    }
  }
}

const std::shared_ptr<System>& ModeCache::of_modes() {
  std::vector<char> key;
  for (signed char mode : modes_.slider) key.push_back(mode == Modes::stuck);
  for (std::size_t k = 0; k < network_.trains.size(); ++k) {
    if (!network_.trains[k].loss) continue;
    key.push_back(modes_.slider[at(network_.trains[k].friction)]);
    key.push_back(modes_.b_drives[k]);
  }
  for (const auto& [batch, i] : may_tie_) key.push_back(batch->constant(i));
  auto found = mode_cache_.find(key);
  if (found == mode_cache_.end()) {
    if (mode_cache_.size() >= numerics::modes_kept) {
      history_ = statistics();
      mode_cache_.clear();
    }
    found = mode_cache_.emplace(key, std::make_shared<System>(network_, analyse(network_, modes_), inputs_, needed_, modes_,
                                                           tolerances_, options_)).first;
  }
  return found->second;
}

Integrator::Statistics ModeCache::statistics() const {
  Integrator::Statistics sum = history_;
  for (const auto& [key, system] : mode_cache_) sum += system->integrator.statistics();
  return sum;
}

}  // namespace rheonet
