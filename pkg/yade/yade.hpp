#pragma once
// YADE's declarations for this project: the one include for all files in pkg/ that use YADE. Names,
// namespace, members and access are those of YADE, so that its own headers can replace those here:
// they do for a yade that was built from its sources, whose layouts follow that build's features. A
// package has no headers.

#ifdef YADEFRAG_YADE_SOURCE

#include <boost/python.hpp>

#include <lib/factory/ClassFactory.hpp>
#include <lib/serialization/Serializable.hpp>

// YADE registers each class in each file that includes its header. YADE's libraries have done that;
// here it would register them a second time, and the compiler would take five times as long.
#undef REGISTER_FACTORABLE
#define REGISTER_FACTORABLE(name)
#undef REGISTER_SERIALIZABLE
#define REGISTER_SERIALIZABLE(name)

#include <core/Aabb.hpp>
#include <core/Body.hpp>
#include <core/BodyContainer.hpp>
#include <core/Bound.hpp>
#include <core/Cell.hpp>
#include <core/Clump.hpp>
#include <core/Dispatcher.hpp>
#include <core/Dispatching.hpp>
#include <core/EnergyTracker.hpp>
#include <core/Engine.hpp>
#include <core/ForceContainer.hpp>
#include <core/Functor.hpp>
#include <core/GlobalEngine.hpp>
#include <core/IGeom.hpp>
#include <core/IPhys.hpp>
#include <core/Interaction.hpp>
#include <core/InteractionContainer.hpp>
#include <core/InteractionLoop.hpp>
#include <core/Material.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>
#include <core/Shape.hpp>
#include <core/State.hpp>
#include <lib/base/Math.hpp>
#include <pkg/common/Bo1_Aabb.hpp>
#include <pkg/common/Box.hpp>
#include <pkg/common/Collider.hpp>
#include <pkg/common/ElastMat.hpp>
#include <pkg/common/Facet.hpp>
#include <pkg/common/NormShearPhys.hpp>
#include <pkg/common/Sphere.hpp>
#include <pkg/common/Wall.hpp>
#include <pkg/dem/CohesiveFrictionalContactLaw.hpp>
#include <pkg/dem/ElasticContactLaw.hpp>
#include <pkg/dem/FrictPhys.hpp>
#include <pkg/dem/HertzMindlin.hpp>
#include <pkg/dem/Ig2_Box_Sphere_ScGeom.hpp>
#include <pkg/dem/Ig2_Facet_Sphere_ScGeom.hpp>
#include <pkg/dem/Ig2_Sphere_Sphere_ScGeom.hpp>
#include <pkg/dem/NewtonIntegrator.hpp>
#include <pkg/dem/ScGeom.hpp>
#include <pkg/dem/ViscoelasticPM.hpp>
#ifdef YADE_OPENGL
#include <pkg/common/OpenGLRenderer.hpp>
#endif

namespace yade {
namespace py = boost::python;
}

#else
#include "yade/dispatcher.hpp"
#include "yade/scene.hpp"
#endif
