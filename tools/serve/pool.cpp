#include "tools/serve/pool.hpp"

#include <system_error>

namespace rheonet::serve {

Pool::Pool(const Limits& limits, std::size_t size) : limits_(limits), size_(size) {
  // Ready beforehand: a process takes longer to start than a small scene to run.
  for (std::size_t k = 0; k < size; ++k) idle_.push_back(std::make_unique<Worker>(limits_));
}

std::unique_ptr<Worker> Pool::take_idle(std::unique_lock<std::mutex>& lock) {
  if (!idle_.empty()) {
    std::unique_ptr<Worker> worker = std::move(idle_.back());
    idle_.pop_back();
    return worker;
  }
  lock.unlock();
  try {
    return std::make_unique<Worker>(limits_);
  } catch (const std::system_error&) {
    lock.lock();
    --busy_;
    return nullptr;
  }
}

void Pool::release(std::unique_ptr<Worker> worker, bool sound) {
  if (!sound) {
    worker.reset();
    try {
      worker = std::make_unique<Worker>(limits_);
    } catch (const std::system_error&) {  // the next one that wants it tries again
    }
  }
  {
    const std::lock_guard lock(mutex_);
    if (worker) idle_.push_back(std::move(worker));
    --busy_;
  }
  freed_.notify_one();
}

}  // namespace rheonet::serve
