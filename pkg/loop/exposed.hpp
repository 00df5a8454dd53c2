#pragma once
// Private members of YADE's classes that the loop reads and changes. An explicit instantiation may
// name them. The other way, YADE's functions, costs a call for each contact. Included by one
// source.

#include "abi/yade.hpp"

namespace yadefrag {

template <class Tag, auto member>
struct Expose {
  friend constexpr auto exposed(Tag) { return member; }
};

struct TwistAxis {
  friend constexpr auto exposed(TwistAxis);
};
template struct Expose<TwistAxis, &yade::ScGeom::twist_axis>;

struct OrthonormalAxis {
  friend constexpr auto exposed(OrthonormalAxis);
};
template struct Expose<OrthonormalAxis, &yade::ScGeom::orthonormal_axis>;

struct GradientTimesCell {
  friend constexpr auto exposed(GradientTimesCell);
};
template struct Expose<GradientTimesCell, &yade::Cell::_vGradTimesPrevH>;

struct ForceData {
  friend constexpr auto exposed(ForceData);
};
template struct Expose<ForceData, &yade::ForceContainer::_forceData>;

struct TorqueData {
  friend constexpr auto exposed(TorqueData);
};
template struct Expose<TorqueData, &yade::ForceContainer::_torqueData>;

}  // namespace yadefrag
