#include "loop/block_memory.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>

namespace yadefrag {

namespace {

// Fewer objects fit into the processor's cache.
constexpr std::size_t kFewest = 2048;
// Share of scattered objects from which a loop is slower by more than the move costs.
constexpr std::size_t kScatteredShare = 8;  // 1 of 8
constexpr long kLongestWait = 1024;         // steps

}  // namespace

Block* Block::make() {
  void* const bytes = std::aligned_alloc(kBytes, kBytes);
  if (bytes == nullptr) throw std::bad_alloc();
  madvise(bytes, kBytes, MADV_HUGEPAGE);  // a request: pages of the usual size are as good
  return new (bytes) Block;
}

void Block::release() {
  if (used_.fetch_sub(1) == 1) std::free(this);
}

void BlockFiller::begin(std::size_t bytes) {
  begin_ = Block::wholeLines(end_);
  if (!block_ || begin_ + bytes > Block::kBytes) {
    if (block_) block_->release();
    block_ = nullptr;
    block_ = Block::make();
    begin_ = Block::kLine;
  }
  offset_ = begin_;
  end_ = begin_ + bytes;
}

bool ScatterWatch::isEnough(std::size_t visited, std::size_t scattered) {
  age_ = 0;
  const bool isEnough = visited >= kFewest && scattered * kScatteredShare > visited;
  wait_ = isEnough ? std::min(2 * wait_, kLongestWait) : kShortestWait;
  return isEnough;
}

bool isUsedByScript(PyObject* owner, yade::py::type_info type) {
  if (Py_REFCNT(owner) != 1) return true;
  const auto* const yades = yade::py::converter::registry::query(type);
  if (yades == nullptr || Py_TYPE(owner) != yades->m_class_object) return true;
  PyObject* const* const attributes = _PyObject_GetDictPtr(owner);
  if (attributes && *attributes && PyDict_Size(*attributes) > 0) return true;
  return PyType_SUPPORTS_WEAKREFS(Py_TYPE(owner)) && *PyObject_GET_WEAKREFS_LISTPTR(owner);
}

OthersWait::OthersWait(yade::Scene& scene)
    : python_(PyGILState_Ensure()),
      // In the order of the 3D view.
      bodies_(scene.bodies->drawloopmutex),
      interactions_(scene.interactions->drawloopmutex) {}

OthersWait::~OthersWait() {
  interactions_.unlock(), bodies_.unlock();
  PyGILState_Release(python_);
}

}  // namespace yadefrag
