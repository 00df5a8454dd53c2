// The part of GCC's OpenMP runtime that lib/ uses, on std::thread and std::barrier. The thread
// sanitizer recognises these; the waiting inside libgomp it reports as races.

#include <barrier>
#include <thread>
#include <vector>

namespace {

thread_local int number = 0;
thread_local int count = 1;
thread_local std::barrier<>* team = nullptr;

}  // namespace

extern "C" {

int omp_get_thread_num() { return number; }
int omp_get_num_threads() { return count; }
int omp_get_max_threads() { return 4; }

void GOMP_barrier() {
  if (team) team->arrive_and_wait();
}

void GOMP_parallel(void (*work)(void*), void* data, unsigned threads, unsigned /*flags*/) {
  const int all = threads == 0 ? omp_get_max_threads() : static_cast<int>(threads);
  std::barrier together(all);
  const auto runAs = [&](int own) {
    number = own, count = all, team = &together;
    work(data);
    number = 0, count = 1, team = nullptr;
  };
  std::vector<std::thread> others;
  for (int own = 1; own < all; ++own) others.emplace_back(runAs, own);
  runAs(0);
  for (std::thread& other : others) other.join();
}

}  // extern "C"
