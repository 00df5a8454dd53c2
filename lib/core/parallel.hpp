#pragma once
// Threads in lib/ are used in this way only: a range is cut into contiguous parts, one per thread.
// Each part appends to its own list, and the lists are joined in the order of the range. The result
// and its order are the same for any number of threads.

#include <omp.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>
#include <vector>

#include "core/tolerances/threads.hpp"

namespace yadefrag {

/// Carries exceptions out of a parallel region, which they must not leave by themselves: that would
/// end the process. `run` catches an exception inside the region; `rethrow` throws it again after
/// the region. Of several exceptions, that of the first part is thrown.
class PartErrors {
 public:
  template <class Work>
  void run(int part, const Work& work) noexcept {
    try {
      work();
    } catch (...) {
      const std::lock_guard guard(mutex_);
      if (part < part_) error_ = std::current_exception(), part_ = part;
    }
  }
  /// Call it after a barrier.
  [[nodiscard]] bool any() const { return error_ != nullptr; }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr error_;
  int part_ = std::numeric_limits<int>::max();
};

/// The list that one part fills. Several of them in an array share no cache lines: threads that
/// change data on one line wait for each other at every change. (Two lines, since processors fetch
/// them in pairs.)
template <class T>
struct alignas(tolerance::kThreadsApart) PartList : std::vector<T> {};

/// (count) Minimum number of items of a thread's part. Tests lower it so that small scenes use
/// several threads.
inline std::size_t& leastItemsPerThread() {
  static std::size_t items = tolerance::kMinItemsPerThread;
  return items;
}

/// Calls `work(begin, end, part)` for contiguous parts of [0, count) and returns the number of
/// parts. An exception of `work` reaches the caller after all parts have ended.
template <class Work>
int forEachPart(std::size_t count, int threads, Work work) {
  const int parts = std::max(1, std::min(threads, static_cast<int>(count / leastItemsPerThread())));
  if (parts == 1) {
    work(std::size_t{0}, count, 0);
    return 1;
  }
  PartErrors errors;
#pragma omp parallel for schedule(static, 1) num_threads(parts)
  for (int part = 0; part < parts; ++part)
    errors.run(part, [&] { work(count * part / parts, count * (part + 1) / parts, part); });
  errors.rethrow();
  return parts;
}

}  // namespace yadefrag
