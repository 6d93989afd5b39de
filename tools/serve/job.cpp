#include "tools/serve/job.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace rheonet::serve {

using namespace std::chrono_literals;
using Clock = Pool::Clock;

namespace {

constexpr std::size_t longest_answer = 64u << 20;  // of an answer
constexpr auto tick = 20ms;                    // after which a cancelled task is noticed
constexpr int most_tries = 20;                 // for a worker that takes the task
constexpr double longer_aside = 3;             // times as long may it take on what others leave

}  // namespace

Job::Job(Pool& pool, std::string task) : pool_(pool), task_(std::move(task)), thread_([this] { run(); }) {}

Job::~Job() {
  cancel();
  thread_.join();
}

std::string Job::take(std::chrono::milliseconds patience, bool& finished) {
  std::unique_lock lock(mutex_);
  more_.wait_for(lock, patience, [this] { return !text_.empty() || finished_; });
  finished = finished_;
  return std::exchange(text_, {});
}

void Job::run() {
  if (std::unique_ptr<Worker> worker = begin()) {
    const bool sound = follow(*worker);
    pool_.release(std::move(worker), sound);
  }
  const std::lock_guard lock(mutex_);
  finished_ = true;
  more_.notify_all();
}

std::unique_ptr<Worker> Job::begin() {
  const auto patience = std::chrono::milliseconds(static_cast<long>(2000 * pool_.limits().seconds));
  // One that has ended while it had nothing to do is replaced.
  for (int k = 0; k < most_tries; ++k) {
    std::unique_ptr<Worker> worker = pool_.acquire(patience, [this] { return cancelled_.load(); });
    if (!worker) {
      if (!cancelled_) fail("too many others are simulating; try again");
      return nullptr;
    }
    if (worker->give(task_)) return worker;
    pool_.release(std::move(worker), false);
  }
  fail("the processes that simulate end before they begin");
  return nullptr;
}

bool Job::follow(Worker& worker) {
  const auto began = Clock::now();
  for (;;) {
    std::string message;
    switch (worker.take(message, tick)) {
      case Worker::Answer::end:
        return true;
      case Worker::Answer::message:
        if (const std::size_t bytes = told_ + message.size(); bytes > longest_answer) {
          fail(fmt::format("the result comes to {} MB so far, and a page may have {} MB: record fewer quantities, or at fewer output "
                           "times; `rheonet run` has no such limit", bytes >> 20U, longest_answer >> 20U));
          return false;
        }
        tell(message);
        break;
      case Worker::Answer::gone: {
        const Worker::Ending ending = worker.ending();
        fail(ending.of_memory ? fmt::format("the run needs more than the {} MB of memory that it may have here; `rheonet run` has no "
                                            "such limit", pool_.limits().megabytes)
                              : fmt::format("the process that simulated this was ended by {}", ending.words));
        return false;
      }
      case Worker::Answer::nothing:
        break;
    }
    if (cancelled_ || is_too_much(worker, began)) return false;
  }
}

bool Job::is_too_much(Worker& worker, Clock::time_point began) {
  const double seconds = std::chrono::duration<double>(Clock::now() - began).count();
  if (seconds > pool_.limits().seconds * (worker.is_aside() ? longer_aside : 1)) {
    fail(fmt::format("the run takes longer than the {:g} s that it may take here; `rheonet run` has no such limit",
                     pool_.limits().seconds));
    return true;
  }
  if (!worker.is_aside() && pool_.is_in_the_way(began) && !pool_.step_aside(worker)) {
    fail(fmt::format("too many others are simulating for a run that takes longer than {:.1g} s; try again", seconds));
    return true;
  }
  return false;
}

void Job::tell(const std::string& message) {
  const std::lock_guard lock(mutex_);
  text_ += message;
  text_ += '\n';
  told_ += message.size() + 1;
  more_.notify_all();
}

void Job::fail(const std::string& why) { tell(nlohmann::json{{"kind", "failed"}, {"message", why}, {"limit", true}}.dump()); }

}  // namespace rheonet::serve
