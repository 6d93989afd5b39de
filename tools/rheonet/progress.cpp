#include "tools/rheonet/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "tools/rheonet/say.hpp"
#include "tools/rheonet/summary.hpp"

namespace rheonet::tool {
namespace {

constexpr std::chrono::milliseconds patience{500};  // Shorter runs show no bar.
constexpr std::chrono::milliseconds interval{100};  // Time between updates.
constexpr int width = 40;                           // characters

}  // namespace

Progress::Progress(bool wanted) : wanted_(wanted && ::isatty(STDERR_FILENO) != 0), next_(start_ + patience) {}

Progress::~Progress() { erase(); }

void Progress::update(double fraction) {
  if (!wanted_) return;
  const Clock::time_point now = Clock::now();
  if (now < next_) return;
  next_ = now + interval;
  shown_ = true;

  fraction = std::clamp(fraction, 0.0, 1.0);
  const int filled = static_cast<int>(fraction * width);
  const double spent = std::chrono::duration<double>(now - start_).count();
  const std::string left = fraction > 0 ? in_time_units(spent / fraction - spent) + " left" : "";
  // Return to the start of the line, print, and clear the rest of the line.
  say("\r[{:#<{}}{:-<{}}] {:3.0f} %  {}\x1b[K", "", filled, "", width - filled, 100 * fraction, left);
}

void Progress::erase() {
  if (shown_) say("\r\x1b[K");
  shown_ = false;
}

}  // namespace rheonet::tool
