#pragma once
// Sections of YADE's walls, boxes and facets, for pictures.

#include "abi/yade.hpp"

namespace yadefrag {

/// Sections of all bodies of the present scene that intersect the plane z = 0: tuples (id, kind,
/// points), with kind 'outline', 'line' or 'wall' and points as in Section, pairs (m).
[[nodiscard]] yade::py::list sectionsOfScene();

}  // namespace yadefrag
