// This file compiles only if every declaration in pkg/abi has the layout of YADE's own class.

#include "abi/layout.hpp"

#include <cstddef>
#include <mutex>

#include "abi/yade.hpp"

// These classes have virtual functions. GCC lays them out as YADE's build did, and can measure
// their offsets.
#pragma GCC diagnostic ignored "-Winvalid-offsetof"

#define CHECK_SIZE(Type) static_assert(sizeof(Type) == yadefrag::layoutBytes(#Type, ""))
#define CHECK_MEMBER(Type, member) \
  static_assert(offsetof(Type, member) == yadefrag::layoutBytes(#Type, #member))

namespace yade {

CHECK_SIZE(Factorable);

CHECK_SIZE(Serializable);

CHECK_SIZE(Indexable);

CHECK_SIZE(TimingInfo);
CHECK_MEMBER(TimingInfo, nExec);
CHECK_MEMBER(TimingInfo, nsec);

CHECK_SIZE(Engine);
CHECK_MEMBER(Engine, scene);
CHECK_MEMBER(Engine, timingInfo);
CHECK_MEMBER(Engine, timingDeltas);
CHECK_MEMBER(Engine, dead);
CHECK_MEMBER(Engine, ompThreads);
CHECK_MEMBER(Engine, label);

CHECK_SIZE(GlobalEngine);

CHECK_SIZE(Dispatcher);

CHECK_SIZE(BoundDispatcher);
CHECK_MEMBER(BoundDispatcher, functors);
CHECK_MEMBER(BoundDispatcher, activated);
CHECK_MEMBER(BoundDispatcher, sweepDist);
CHECK_MEMBER(BoundDispatcher, minSweepDistFactor);
CHECK_MEMBER(BoundDispatcher, updatingDispFactor);
CHECK_MEMBER(BoundDispatcher, targetInterv);

CHECK_SIZE(Collider);
CHECK_MEMBER(Collider, boundDispatcher);
CHECK_MEMBER(Collider, avoidSelfInteractionMask);

CHECK_SIZE(FieldApplier);
CHECK_MEMBER(FieldApplier, fieldWorkIx);

CHECK_SIZE(NewtonIntegrator);
CHECK_MEMBER(NewtonIntegrator, densityScaling);
CHECK_MEMBER(NewtonIntegrator, updatingDispFactor);
CHECK_MEMBER(NewtonIntegrator, threadMaxVelocitySq);
CHECK_MEMBER(NewtonIntegrator, damping);
CHECK_MEMBER(NewtonIntegrator, gravity);
CHECK_MEMBER(NewtonIntegrator, maxVelocitySq);
CHECK_MEMBER(NewtonIntegrator, exactAsphericalRot);
CHECK_MEMBER(NewtonIntegrator, prevVelGrad);
CHECK_MEMBER(NewtonIntegrator, prevCellSize);
CHECK_MEMBER(NewtonIntegrator, warnNoForceReset);
CHECK_MEMBER(NewtonIntegrator, nonviscDampIx);
CHECK_MEMBER(NewtonIntegrator, kinSplit);
CHECK_MEMBER(NewtonIntegrator, dampGravity);
CHECK_MEMBER(NewtonIntegrator, kinEnergyIx);
CHECK_MEMBER(NewtonIntegrator, kinEnergyTransIx);
CHECK_MEMBER(NewtonIntegrator, kinEnergyRotIx);
CHECK_MEMBER(NewtonIntegrator, mask);

CHECK_SIZE(Functor);
CHECK_MEMBER(Functor, timingDeltas);
CHECK_MEMBER(Functor, scene);
CHECK_MEMBER(Functor, label);

CHECK_SIZE(BoundFunctor);

CHECK_SIZE(GlShapeFunctor);

CHECK_SIZE(IGeomFunctor);

CHECK_SIZE(IGeom);

CHECK_SIZE(GenericSpheresContact);
CHECK_MEMBER(GenericSpheresContact, normal);
CHECK_MEMBER(GenericSpheresContact, contactPoint);
CHECK_MEMBER(GenericSpheresContact, refR1);
CHECK_MEMBER(GenericSpheresContact, refR2);

CHECK_SIZE(IPhys);

CHECK_SIZE(NormPhys);
CHECK_MEMBER(NormPhys, kn);
CHECK_MEMBER(NormPhys, normalForce);

CHECK_SIZE(NormShearPhys);
CHECK_MEMBER(NormShearPhys, ks);
CHECK_MEMBER(NormShearPhys, shearForce);

CHECK_SIZE(ScGeom);
CHECK_MEMBER(ScGeom, penetrationDepth);
CHECK_MEMBER(ScGeom, shearInc);

CHECK_SIZE(Bo1_Sphere_Aabb);
CHECK_MEMBER(Bo1_Sphere_Aabb, aabbEnlargeFactor);

CHECK_SIZE(Shape);
CHECK_MEMBER(Shape, boundFunctor);
CHECK_MEMBER(Shape, internalforcefunctor);
CHECK_MEMBER(Shape, color);
CHECK_MEMBER(Shape, wire);
CHECK_MEMBER(Shape, highlight);

CHECK_SIZE(Sphere);
CHECK_MEMBER(Sphere, radius);

CHECK_SIZE(Box);
CHECK_MEMBER(Box, extents);

CHECK_SIZE(Facet);
CHECK_MEMBER(Facet, ne);
CHECK_MEMBER(Facet, icr);
CHECK_MEMBER(Facet, vl);
CHECK_MEMBER(Facet, vu);
CHECK_MEMBER(Facet, vertices);
CHECK_MEMBER(Facet, normal);
CHECK_MEMBER(Facet, area);

CHECK_SIZE(Wall);
CHECK_MEMBER(Wall, sense);
CHECK_MEMBER(Wall, axis);

CHECK_SIZE(Bound);
CHECK_MEMBER(Bound, lastUpdateIter);
CHECK_MEMBER(Bound, refPos);
CHECK_MEMBER(Bound, sweepLength);
CHECK_MEMBER(Bound, color);
CHECK_MEMBER(Bound, min);
CHECK_MEMBER(Bound, max);

CHECK_SIZE(Aabb);

CHECK_SIZE(Material);
CHECK_MEMBER(Material, id);
CHECK_MEMBER(Material, label);
CHECK_MEMBER(Material, density);

CHECK_SIZE(ElastMat);
CHECK_MEMBER(ElastMat, young);
CHECK_MEMBER(ElastMat, poisson);

CHECK_SIZE(FrictMat);
CHECK_MEMBER(FrictMat, frictionAngle);

CHECK_SIZE(State);
CHECK_MEMBER(State, updateMutex);
CHECK_MEMBER(State, se3);
CHECK_MEMBER(State, vel);
CHECK_MEMBER(State, mass);
CHECK_MEMBER(State, angVel);
CHECK_MEMBER(State, angMom);
CHECK_MEMBER(State, inertia);
CHECK_MEMBER(State, refPos);
CHECK_MEMBER(State, refOri);
CHECK_MEMBER(State, blockedDOFs);
CHECK_MEMBER(State, isDamped);
CHECK_MEMBER(State, densityScaling);

CHECK_SIZE(Body);
CHECK_MEMBER(Body, id);
CHECK_MEMBER(Body, groupMask);
CHECK_MEMBER(Body, flags);
CHECK_MEMBER(Body, subdomain);
CHECK_MEMBER(Body, material);
CHECK_MEMBER(Body, state);
CHECK_MEMBER(Body, shape);
CHECK_MEMBER(Body, bound);
CHECK_MEMBER(Body, intrs);
CHECK_MEMBER(Body, clumpId);
CHECK_MEMBER(Body, iterBorn);
CHECK_MEMBER(Body, timeBorn);

CHECK_SIZE(BodyContainer);
CHECK_MEMBER(BodyContainer, body);
CHECK_MEMBER(BodyContainer, dirty);
CHECK_MEMBER(BodyContainer, checkedByCollider);
CHECK_MEMBER(BodyContainer, insertedBodies);
CHECK_MEMBER(BodyContainer, erasedBodies);
CHECK_MEMBER(BodyContainer, realBodies);
CHECK_MEMBER(BodyContainer, useRedirection);
CHECK_MEMBER(BodyContainer, enableRedirection);
CHECK_MEMBER(BodyContainer, subdomainBodies);
CHECK_MEMBER(BodyContainer, drawloopmutex);

CHECK_SIZE(Interaction);
CHECK_MEMBER(Interaction, isActive);
CHECK_MEMBER(Interaction, functorCache);
CHECK_MEMBER(Interaction, id1);
CHECK_MEMBER(Interaction, id2);
CHECK_MEMBER(Interaction, iterMadeReal);
CHECK_MEMBER(Interaction, iterLastSeen);
CHECK_MEMBER(Interaction, geom);
CHECK_MEMBER(Interaction, phys);
CHECK_MEMBER(Interaction, cellDist);
CHECK_MEMBER(Interaction, linIx);
CHECK_MEMBER(Interaction, iterBorn);

CHECK_SIZE(InteractionContainer);
CHECK_MEMBER(InteractionContainer, dirty);
CHECK_MEMBER(InteractionContainer, drawloopmutex);
CHECK_MEMBER(InteractionContainer, serializeSorted);
CHECK_MEMBER(InteractionContainer, iterColliderLastRun);

CHECK_SIZE(Cell);
CHECK_MEMBER(Cell, trsf);
CHECK_MEMBER(Cell, refHSize);
CHECK_MEMBER(Cell, hSize);
CHECK_MEMBER(Cell, prevHSize);
CHECK_MEMBER(Cell, velGrad);
CHECK_MEMBER(Cell, nextVelGrad);
CHECK_MEMBER(Cell, prevVelGrad);
CHECK_MEMBER(Cell, homoDeform);
CHECK_MEMBER(Cell, velGradChanged);
CHECK_MEMBER(Cell, flipFlippable);

CHECK_SIZE(ForceContainer);

CHECK_SIZE(EnergyTracker);

CHECK_SIZE(Scene);
CHECK_MEMBER(Scene, forces);
CHECK_MEMBER(Scene, SpeedElements);
CHECK_MEMBER(Scene, dt);
CHECK_MEMBER(Scene, iter);
CHECK_MEMBER(Scene, subStepping);
CHECK_MEMBER(Scene, subStep);
CHECK_MEMBER(Scene, time);
CHECK_MEMBER(Scene, speed);
CHECK_MEMBER(Scene, stopAtIter);
CHECK_MEMBER(Scene, stopAtTime);
CHECK_MEMBER(Scene, isPeriodic);
CHECK_MEMBER(Scene, trackEnergy);
CHECK_MEMBER(Scene, doSort);
CHECK_MEMBER(Scene, runInternalConsistencyChecks);
CHECK_MEMBER(Scene, selectedBody);
CHECK_MEMBER(Scene, subdomain);
CHECK_MEMBER(Scene, subD);
CHECK_MEMBER(Scene, tags);
CHECK_MEMBER(Scene, engines);
CHECK_MEMBER(Scene, _nextEngines);
CHECK_MEMBER(Scene, bodies);
CHECK_MEMBER(Scene, interactions);
CHECK_MEMBER(Scene, energy);
CHECK_MEMBER(Scene, materials);
CHECK_MEMBER(Scene, bound);
CHECK_MEMBER(Scene, cell);
CHECK_MEMBER(Scene, miscParams);

CHECK_SIZE(ClassFactory);
CHECK_MEMBER(ClassFactory, pluginClasses);

CHECK_SIZE(IPhysFunctor);
CHECK_SIZE(LawFunctor);
CHECK_SIZE(Ig2_Sphere_Sphere_ScGeom);
CHECK_MEMBER(Ig2_Sphere_Sphere_ScGeom, interactionDetectionFactor);
CHECK_MEMBER(Ig2_Sphere_Sphere_ScGeom, avoidGranularRatcheting);
CHECK_SIZE(Law2_ScGeom_FrictPhys_CundallStrack);
CHECK_MEMBER(Law2_ScGeom_FrictPhys_CundallStrack, neverErase);
CHECK_MEMBER(Law2_ScGeom_FrictPhys_CundallStrack, sphericalBodies);
CHECK_MEMBER(Law2_ScGeom_FrictPhys_CundallStrack, traceEnergy);
CHECK_MEMBER(Law2_ScGeom_FrictPhys_CundallStrack, plastDissipIx);
CHECK_MEMBER(Law2_ScGeom_FrictPhys_CundallStrack, elastPotentialIx);

CHECK_SIZE(FrictPhys);
CHECK_MEMBER(FrictPhys, tangensOfFrictionAngle);

CHECK_SIZE(IntrCallback);
CHECK_MEMBER(IntrCallback, scene);
CHECK_SIZE(IGeomDispatcher);
CHECK_MEMBER(IGeomDispatcher, functors);
CHECK_SIZE(IPhysDispatcher);
CHECK_MEMBER(IPhysDispatcher, functors);
CHECK_SIZE(LawDispatcher);
CHECK_MEMBER(LawDispatcher, functors);
CHECK_SIZE(InteractionLoop);
CHECK_MEMBER(InteractionLoop, geomDispatcher);
CHECK_MEMBER(InteractionLoop, physDispatcher);
CHECK_MEMBER(InteractionLoop, lawDispatcher);
CHECK_MEMBER(InteractionLoop, callbacks);
CHECK_MEMBER(InteractionLoop, loopOnSortedInteractions);

// The offsets of State's two reference members cannot be measured: the two are between the base and
// the mutex, in this order.
static_assert(offsetof(State, updateMutex) == 24 + sizeof(Indexable) + 2 * sizeof(void*));
static_assert(sizeof(Se3r) == 56 && offsetof(Se3r, orientation) == 24);

// The same for the two reference members of ScGeom.
static_assert(offsetof(ScGeom, penetrationDepth) ==
              yadefrag::layoutBytes("ScGeom", "orthonormal_axis") + sizeof(Vector3r) +
                  2 * sizeof(void*));

// BoundDispatcher's members begin after YADE's template.
static_assert(sizeof(Dispatcher1D<BoundFunctor>) == 152);

// The table of functors, and that of swapped arguments, begin after Dispatcher.
static_assert(offsetof(IPhysDispatcher, functors) == sizeof(Dispatcher) + 2 * sizeof(vector<int>));

// A friend of the classes whose inline functions read private members.
struct LayoutProbe {
  CHECK_MEMBER(InteractionContainer, linIntrs);
  CHECK_MEMBER(InteractionContainer, sortedIntrs);
  CHECK_MEMBER(InteractionContainer, bodies);
  CHECK_MEMBER(InteractionContainer, currSize);
  CHECK_MEMBER(InteractionContainer, empty);
  CHECK_MEMBER(InteractionContainer, interaction);
  CHECK_MEMBER(NewtonIntegrator, syncEnsured);
  CHECK_MEMBER(NewtonIntegrator, cellChanged);
  CHECK_MEMBER(NewtonIntegrator, homoDeform);
  CHECK_MEMBER(NewtonIntegrator, bodySelected);
  CHECK_MEMBER(NewtonIntegrator, dVelGrad);
  CHECK_MEMBER(NewtonIntegrator, dSpin);
  CHECK_MEMBER(ForceContainer, _forceData);
  CHECK_MEMBER(ForceContainer, _torqueData);
  CHECK_MEMBER(IGeomDispatcher, alreadyWarnedNoCollider);
  CHECK_MEMBER(InteractionLoop, alreadyWarnedNoCollider);
  CHECK_MEMBER(InteractionLoop, eraseAfterLoopIds);
  CHECK_MEMBER(ScGeom, twist_axis);
  CHECK_MEMBER(ScGeom, orthonormal_axis);
  CHECK_MEMBER(Cell, _invTrsf);
  CHECK_MEMBER(Cell, _trsfInc);
  CHECK_MEMBER(Cell, _vGradTimesPrevH);
  CHECK_MEMBER(Cell, _size);
  CHECK_MEMBER(Cell, _cos);
  CHECK_MEMBER(Cell, _refSize);
  CHECK_MEMBER(Cell, _hasShear);
  CHECK_MEMBER(Cell, _shearTrsf);
  CHECK_MEMBER(Cell, _unshearTrsf);
  CHECK_MEMBER(Cell, _glShearTrsfMatrix);
};

}  // namespace yade
