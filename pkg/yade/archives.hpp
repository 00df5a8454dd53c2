#pragma once
// Archives to which YADE saves, and types whose archive code is in YADE's libraries: this project
// generates none for those, so that files stay compatible with YADE. A base class of a published
// class must be listed here.

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/archive/xml_iarchive.hpp>
#include <boost/archive/xml_oarchive.hpp>

#include "yade/yade.hpp"

#define YADEFRAG_YADE_ARCHIVES(T)                        \
  extern template class oserializer<xml_oarchive, T>;    \
  extern template class iserializer<xml_iarchive, T>;    \
  extern template class oserializer<binary_oarchive, T>; \
  extern template class iserializer<binary_iarchive, T>;

namespace boost::archive::detail {

YADEFRAG_YADE_ARCHIVES(yade::BoundFunctor)
YADEFRAG_YADE_ARCHIVES(yade::Collider)
YADEFRAG_YADE_ARCHIVES(yade::FrictMat)
#ifdef YADE_OPENGL
YADEFRAG_YADE_ARCHIVES(yade::GlShapeFunctor)
#endif
YADEFRAG_YADE_ARCHIVES(yade::GlobalEngine)
YADEFRAG_YADE_ARCHIVES(yade::IGeomFunctor)
YADEFRAG_YADE_ARCHIVES(yade::InteractionLoop)
YADEFRAG_YADE_ARCHIVES(yade::NewtonIntegrator)
YADEFRAG_YADE_ARCHIVES(yade::Shape)
YADEFRAG_YADE_ARCHIVES(yade::Vector3r)
YADEFRAG_YADE_ARCHIVES(yade::Matrix3r)

}  // namespace boost::archive::detail

#undef YADEFRAG_YADE_ARCHIVES
