"""A complete list of engines."""

from __future__ import annotations

import math
from typing import Any

from yade import wrapper
from yadefrag.arguments import flag, number, numbersOf, refuse
from yadefrag.hints import ArrayLike, FESolver


def engines(fe: FESolver, gravity: ArrayLike | None = None, spheres: bool = False, damping: float = 0.,
            collider: type | None = None, moving: bool = False) -> list[Any]:
    """List of engines for O.engines, in the correct order.

    fe        an FESolver
    gravity   m/s², for the FE bodies and spheres: a pair, or three numbers with z = 0; None: that of
              fe.gravity
    spheres   False: no YADE spheres; the engines are [ForceResetter, fe], since FESolver searches
              by itself. True: also a collider, an InteractionLoop with Cundall and Strack's law among
              spheres and between spheres and bodies, and NewtonIntegrator
    moving    without spheres: True if YADE's walls, boxes or facets move; adds NewtonIntegrator after
              fe, which moves them
    damping   of NewtonIntegrator; acts on YADE's bodies only
    collider  a collider class for spheres=True; None: LebesgueCollider
    Add other engines at the end: O.engines = engines(fe) + [PyRunner(...)]. ValueError before any
    change.
    """
    if not isinstance(fe, wrapper.FESolver):
        refuse('fe', fe, 'an FESolver')
    spheres, moving = flag('spheres', spheres), flag('moving', moving)
    finder = wrapper.LebesgueCollider if collider is None else collider
    if not isinstance(finder, type) or not issubclass(finder, wrapper.Collider):
        refuse('collider', collider, 'a class of colliders, or None')
    damping = number('damping', damping, lambda v: math.isfinite(v) and v >= 0, '0 or positive')
    integrator = wrapper.NewtonIntegrator(damping=damping)
    if gravity is not None:
        fe.gravity = _inPlane(gravity)
    integrator.gravity = fe.gravity
    if not spheres:
        return [wrapper.ForceResetter(), fe] + [integrator] * moving
    return [
        wrapper.ForceResetter(),
        finder([wrapper.Bo1_Sphere_Aabb(), wrapper.Bo1_SurfaceSegment_Aabb()]),
        wrapper.InteractionLoop(
            [wrapper.Ig2_Sphere_Sphere_ScGeom(), wrapper.Ig2_Sphere_SurfaceSegment_ScGeom()],
            [wrapper.Ip2_FrictMat_FrictMat_FrictPhys()],
            [wrapper.Law2_ScGeom_FrictPhys_CundallStrack()]),
        fe, integrator]


def _inPlane(gravity):
    found = numbersOf(gravity, 2) or numbersOf(gravity, 3)
    if found is None:
        refuse('gravity', gravity, 'a pair of numbers (m/s²), or None')
    return found
