#include "tests/support/reference_integrator.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/support/reference_run.hpp"

namespace rheonet::test {

namespace {

// Implicit Euler is late, or early, for a turn by a few steps; what comes between has another side of the corner.
constexpr double late = 6;

// So many rows before and after have a say in the error of one.
constexpr std::size_t around = 2;
// Runs that stop this near to each other, of the run's length, stop at one time.
constexpr double same_end = 3e-3;

}  // namespace

ReferenceSolution integrate_reference(const Scene& scene, Declarations declarations,
                                      const ReferenceSettings& settings) {
  using Rows = std::vector<std::vector<double>>;
  ReferenceSolution result;
  const std::size_t columns = scene.records.size();
  result.columns.resize(columns);
  std::vector<std::unique_ptr<ReferenceRun>> all;
  std::vector<Rows> runs, second, third;  // one for each halving: as computed; extrapolated once; twice
  const auto extrapolate = [&](const std::vector<Rows>& from, double factor) {
    const Rows &fine = from.back(), &coarse = from[from.size() - 2];
    Rows better(std::min(fine.size(), coarse.size()), std::vector<double>(columns));
    for (std::size_t i = 0; i < better.size(); ++i) {
      for (std::size_t k = 0; k < columns; ++k) better[i][k] = fine[i][k] + (fine[i][k] - coarse[i][k]) / (factor - 1);
    }
    return better;
  };
  // Largest change of a record by the last halving.
  const auto change = [&](const std::vector<Rows>& solutions, std::size_t k) {
    const Rows &fine = solutions.back(), &coarse = solutions[solutions.size() - 2];
    double largest = 0;
    for (std::size_t i = 0; i < std::min(fine.size(), coarse.size()); ++i) {
      largest = std::max(largest, std::abs(fine[i][k] - coarse[i][k]));
    }
    return largest;
  };
  for (int halving = 0; halving <= settings.halvings; ++halving) {
    all.push_back(std::make_unique<ReferenceRun>(scene, declarations, settings.base_steps, 1 << halving));
    const ReferenceRun& run = *all.back();
    const bool complete = all.back()->go();
    // What nothing balances is so whatever the step. Where longer steps found a balance these are too short for rounding.
    if (halving > 2 && !complete && run.end() < result.end - same_end * (scene.stop - scene.start)) break;
    result.complete = complete;
    result.end = run.end();
    result.fork = halving == 0 ? run.fork() : std::min(result.fork, run.fork());
    result.steps = settings.base_steps << halving;
    runs.push_back(run.rows());
    if (halving >= 1) second.push_back(extrapolate(runs, 2));
    if (halving >= 2) third.push_back(extrapolate(second, 4));
    if (halving < 2) continue;
    bool good = halving >= 3 || settings.halvings < 3;
    std::size_t common = runs.back().size();
    for (const Rows& rows : runs) common = std::min(common, rows.size());
    result.time.resize(common);
    // Rows at a turn: there is nothing to extrapolate if it comes before the row with one step and after it with another.
    std::vector<char> turning(common, 0);
    std::size_t lost = 0;
    for (std::size_t i = 0; i < common; ++i) {
      result.time[i] = std::min(scene.start + static_cast<double>(i) * scene.output_every, scene.stop);
      for (std::size_t j = all.size() - 3; j < all.size(); ++j) {
        const double h = (scene.stop - scene.start) / settings.base_steps / (1 << (halving - 2));
        if (all[j]->pieces()[i] != run.pieces()[i] || all[j]->turned_near(result.time[i], late * h)) turning[i] = 1;
      }
      if (turning[i]) ++lost;
    }
    good = good && 10 * lost <= common;
    for (std::size_t k = 0; k < columns; ++k) {
      // Where the solution is smooth the third order is better, where it has corners the second may be.
      const bool smooth = third.size() >= 2 && change(third, k) < change(second, k);
      const std::vector<Rows>& solutions = smooth ? third : second;
      const Rows &fine = solutions.back(), &coarse = solutions[solutions.size() - 2];
      ReferenceSolution::Column& column = result.columns[k];
      column.value = column.coarse = column.error = std::vector<double>(common);
      column.scale = 0;
      for (std::size_t i = 0; i < common; ++i) column.scale = std::max(column.scale, std::abs(fine[i][k]));
      for (std::size_t i = 0; i < common; ++i) {
        column.value[i] = fine[i][k];
        column.coarse[i] = second.front()[i][k];
        column.error[i] = std::abs(fine[i][k] - coarse[i][k]);
        // Two solutions may agree by chance: what the halving before changed counts too, by the quarter that it should.
        if (solutions.size() > 2) {
          const Rows& coarsest = solutions[solutions.size() - 3];
          column.error[i] = std::max(column.error[i], std::abs(coarse[i][k] - coarsest[i][k]) / 4);
        }
        // Beyond a corner that the extrapolation has smoothed over, what it gains by its order is not to be trusted.
        if (!third.empty()) {
          column.error[i] = std::max(column.error[i], std::abs(third.back()[i][k] - second.back()[i][k]));
        }
      }
      // The difference of two solutions changes its sign now and then, and is no measure of their error there.
      const std::vector<double> alone = column.error;
      for (std::size_t i = 0; i < common; ++i) {
        for (std::size_t j = i - std::min(i, around); j < std::min(common, i + around + 1); ++j) {
          column.error[i] = std::max(column.error[i], alone[j]);
        }
        good = good && (turning[i] || result.time[i] > result.fork || column.error[i] <= settings.target * column.scale);
        column.error[i] += run.late()[i][k];
        if (turning[i] || result.time[i] > result.fork) column.error[i] = INFINITY;
        if (scene.records[k].channel == Record::Channel::force && run.open()[i]) column.error[i] = INFINITY;
      }
    }
    if (good) break;
  }
  return result;
}

}  // namespace rheonet::test
