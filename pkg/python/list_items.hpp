#pragma once
// Lists that Python hands to YADE.

namespace yadefrag {

/// YADE's conversion of a list to a std::vector of shared pointers never releases the references
/// that it took to the items (2023.02a, custom_vector_from_seq: PySequence_GetItem). So no engine,
/// functor or body that was ever in such a list is freed, and nothing that it holds. From this call
/// on they are released. Does nothing where YADE releases them itself.
void releaseListItems();

}  // namespace yadefrag
