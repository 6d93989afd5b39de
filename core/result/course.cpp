#include "core/result/course.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/result/manner.hpp"

namespace rheonet {

Course run_to_memory(const Scene& scene, RunSettings settings) {
  const Manner usual{.order = settings.order};
  return run_to_memory_in(usual, scene, std::move(settings));
}

Course run_to_memory_in(const Manner& manner, const Scene& scene, RunSettings settings) {
  Course course;
  settings.row = [&course, also = std::move(settings.row)](double time, const std::vector<double>& values) {
    if (also) also(time, values);
    course.times.push_back(time);
    course.rows.push_back(values);
  };
  course.summary = run_in(manner, scene, settings);
  return course;
}

Difference difference(const Course& first, std::size_t first_column, const Course& second, std::size_t second_column) {
  Difference result;
  double squares = 0;
  const std::size_t rows = std::min(first.rows.size(), second.rows.size());
  for (std::size_t row = 0; row < rows; ++row) {
    const double a = first.rows[row][first_column], b = second.rows[row][second_column];
    const double apart = std::abs(b - a);
    squares += apart * apart;
    result.scale = std::max({result.scale, std::abs(a), std::abs(b)});
    if (row > 0 && apart <= result.largest) continue;
    result.largest = apart;
    result.time = first.times[row];
    result.first = a;
    result.second = b;
  }
  result.rms = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(rows, 1)));
  return result;
}

}  // namespace rheonet
