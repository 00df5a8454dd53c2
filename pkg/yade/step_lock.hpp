#pragma once
// A lock between the steps of an engine and other threads that read or change its data.

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace yadefrag {

/// A recursive lock that serves threads in the order of their requests: with a plain mutex the
/// thread that runs the steps would have it nearly all the time. A waiting thread releases Python's
/// lock (the GIL), which the thread that has this lock may need.
class StepLock {
 public:
  void lock();
  void unlock();
  /// Returns false if another thread has the lock; for threads that must not wait.
  bool try_lock();

 private:
  std::mutex mutex_;  // protects the following members
  std::condition_variable turn_;
  std::uint64_t given_ = 0;   // tickets so far
  std::uint64_t served_ = 0;  // the ticket that is served
  std::thread::id owner_;
  int depth_ = 0;  // number of locks of the owner
};

}  // namespace yadefrag
