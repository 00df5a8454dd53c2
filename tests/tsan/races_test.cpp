// Run by the thread sanitizer (scripts/check tsan), which ends it with an error where two threads
// touch the same data: all that lib/ does on several threads.

#include <gtest/gtest.h>

#include <array>
#include <barrier>
#include <cmath>
#include <new>
#include <numbers>
#include <random>
#include <thread>
#include <vector>

#include "core/checks.hpp"
#include "search/contact_search.hpp"
#include "step/bodies.hpp"

namespace yadefrag::test {
namespace {

constexpr int kThreads = 3;

/// A disc that strikes a brittle block; both passes, friction, viscosity, a held side.
World impact(int threads) {
  World world;
  world.threads = threads;
  world.contactSettings.passes = 2;
  world.dynamicsSettings.viscosity = {.06, 1.2};
  world.dynamicsSettings.damping = 10;
  const TriangleMesh block = structuredRectangle({0, 0}, {.04, .03}, 20, 15);
  BodySpec spec;
  spec.material = {30e9, .2, 2500, true};
  spec.brittle = {.tensileStrength = 20e6, .fractureEnergy = 50};
  spec.friction = .2;
  for (const Vec2 node : block.nodes) spec.held.push_back(node.y < 1e-9 ? kHeldX | kHeldY : kFree);
  world.addBody(block, spec);
  const TriangleMesh round = triangulate({circle({.0213, .0352}, .005, 32), {}}, .002);
  world.addBody(round, moving(round, steel(), {0, -20}));
  return world;
}

TEST(Races, NoneInABodyThatCracks) {
  const ThreadsForFew few;
  World one = impact(1), many = impact(kThreads);
  const double dt = .3 * one.criticalTimeStep();
  for (int i = 0; i < 500; ++i) one.step(dt), many.step(dt);
  EXPECT_GT(many.fracture.numCracks(), 10U);
  EXPECT_TRUE(sameBits(one.model.nodes.position, many.model.nodes.position));
}

TEST(Races, NoneInSearches) {
  const ThreadsForFew few;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(0, 1);
  std::vector<Box> boxes(2000);
  for (const SearchMethod method :
       {SearchMethod::kLebesgue, SearchMethod::kLinearCode, SearchMethod::kHierarchy}) {
    const auto search = makeSearch(method);
    search->setThreads(kThreads);
    for (int round = 0; round < 5; ++round) {
      for (Box& box : boxes) {
        const std::array<double, 3> low{any(random), any(random), any(random)};
        box = {low, {low[0] + .05, low[1] + .05, low[2] + .05}};
      }
      search->update(boxes);
      std::vector<BoxPair> pairs;
      search->findPairs(pairs);
      EXPECT_GT(pairs.size(), 100U);
    }
  }
}

TEST(Races, NoneWhereAThreadFails) {
  const ThreadsForFew few;
  for (int round = 0; round < 20; ++round)
    EXPECT_THROW(
        forEachPart(1000, kThreads, [](std::size_t, std::size_t, int) { throw std::bad_alloc(); }),
        std::bad_alloc);
}

}  // namespace
}  // namespace yadefrag::test

// The part of GCC's OpenMP runtime that lib/ uses, on std::thread and std::barrier. The thread
// sanitizer recognises these; the waiting inside libgomp it reports as races.
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
