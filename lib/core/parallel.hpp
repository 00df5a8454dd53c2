#pragma once
// Threads in lib/ are used in this way only: a range is cut into contiguous parts, one per thread.
// Each part appends to its own list, and the lists are joined in the order of the range. Or the
// threads take items, each of which changes data of its own only. The result and its order are the
// same for any number of threads.

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

/// Number of threads for `count` items.
inline int threadsFor(std::size_t count, int threads) {
  return std::max(1, std::min(threads, static_cast<int>(count / leastItemsPerThread())));
}

/// Calls `work(begin, end, part)` for contiguous parts of [0, count) and returns the number of
/// parts. An exception of `work` reaches the caller after all parts have ended.
template <class Work>
int forEachPart(std::size_t count, int threads, Work work) {
  const int parts = threadsFor(count, threads);
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

/// Fills `list` by `work(begin, end, list)` for contiguous parts of [0, count), in their order.
/// `parts`: memory from call to call.
template <class T, class Work>
void listInParts(std::size_t count, int threads, std::vector<PartList<T>>& parts,
                 std::vector<T>& list, Work work) {
  list.clear();
  const int most = threadsFor(count, threads);
  if (most == 1) return work(std::size_t{0}, count, list);
  parts.resize(static_cast<std::size_t>(most));
  forEachPart(count, threads, [&](std::size_t begin, std::size_t end, int part) {
    PartList<T>& found = parts[static_cast<std::size_t>(part)];
    found.clear();
    work(begin, end, found);
  });
  for (const auto& part : parts) list.insert(list.end(), part.begin(), part.end());
}

/// Calls `work(item)` for each of `count` items that do not depend on each other and are of
/// different size, with `pieces` pieces of work in all; a thread takes `atOnce` items. An exception
/// as above.
template <class Work>
void forEachItem(std::size_t count, std::size_t pieces, int threads, Work work,
                 int atOnce = tolerance::kItemsAtOnce) {
  const int parts = threadsFor(pieces, threads);
  if (parts == 1) {
    for (std::size_t item = 0; item < count; ++item) work(item);
    return;
  }
  PartErrors errors;
#pragma omp parallel for schedule(dynamic, atOnce) num_threads(parts)
  for (std::size_t item = 0; item < count; ++item)
    errors.run(static_cast<int>(item), [&] { work(item); });
  errors.rethrow();
}

}  // namespace yadefrag
