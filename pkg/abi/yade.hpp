#pragma once
// YADE as this project sees it: the one include of everything in pkg/ that touches YADE.
// Names, namespace, members and access are YADE's own, so this file may be replaced by one that
// includes YADE's real headers (pkg/README.md says how).

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
#include "abi/material.hpp"
#include "abi/newton.hpp"
#include "abi/renderer.hpp"
#include "abi/scene.hpp"
#include "abi/shape.hpp"
#include "abi/state.hpp"
