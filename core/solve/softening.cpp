#include "core/solve/softening.hpp"

#include <algorithm>
#include <limits>

#include "core/dae/rate_law.hpp"
#include "core/network/sets.hpp"
#include "core/network/index.hpp"

namespace rheonet {

Softening::Softening(const Network& network, const Structure& classified)
    : network_(network), least_velocity_(network.rates.size(), 0), stops_(network.rates.size(), 0) {
  find_stops(classified);
}

void Softening::find_stops(const Structure& classified) {
  const auto heavy = [&](NodeId n) { return classified.kind[at(n)] == Kind::known || classified.kind[at(n)] == Kind::massive; };
  const auto for_each_pseudoplastic = [&](auto visit) {
    for (const Laws<RateBatch>& laws : network_.rate_laws) {
      for (std::size_t i = 0; i < laws.batch->size(); ++i) {
        const std::size_t r = at(laws.first) + i;
        if (laws.batch->growth(i).exponent < 1) visit(r, network_.rates[r]);
      }
    }
  };
  // Chains of them through massless nodes.
  Sets chains(classified.kind.size());
  for_each_pseudoplastic([&](std::size_t, const Branch& b) {
    if (!heavy(b.a) && !heavy(b.b)) chains.join(b.a, b.b);
  });
  struct Ends { int heavy = 0; bool mass = false; };
  std::vector<Ends> ends(classified.kind.size());
  const auto ends_of = [&](const Branch& b) {
    Ends direct;
    Ends& sum = heavy(b.a) && heavy(b.b) ? direct : ends[at(chains.find(heavy(b.a) ? b.b : b.a))];
    for (const NodeId n : {b.a, b.b}) {
      sum.heavy += heavy(n) ? 1 : 0;
      sum.mass = sum.mass || classified.kind[at(n)] == Kind::massive;
    }
    return sum;
  };
  for_each_pseudoplastic([&](std::size_t, const Branch& b) { ends_of(b); });
  for_each_pseudoplastic([&](std::size_t r, const Branch& b) {
    const bool direct = heavy(b.a) && heavy(b.b);
    const Ends found = direct ? ends_of(b) : ends[at(chains.find(heavy(b.a) ? b.b : b.a))];
    stops_[r] = found.heavy > 1 && (found.mass || !direct);
  });
}

void Softening::begin(const Drive& drive, const std::vector<double>& velocity) {
  const Drive::Reach reach = coming_reach(drive, velocity);
  applied_.reset();
  std::fill(least_velocity_.begin(), least_velocity_.end(), 0.0);
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      if (!(laws.batch->growth(i).exponent > 1)) continue;
      const double coming_velocity = laws.batch->velocity_at(i, coming_force(*laws.batch, i, reach));
      least_velocity_[at(laws.first) + i] = std::numeric_limits<double>::epsilon() * coming_velocity;
    }
  }
}

void Softening::apply(const Tolerances::Unresolved& velocity) {
  // What follows such a law at once would jump with every change of it.
  constexpr double other = 2;
  const auto same = [](double a, double b) { return a == b || (a < other * b && b < other * a); };
  if (applied_ && same(velocity.pseudoplastic, applied_->pseudoplastic) && same(velocity.dilatant, applied_->dilatant)) return;
  applied_ = velocity;
  for (const Laws<RateBatch>& laws : network_.rate_laws) {
    for (std::size_t i = 0; i < laws.batch->size(); ++i) {
      const std::size_t r = at(laws.first) + i;
      const bool pseudoplastic = laws.batch->growth(i).exponent < 1;
      const double unresolved = pseudoplastic ? velocity.pseudoplastic : velocity.dilatant;
      laws.batch->soften(i, pseudoplastic && !stops_[r] ? 0 : std::max(unresolved, least_velocity_[r]));
    }
  }
}

}  // namespace rheonet
