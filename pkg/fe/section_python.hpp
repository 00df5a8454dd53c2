#pragma once
// The sections of YADE's walls, boxes and facets, for pictures.

#include "abi/yade.hpp"

namespace yadefrag {

/// Of all bodies of the present scene that cut the plane z = 0: tuples (id, kind, points), with
/// kind 'outline', 'line' or 'wall' and points as those of Section, pairs (m).
[[nodiscard]] yade::py::list sectionsOfScene();

}  // namespace yadefrag
