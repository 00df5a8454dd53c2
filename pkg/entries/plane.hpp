#pragma once
// Points of the plane as YADE's vectors in space, and back.

#include "abi/yade.hpp"
#include "core/vec2.hpp"

namespace yadefrag {

inline Vec2 inPlane(const yade::Vector3r& v) { return {v[0], v[1]}; }
inline yade::Vector3r inSpace(Vec2 v) { return {v.x, v.y, 0}; }

}  // namespace yadefrag
