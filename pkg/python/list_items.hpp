#pragma once
// Lists that Python hands to YADE.

#include <cstddef>

namespace yadefrag {

/// YADE's conversion of a list to a std::vector of shared pointers never releases the references
/// that it took to the items (2023.02a, custom_vector_from_seq: PySequence_GetItem). So no engine,
/// functor or body that was ever in such a list is freed, and nothing that it holds. From this call
/// on these references are known. Does nothing where YADE releases them itself.
void watchListItems();

/// Frees the items to which no other reference is left; returns how many. To be called with
/// Python's lock and between two steps. Rejected: to release them at once. Then the last reference
/// may go in the simulation's thread, which frees a Python object without the lock.
std::size_t freeListItems();

}  // namespace yadefrag
