#include "yade/step_lock.hpp"

#include "yade/gil.hpp"

namespace yadefrag {

void StepLock::lock() {
  if (try_lock()) return;
  const WithoutGil free;
  std::unique_lock guard(mutex_);
  turn_.wait(guard, [&, ticket = given_++] { return ticket == served_; });
  owner_ = std::this_thread::get_id(), depth_ = 1;
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

void StepLock::unlock() {
  const std::lock_guard guard(mutex_);
  if (--depth_ > 0) return;
  owner_ = {};
  if (++served_ < given_) turn_.notify_all();
}

}  // namespace yadefrag
