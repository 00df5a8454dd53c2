#pragma once
// Keeps the steps of an engine and all that other threads read or change of it apart.

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace yadefrag {

/// A recursive lock that threads get in the order in which they ask: the thread that runs the steps
/// would hold a plain mutex nearly all the time. A thread that has to wait gives Python's lock (the
/// GIL) up meanwhile: the thread that it waits for may need it.
class StepLock {
 public:
  void lock();
  void unlock();
  /// False where another thread has it: for those who must not wait.
  bool try_lock();

 private:
  void wait(std::uint64_t ticket);

  std::mutex mutex_;  // of what follows
  std::condition_variable turn_;
  std::uint64_t given_ = 0;   // tickets so far
  std::uint64_t served_ = 0;  // the ticket whose turn it is
  std::thread::id owner_;
  int depth_ = 0;  // how often the owner has locked it
};

}  // namespace yadefrag
