#pragma once
// YADE's declarations for this project: the one include for all files in pkg/ that use YADE. Names,
// namespace, members and access are those of YADE, so that its own headers can replace those here:
// they do for a yade that was built from its sources.

#ifdef YADEFRAG_YADE_SOURCE
#include "abi/source_headers.hpp"
#else
#include "abi/body.hpp"
#include "abi/bound.hpp"
#include "abi/cell.hpp"
#include "abi/collider.hpp"
#include "abi/contact_geometry.hpp"
#include "abi/contact_physics.hpp"
#include "abi/dispatcher.hpp"
#include "abi/energy_tracker.hpp"
#include "abi/engine.hpp"
#include "abi/factory.hpp"
#include "abi/functor.hpp"
#include "abi/interaction.hpp"
#include "abi/interaction_loop.hpp"
#include "abi/material.hpp"
#include "abi/newton.hpp"
#include "abi/renderer.hpp"
#include "abi/scene.hpp"
#include "abi/shape.hpp"
#include "abi/state.hpp"
#endif
