#pragma once
// Objects of YADE in blocks of memory, one behind the other.
//
// YADE allocates each object by itself. Neighbours in a loop over bodies or contacts are then far
// apart in memory, and most of the loop's time is spent on waiting for it; a processor reads ahead
// only where data follow each other. Objects are moved together into blocks:
//
//   block, 2 MB:  | number of objects in use | object | object | ...
//                                            ^ at the begin of a cache line
//
// Their owners keep them by shared pointers as ever. A block is freed with its last object. The
// space of an object that ended before is not used again: all objects are moved anew when enough of
// them are scattered.

#include <malloc.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <new>
#include <typeinfo>

#include "yade/yade.hpp"

namespace yadefrag {

class Block {
 public:
  static constexpr std::size_t kBytes = std::size_t{1} << 21;  // a huge page of the processor
  static constexpr std::size_t kLine = 64;                     // a cache line

  /// Counts its filler as an object in use. Throws std::bad_alloc.
  static Block* make();
  /// Bytes of the cache lines that so many bytes need.
  static constexpr std::size_t wholeLines(std::size_t bytes) {
    return (bytes + kLine - 1) / kLine * kLine;
  }
  static Block* of(const void* object) {
    return reinterpret_cast<Block*>(reinterpret_cast<std::uintptr_t>(object) & ~(kBytes - 1));
  }
  void hold() { ++used_; }
  void release();

 private:
  std::atomic<std::size_t> used_{1};
};

/// Makes objects in blocks.
class BlockFiller {
 public:
  BlockFiller() = default;
  BlockFiller(const BlockFiller&) = delete;
  BlockFiller& operator=(const BlockFiller&) = delete;
  ~BlockFiller() {
    if (block_) block_->release();
  }

  /// The next objects, of `bytes` together, are in one block, from a cache line on.
  void begin(std::size_t bytes);
  /// The next object is so many bytes behind the begin.
  void goTo(std::size_t bytes) { offset_ = begin_ + bytes; }
  template <class Object>
  yade::shared_ptr<Object> make() {
    auto* const object = new (reinterpret_cast<char*>(block_) + offset_) Object;
    offset_ += sizeof(Object);
    block_->hold();
    return {object, [](Object* ended) {
              Block* const block = Block::of(ended);
              ended->~Object();
              block->release();
            }};
  }

 private:
  Block* block_ = nullptr;
  std::size_t begin_ = 0;   // of the objects together
  std::size_t end_ = 0;     // of them
  std::size_t offset_ = 0;  // of the next one
};

/// True: a script uses Python's object of `owner`, which has made a C++ object of `type`: it refers
/// to it, has given it attributes, or a class of its own. Needs Python's lock.
bool isUsedByScript(PyObject* owner, yade::py::type_info type);

/// True: the object is of this very class, and nothing but `pointer` refers to it. Needs Python's
/// lock.
template <class Object, class Base>
bool isMovable(const yade::shared_ptr<Base>& pointer) {
  if (!pointer || pointer.use_count() != 1) return false;
  const Base& object = *pointer;
  if (typeid(object) != typeid(Object)) return false;
  // A pointer from Python has a count of its own.
  using FromPython = yade::py::converter::shared_ptr_deleter;
  const auto* const python = boost::get_deleter<FromPython>(pointer);
  return python == nullptr || !isUsedByScript(python->owner.get(), yade::py::type_id<Object>());
}

/// Replaces a movable object by another one in a block; `copy(from, to)`.
template <class Object, class Base, class Copy>
void moveInto(BlockFiller& filler, yade::shared_ptr<Base>& pointer, const Copy& copy) {
  const auto moved = filler.make<Object>();
  copy(static_cast<Object&>(*pointer), *moved);
  pointer = moved;
}

/// The space of moved objects, to the system: the next move needs as much again.
inline void returnFreed() { malloc_trim(0); }

/// Determines when objects that a loop visits are moved together.
class ScatterWatch {
 public:
  /// Ends a step. `visitAll(visit)` calls `visit` with the address of each object, in the order of
  /// the loop; it is called every 32 steps, more seldom where objects scatter soon or cannot be
  /// moved. True: they are `apart` bytes or more from each other, and should be moved together.
  template <class VisitAll>
  bool endStep(std::uintptr_t apart, const VisitAll& visitAll) {
    if (++age_ < wait_) return false;
    std::uintptr_t last = 0;
    std::size_t visited = 0, scattered = 0;
    visitAll([&](const void* object) {
      const auto address = reinterpret_cast<std::uintptr_t>(object);
      scattered += address - last - 1 >= apart;
      last = address;
      ++visited;
    });
    return isEnough(visited, scattered);
  }

 private:
  static constexpr long kShortestWait = 32;  // steps: a move costs about as much as two

  bool isEnough(std::size_t visited, std::size_t scattered);

  long age_ = 0;  // steps since the objects were visited
  long wait_ = kShortestWait;
};

/// Excludes Python's threads and the 3D view, which may copy pointers, while objects are moved.
class OthersWait {
 public:
  explicit OthersWait(yade::Scene& scene);
  ~OthersWait();
  OthersWait(const OthersWait&) = delete;
  OthersWait& operator=(const OthersWait&) = delete;

 private:
  // Python's lock first: its threads hold it while they wait for the others.
  PyGILState_STATE python_;
  std::unique_lock<std::mutex> bodies_, interactions_;
};

/// Moves bodies, and their states and bounds of YADE's classes State and Aabb, together, in the
/// order of the bodies, when they are scattered. Objects that anything else than the scene or the
/// body refers to stay where they are.
class BodyMemory {
 public:
  void endStep(yade::Scene& scene);

 private:
  ScatterWatch states_;
};

/// Moves geometry and physics of each contact of YADE's classes `Geom` and `Phys`, those of a law
/// of the loop, together, in the order of the scene's contacts, when they are scattered. Objects
/// that anything else than the contact refers to (a variable in Python) stay where they are.
class ContactMemory {
 public:
  template <class Geom, class Phys>
  void endStep(yade::Scene& scene);

 private:
  ScatterWatch geometries_;
};

}  // namespace yadefrag
