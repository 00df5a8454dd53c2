#include <algorithm>
#include <cstdlib>
#include <new>

#include "core/checks.hpp"

namespace {

thread_local bool counting = false;
thread_local std::size_t left = 0;

void* allocate(std::size_t size, std::size_t alignment) {
  if (counting && left-- == 0) {
    counting = false;
    throw std::bad_alloc();
  }
  size = (std::max(size, std::size_t{1}) + alignment - 1) / alignment * alignment;
  void* memory = std::aligned_alloc(alignment, size);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

}  // namespace

void* operator new(std::size_t size) { return allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
// Never fails: its callers go on without it. Its memory is freed by the functions below,
// which must match (sanitizers look).
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return std::malloc(std::max(size, std::size_t{1}));
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace yadefrag::test {

FailingMemory::FailingMemory(std::size_t count) {
  left = count;
  counting = true;
}
FailingMemory::~FailingMemory() { counting = false; }

}  // namespace yadefrag::test
