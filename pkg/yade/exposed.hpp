#pragma once
// Private members of YADE's classes that the loop reads and changes. An explicit instantiation may
// name them. The other way, YADE's functions, costs a call for each contact. Included by one
// source.

#include "yade/yade.hpp"

namespace yadefrag {

template <class Tag, auto member>
struct Expose {
  friend constexpr auto exposed(Tag) { return member; }
};

#define YADEFRAG_EXPOSE(Tag, member)    \
  struct Tag {                          \
    friend constexpr auto exposed(Tag); \
  };                                    \
  template struct Expose<Tag, member>

YADEFRAG_EXPOSE(TwistAxis, &yade::ScGeom::twist_axis);
YADEFRAG_EXPOSE(OrthonormalAxis, &yade::ScGeom::orthonormal_axis);
YADEFRAG_EXPOSE(GradientTimesCell, &yade::Cell::_vGradTimesPrevH);
YADEFRAG_EXPOSE(ForceData, &yade::ForceContainer::_forceData);
YADEFRAG_EXPOSE(TorqueData, &yade::ForceContainer::_torqueData);

#undef YADEFRAG_EXPOSE

}  // namespace yadefrag
