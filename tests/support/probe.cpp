#include "tests/support/probe.hpp"

#include "core/result/output_sampler.hpp"
#include "core/solve/simulation.hpp"

namespace rheonet::test {

namespace {

// As in `simulate`: a run that would never end is to fail a test, not to stop all.
constexpr long most_steps = 1000000;

class Visitor final : public Observer {
 public:
  Visitor(Dae*& dae, int every, int samples, const Visit& visit)
      : dae_(dae), every_(every), samples_(samples), visit_(visit) {}

  void begin(Dae& dae, Consistency& consistency, double, const std::vector<double>&, const std::vector<double>&,
             double) override {
    dae_ = &dae;
    consistency_ = &consistency;
  }
  void step(const Integrator& integrator) override {
    if (steps_ > most_steps) throw SimulationError("the run gets nowhere");
    if (steps_++ % every_ != 0) return;
    const double a = integrator.previous_time(), b = integrator.time();
    for (int k = 0; k < samples_; ++k) {
      // Not the ends of a step: there a law may be at an event, on a kink.
      const double t = a + (b - a) * (k + 0.5) / samples_;
      integrator.interpolate(t, 0, y_);
      consistency_->derivative(t, y_, yp_);
      visit_(t, y_, yp_);
    }
  }
  void event(const Event&) override {}
  void end(double) override {}

 private:
  Dae*& dae_;
  Consistency* consistency_ = nullptr;
  int every_, samples_;
  const Visit& visit_;
  long steps_ = 0;
  std::vector<double> y_, yp_;
};

}  // namespace

Probe::Probe(const Scene& scene)
    : scene_(scene),
      network_(build_network(scene_)),
      classified_(classify(network_)),
      start_(network_, classified_) {
  EventTransition instant(network_, classified_, start_.inputs);
  std::vector<double> force(network_.sliders.size(), 0);
  modes_.slider.assign(network_.sliders.size(), Modes::stuck);
  start_.inputs.enter(0);
  change_ = instant.cross(0, scene_.stop - scene_.start, true, {}, start_.state, modes_, force);
  structure_ = analyse(network_, modes_);
  dae_ = std::make_unique<Dae>(network_, structure_, start_.inputs, needed_positions(network_));
  current_ = dae_.get();
  dae_->enter(0, start_.state, modes_, y_);
  Consistency consistency(*dae_);
  consistency.project(0, y_);
  consistency.derivative(0, y_, yp_);
}

void Probe::along(int every, int samples, const Visit& visit) {
  Visitor visitor(current_, every, samples, visit);
  simulate(
      network_, needed_positions(network_),
      {.stop = scene_.stop - scene_.start, .accuracy = scene_.accuracy, .interrupt = nullptr, .progress = {}},
      visitor);
  current_ = dae_.get();
}

}  // namespace rheonet::test
