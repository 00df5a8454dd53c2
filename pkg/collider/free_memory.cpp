#include "collider/search_collider.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "core/tolerances/collider.hpp"

namespace yadefrag {
namespace {

/// The number after `name` in a file of the system; infinite if there is none.
double numberIn(const char* path, const std::string& name) {
  std::ifstream file(path);
  std::string word;
  while (file >> word)
    if (double value = 0; word == name && file >> value) return value;
  return INFINITY;
}

/// The only number in a file; infinite if there is none ("max").
double numberIn(const char* path) {
  std::ifstream file(path);
  double value = 0;
  return file >> value ? value : INFINITY;
}

double leftInGroup() {
  const double used = numberIn("/sys/fs/cgroup/memory.current");
  return std::isfinite(used) ? numberIn("/sys/fs/cgroup/memory.max") - used : INFINITY;
}

double leftInAddressSpace() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return INFINITY;
  const double used = numberIn("/proc/self/statm") * static_cast<double>(sysconf(_SC_PAGESIZE));
  return static_cast<double>(limit.rlim_cur) - used;
}

}  // namespace

double freeMemory() {
  const double machine = 1024 * numberIn("/proc/meminfo", "MemAvailable:");
  return std::max(std::min({machine, leftInGroup(), leftInAddressSpace()}), 0.);
}

std::size_t MemoryForPairs::most(std::size_t bodies, std::size_t interactions) {
  if (bodies < tolerance::kFewBodies) return std::numeric_limits<std::size_t>::max();
  const bool grown =
      static_cast<double>(bodies) > tolerance::kMemoryLookUp * static_cast<double>(bodies_);
  if (grown || ++searches_ >= kSearchesPerLookUp) {
    free_ = freeMemory();
    interactions_ = interactions;
    bodies_ = bodies;
    searches_ = 0;
  }
  const double usual = tolerance::kUsualPairs * static_cast<double>(bodies);
  const double rest = free_ - tolerance::kPairBytes * usual;
  const double most = rest < 0 ? free_ / tolerance::kPairBytes
                               : usual + rest / (tolerance::kPairBytes + tolerance::kContactBytes);
  return most < 1e18 ? interactions_ + static_cast<std::size_t>(most)
                     : std::numeric_limits<std::size_t>::max();
}

}  // namespace yadefrag
