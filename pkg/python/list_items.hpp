#pragma once
// Lists that are passed from Python to YADE.

#include <cstddef>

namespace yadefrag {

/// YADE's conversion of a list to a std::vector of shared pointers never releases its references to
/// the items (2023.02a, custom_vector_from_seq: PySequence_GetItem). Engines, functors and bodies
/// that were ever in such a list, and all objects that they own, are therefore never freed. After
/// this call these references are recorded. Does nothing if YADE releases them itself.
void watchListItems();

/// Frees the items without any other reference; returns their number. Must be called with Python's
/// lock and between two steps. Rejected: to release them at once; the last reference may then be
/// released in the simulation's thread, which frees a Python object without the lock.
std::size_t freeListItems();

}  // namespace yadefrag
