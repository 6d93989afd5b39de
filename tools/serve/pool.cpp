#include "tools/serve/pool.hpp"

#include <algorithm>
#include <system_error>

namespace rheonet::serve {

using namespace std::chrono_literals;

namespace {

constexpr double longest_turn = 0.5, shortest_turn = 0.05;  // CPU time of a run while others wait for its place [s].
constexpr double all_turns = 1;                             // CPU time of all waiting tasks together, approximately [s].
constexpr std::size_t most_aside = 8;                       // For each place; runs that stepped aside need memory.

}  // namespace

bool AnswerMemory::change(std::size_t& held, std::size_t wanted) {
  const std::lock_guard lock(mutex_);
  if (wanted > held && wanted - held > most - used_) return false;
  used_ = used_ - held + wanted;
  held = wanted;
  return true;
}

Pool::Pool(const Limits& limits, std::size_t places, int folder) : limits_(limits), folder_(folder), places_(places) {
  // Started in advance, because starting a process takes longer than running a small scene.
  for (std::size_t k = 0; k < places; ++k) idle_.push_back(std::make_unique<Worker>(limits_, folder_));
}

std::unique_ptr<Worker> Pool::acquire(std::chrono::milliseconds patience, const std::function<bool()>& cancelled) {
  const auto until = Clock::now() + patience;
  {
    std::unique_lock lock(mutex_);
    const unsigned long number = ++last_;
    waiting_.push_back(number);
    while (running_ == places_ || waiting_.front() != number) {
      if (cancelled() || Clock::now() >= until) {
        std::erase(waiting_, number);
        changed_.notify_all();
        return nullptr;
      }
      changed_.wait_for(lock, 50ms);
    }
    waiting_.pop_front();
    ++running_;
    changed_.notify_all();
  }
  if (std::unique_ptr<Worker> worker = idle_or_new()) return worker;
  const std::lock_guard lock(mutex_);
  --running_;
  changed_.notify_all();
  return nullptr;
}

std::unique_ptr<Worker> Pool::idle_or_new() {
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      std::unique_ptr<Worker> worker = std::move(idle_.back());
      idle_.pop_back();
      return worker;
    }
  }
  try {
    return std::make_unique<Worker>(limits_, folder_);
  } catch (const std::system_error&) {
    return nullptr;
  }
}

bool Pool::is_in_the_way(double cpu_seconds) {
  const std::lock_guard lock(mutex_);
  if (waiting_.empty()) return false;
  return cpu_seconds > std::clamp(all_turns / static_cast<double>(waiting_.size()), shortest_turn, longest_turn);
}

bool Pool::step_aside(Worker& worker) {
  const std::lock_guard lock(mutex_);
  if (aside_ == most_aside * places_) return false;
  worker.step_aside();
  ++aside_;
  --running_;
  changed_.notify_all();
  return true;
}

void Pool::release(std::unique_ptr<Worker> worker, bool sound) {
  const bool was_aside = worker->is_aside();
  // A worker that stepped aside has the lowest priority for good, so it is replaced.
  if (!sound || was_aside) worker.reset();
  if (!was_aside && !worker) {
    try {
      worker = std::make_unique<Worker>(limits_, folder_);
    } catch (const std::system_error&) {  // The next task tries again.
    }
  }
  {
    const std::lock_guard lock(mutex_);
    if (worker && idle_.size() < places_) idle_.push_back(std::move(worker));
    --(was_aside ? aside_ : running_);
  }
  changed_.notify_all();
}

}  // namespace rheonet::serve
