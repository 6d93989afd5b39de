#include "tools/rheonet/both_sides.hpp"

#include <utility>

namespace rheonet::tool {

BothSides::BothSides(Row row, std::size_t most) : row_(std::move(row)), left_(most) {}

void BothSides::listen(RunSettings& settings) {
  settings.row = [this](double time, const std::vector<double>& values) { row(time, values); };
  settings.state = [this](double time, const std::vector<double>& values) { state(time, values); };
}

// A row at an event is its right limit. It may arrive before the state that reveals the event.
void BothSides::row(double time, const std::vector<double>& values) {
  if (state_ && state_->time == time && !std::exchange(told_, true)) tell(*state_);
  tell({time, values});
}

void BothSides::state(double time, const std::vector<double>& values) {
  if (state_ && state_->time == time && left_ > 0) {
    if (!std::exchange(told_, true)) {
      --left_;
      tell(*state_);
    }
    tell({time, values});
  } else {
    told_ = false;
  }
  state_ = {time, values};
}

void BothSides::tell(const Moment& moment) {
  if (last_ == moment) return;
  row_(moment.time, moment.values);
  last_ = moment;
}

}  // namespace rheonet::tool
