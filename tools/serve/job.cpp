#include "tools/serve/job.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace rheonet::serve {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

namespace {

constexpr std::size_t most_bytes = 64u << 20;  // of an answer
constexpr auto tick = 20ms;                    // after which a cancelled task is noticed

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
  const auto patience = std::chrono::milliseconds(static_cast<long>(2000 * pool_.limits().seconds));
  if (std::unique_ptr<Worker> worker = pool_.acquire(patience, [this] { return cancelled_.load(); })) {
    const bool sound = follow(*worker);
    pool_.release(std::move(worker), sound);
  } else if (!cancelled_) {
    fail("too many others are simulating; try again");
  }
  const std::lock_guard lock(mutex_);
  finished_ = true;
  more_.notify_all();
}

bool Job::follow(Worker& worker) {
  const auto until = Clock::now() + std::chrono::duration<double>(pool_.limits().seconds);
  if (!worker.give(task_)) {
    fail("the process that simulates has ended; try again");
    return false;
  }
  for (;;) {
    std::string message;
    switch (worker.take(message, tick)) {
      case Worker::Answer::end:
        return true;
      case Worker::Answer::message:
        tell(message);
        break;
      case Worker::Answer::gone:
        fail(fmt::format("the run needs more than the {} MB of memory that it may have here", pool_.limits().megabytes));
        return false;
      case Worker::Answer::nothing:
        break;
    }
    if (cancelled_) return false;
    if (Clock::now() > until) {
      fail(fmt::format("the run takes longer than the {:g} s that it may take here; `rheonet run` has no such limit",
                       pool_.limits().seconds));
      return false;
    }
    if (told_ > most_bytes) {
      fail("the run has too much to tell: record less");
      return false;
    }
  }
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
