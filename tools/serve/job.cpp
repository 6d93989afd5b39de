#include "tools/serve/job.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace rheonet::serve {

using namespace std::chrono_literals;
using Clock = Pool::Clock;

namespace {

constexpr std::size_t longest_answer = 64u << 20;  // Largest answer [bytes].
constexpr auto tick = 20ms;                    // Interval at which cancellation is checked.
constexpr int most_tries = 20;                 // Tries to find a worker that accepts the task.
constexpr double longest_wait = 20;            // Limit on wall time, as a multiple of the limit on CPU time.

}  // namespace

Job::Job(Pool& pool, std::string task) : pool_(pool), task_(std::move(task)), thread_([this] { run(); }) {}

Job::~Job() {
  cancel();
  thread_.join();
  pool_.answers().change(held_, 0);
}

std::string Job::take(std::chrono::milliseconds patience, bool& finished) {
  std::unique_lock lock(mutex_);
  more_.wait_for(lock, patience, [this] { return !text_.empty() || finished_; });
  finished = finished_;
  given_ = text_.size();
  std::string text = std::exchange(text_, {});
  pool_.answers().change(held_, given_ + begun_);  // The text taken last has been sent.
  return text;
}

bool Job::hold(std::size_t begun) {
  const std::lock_guard lock(mutex_);
  begun_ = begun;
  return pool_.answers().change(held_, text_.size() + given_ + begun_);
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
  // A worker that ended while it was idle is replaced.
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
  const double cpu_before = worker.cpu_seconds();
  for (;;) {
    std::string message;
    const Worker::Answer answer = worker.take(message, tick);
    if (const std::size_t bytes = told_ + message.size() + worker.begun(); bytes > longest_answer) {
      constexpr std::size_t megabyte = std::size_t{1} << 20U;
      fail(fmt::format("the result comes to {} MB so far, and a page may have {} MB: record fewer quantities, or at fewer output "
                       "times; `rheonet run` has no such limit", (bytes + megabyte - 1) / megabyte, longest_answer / megabyte));
      return false;
    }
    if (!hold(message.size() + worker.begun())) {
      fail("too many answers are waiting to be read; try again");
      return false;
    }
    switch (answer) {
      case Worker::Answer::end:
        return true;
      case Worker::Answer::message:
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
    if (cancelled_ || is_too_much(worker, began, cpu_before)) return false;
  }
}

bool Job::is_too_much(Worker& worker, Clock::time_point began, double cpu_before) {
  const double waited = std::chrono::duration<double>(Clock::now() - began).count();
  const double seconds = worker.cpu_seconds() - cpu_before;
  if (seconds > pool_.limits().seconds || waited > longest_wait * pool_.limits().seconds) {
    fail(fmt::format("the run takes longer than the {:g} s that it may take here; `rheonet run` has no such limit",
                     pool_.limits().seconds));
    return true;
  }
  if (!worker.is_aside() && pool_.is_in_the_way(seconds) && !pool_.step_aside(worker)) {
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
