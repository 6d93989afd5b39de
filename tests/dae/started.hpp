#pragma once

#include <doctest/doctest.h>

#include "core/base/index.hpp"
#include "core/dae/state_powers.hpp"
#include "tests/support/probe.hpp"
#include "tests/support/scene_builder.hpp"

namespace rheonet::test {

/// A scene just after its first instant.
class Started {
 public:
  explicit Started(const SceneBuilder& builder)
      : scene_(builder.finish(1, 10, 1e-6)), probe_(scene_), jump(probe_.change()) {
    view_ = probe_.dae().view(0, probe_.y().data(), probe_.yp().data());
  }

  double velocity(const std::string& node) const { return view_.velocity[at(id(node))]; }
  double position(const std::string& node) const { return view_.position[at(id(node))]; }
  double reaction(const std::string& node) const { return StatePowers(probe_.dae()).reaction(id(node)); }
  double force(const std::string& element) const {
    const Network::Place place = place_of(element);
    return place.role == Role::rate ? view_.rate_force[at(place.index)] : view_.f[at(place.index)];
  }
  double deflection(const std::string& element) const { return view_.p[at(place_of(element).index)]; }
  double deflection_rate(const std::string& element) const { return view_.dp[at(place_of(element).index)]; }
  double acceleration(const std::string& node) const { return probe_.yp()[at(probe_.dae().indices().velocity[at(id(node))])]; }
  const Dae::View& view() const { return view_; }

 private:
  NodeId id(const std::string& node) const {
    for (std::size_t n = 0; n < scene_.nodes.size(); ++n) {
      if (scene_.nodes[n].name == node) return static_cast<NodeId>(n);
    }
    FAIL("no node " << node);
    return -1;
  }
  Network::Place place_of(const std::string& element) const {
    for (std::size_t e = 0; e < scene_.elements.size(); ++e) {
      if (scene_.elements[e].name == element) return probe_.network().places[e];
    }
    FAIL("no element " << element);
    return {};
  }

  Scene scene_;
  mutable Probe probe_;
  Dae::View view_;

 public:
  const EventChange& jump;
};

inline doctest::Approx exactly(double value) { return doctest::Approx(value).epsilon(1e-12); }

}  // namespace rheonet::test
