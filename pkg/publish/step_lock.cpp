#include "publish/step_lock.hpp"

#include "script/without_gil.hpp"

namespace yadefrag {

void StepLock::lock() {
  const std::thread::id self = std::this_thread::get_id();
  std::uint64_t ticket = 0;
  {
    const std::lock_guard guard(mutex_);
    if (owner_ == self) {
      ++depth_;
      return;
    }
    ticket = given_++;
    if (ticket == served_) {
      owner_ = self, depth_ = 1;
      return;
    }
  }
  const WithoutGil free;
  wait(ticket);
}

bool StepLock::try_lock() {
  const std::thread::id self = std::this_thread::get_id();
  const std::lock_guard guard(mutex_);
  if (owner_ == self) {
    ++depth_;
    return true;
  }
  if (given_ != served_) return false;
  ++given_;
  owner_ = self, depth_ = 1;
  return true;
}

void StepLock::wait(std::uint64_t ticket) {
  std::unique_lock guard(mutex_);
  turn_.wait(guard, [&] { return ticket == served_; });
  owner_ = std::this_thread::get_id(), depth_ = 1;
}

void StepLock::unlock() {
  const std::lock_guard guard(mutex_);
  if (--depth_ > 0) return;
  owner_ = {};
  if (++served_ < given_) turn_.notify_all();
}

}  // namespace yadefrag
