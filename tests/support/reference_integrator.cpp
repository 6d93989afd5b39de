#include "tests/support/reference_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "tests/support/reference_run.hpp"

namespace rheonet::test {

namespace {

// Implicit Euler is late or early at a turn by a few steps. Rows in between are on the other side of the corner.
constexpr double late = 6;

// The error of a row takes this number of rows before and after it into account.
constexpr std::size_t around = 2;
// Runs whose ends differ by less than this fraction of the run's length end at the same time.
constexpr double same_end = 3e-3;

using Rows = std::vector<std::vector<double>>;

/// One better solution from the last two, whose errors go with the step to a power: `factor` is 2 to that.
Rows extrapolated(const std::vector<Rows>& from, double factor) {
  const Rows &fine = from.back(), &coarse = from[from.size() - 2];
  Rows better(std::min(fine.size(), coarse.size()));
  for (std::size_t i = 0; i < better.size(); ++i) {
    for (std::size_t k = 0; k < fine[i].size(); ++k) better[i].push_back(fine[i][k] + (fine[i][k] - coarse[i][k]) / (factor - 1));
  }
  return better;
}

/// Largest change of a record by the last halving.
double change(const std::vector<Rows>& solutions, std::size_t k) {
  const Rows &fine = solutions.back(), &coarse = solutions[solutions.size() - 2];
  double largest = 0;
  for (std::size_t i = 0; i < std::min(fine.size(), coarse.size()); ++i) largest = std::max(largest, std::abs(fine[i][k] - coarse[i][k]));
  return largest;
}

class Halvings {
 public:
  Halvings(const Scene& scene, Declarations declarations, const ReferenceSettings& settings)
      : scene_(scene), declarations_(declarations), settings_(settings) {
    result_.columns.resize(scene.records.size());
  }

  ReferenceSolution go() {
    for (int halving = 0; halving <= settings_.halvings; ++halving) {
      if (!halve(halving)) break;
      if (halving < 2) continue;
      bool good = halving >= 3 || settings_.halvings < 3;
      good = find_turns(halving) && good;
      for (std::size_t k = 0; k < result_.columns.size(); ++k) good = find_column(k) && good;
      if (good) break;
    }
    return std::move(result_);
  }

 private:
  double length() const { return scene_.stop - scene_.start; }
  const ReferenceRun& run() const { return *all_.back(); }

  /// False where the steps are too short for rounding.
  bool halve(int halving) {
    all_.push_back(std::make_unique<ReferenceRun>(scene_, declarations_, settings_.base_steps, 1 << halving));
    const bool complete = all_.back()->go();
    // A force that nothing balances is unbalanced at any step. If longer steps found a balance, these are too short for round-off.
    if (halving > 2 && !complete && run().end() < result_.end - same_end * length()) return false;
    result_.complete = complete;
    result_.end = run().end();
    result_.fork = halving == 0 ? run().fork() : std::min(result_.fork, run().fork());
    result_.steps = settings_.base_steps << halving;
    runs_.push_back(run().rows());
    if (halving >= 1) second_.push_back(extrapolated(runs_, 2));
    if (halving >= 2) third_.push_back(extrapolated(second_, 4));
    return true;
  }

  /// Rows at a turn: there is nothing to extrapolate if it comes before the row with one step and after it with another. False if
  /// these are many.
  bool find_turns(int halving) {
    std::size_t common = runs_.back().size(), lost = 0;
    for (const Rows& rows : runs_) common = std::min(common, rows.size());
    result_.time.resize(common);
    turning_.assign(common, 0);
    for (std::size_t i = 0; i < common; ++i) {
      result_.time[i] = std::min(scene_.start + static_cast<double>(i) * scene_.output_every, scene_.stop);
      for (std::size_t j = all_.size() - 3; j < all_.size(); ++j) {
        const double h = length() / settings_.base_steps / (1 << (halving - 2));
        if (all_[j]->pieces()[i] != run().pieces()[i] || all_[j]->turned_near(result_.time[i], late * h)) turning_[i] = 1;
      }
      if (turning_[i]) ++lost;
    }
    return 10 * lost <= common;
  }

  /// False where it is not as good as it should be yet.
  bool find_column(std::size_t k) {
    const std::size_t common = result_.time.size();
    // Where the solution is smooth the third order is better, where it has corners the second may be.
    const bool smooth = third_.size() >= 2 && change(third_, k) < change(second_, k);
    const std::vector<Rows>& solutions = smooth ? third_ : second_;
    const Rows &fine = solutions.back(), &coarse = solutions[solutions.size() - 2];
    ReferenceSolution::Column& column = result_.columns[k];
    column.value = column.coarse = column.error = std::vector<double>(common);
    column.scale = 0;
    for (std::size_t i = 0; i < common; ++i) column.scale = std::max(column.scale, std::abs(fine[i][k]));
    for (std::size_t i = 0; i < common; ++i) {
      column.value[i] = fine[i][k];
      column.coarse[i] = second_.front()[i][k];
      column.error[i] = std::abs(fine[i][k] - coarse[i][k]);
      // Two solutions may agree by chance: what the halving before changed counts too, by the quarter that it should.
      if (solutions.size() > 2) {
        const Rows& coarsest = solutions[solutions.size() - 3];
        column.error[i] = std::max(column.error[i], std::abs(coarse[i][k] - coarsest[i][k]) / 4);
      }
      // Beyond a corner that the extrapolation has smoothed over, what it gains by its order is not to be trusted.
      if (!third_.empty()) column.error[i] = std::max(column.error[i], std::abs(third_.back()[i][k] - second_.back()[i][k]));
    }
    return widen(k);
  }

  /// The difference of two solutions changes its sign now and then, and is no measure of their error there.
  bool widen(std::size_t k) {
    ReferenceSolution::Column& column = result_.columns[k];
    const std::size_t common = result_.time.size();
    const std::vector<double> alone = column.error;
    bool good = true;
    for (std::size_t i = 0; i < common; ++i) {
      for (std::size_t j = i - std::min(i, around); j < std::min(common, i + around + 1); ++j) {
        column.error[i] = std::max(column.error[i], alone[j]);
      }
      const bool open = turning_[i] || result_.time[i] > result_.fork;
      good = good && (open || column.error[i] <= settings_.target * column.scale);
      column.error[i] += run().late()[i][k];
      if (open || (scene_.records[k].channel == Record::Channel::force && run().open()[i])) column.error[i] = INFINITY;
    }
    return good;
  }

  const Scene& scene_;
  const Declarations declarations_;
  const ReferenceSettings& settings_;
  ReferenceSolution result_;
  std::vector<std::unique_ptr<ReferenceRun>> all_;
  std::vector<Rows> runs_, second_, third_;  ///< one for each halving: as computed; extrapolated once; twice
  std::vector<char> turning_;                ///< of each row
};

}  // namespace

ReferenceSolution integrate_reference(const Scene& scene, Declarations declarations, const ReferenceSettings& settings) {
  return Halvings(scene, declarations, settings).go();
}

}  // namespace rheonet::test
