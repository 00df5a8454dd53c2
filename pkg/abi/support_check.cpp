#include "abi/support_check.hpp"

#include <algorithm>

#include "abi/round_trip.hpp"
#include "abi/yade_build.hpp"

namespace yadefrag {

namespace py = yade::py;
using yade::Matrix3r;
using yade::Vector3i;
using yade::Vector3r;

namespace {

// "yadefrag needs YADE 2023.02a as Debian 12 packages it, and the running yade "
std::string needed() {
  return std::string("yadefrag needs YADE ") + kYadeVersion + " as " + kYadeBuild +
         ", and the running yade ";
}

}  // namespace

void throwMisplaced(const std::string& typeAndMember) {
  throw UnsupportedYade(needed() + "differs: " + typeAndMember +
                        " is not where that build has it.");
}

namespace {

// Each value is used once per class: if two members were mixed up, their values would differ.

void checkBound() {
  const Scratch<yade::Aabb> box("Aabb");
  box.check("lastUpdateIter", box->lastUpdateIter, 11);
  box.check("refPos", box->refPos, Vector3r(1, 2, 3));
  box.check("sweepLength", box->sweepLength, .25);
  box.check("color", box->color, Vector3r(.1, .2, .3));
  box.check("min", box->min, Vector3r(4, 5, 6));
  box.check("max", box->max, Vector3r(7, 8, 9));
}

void checkShapes() {
  const Scratch<yade::Sphere> sphere("Sphere");
  sphere.check("color", sphere->color, Vector3r(.1, .2, .3));
  sphere.check("wire", sphere->wire, true);
  sphere.check("highlight", sphere->highlight, true);
  sphere.check("radius", sphere->radius, 1.5);
  const yade::Shape& shape = *sphere;
  sphere.refuse("type", typeid(shape) != typeid(yade::Sphere) ||
                            dynamic_cast<const yade::Sphere*>(&shape) == nullptr ||
                            dynamic_cast<const yade::Box*>(&shape) != nullptr);
  sphere.refuse("classIndex",
                shape.getClassIndex() < 0 || shape.getBaseClassIndex(1) != -1 ||
                    shape.getMaxCurrentlyUsedClassIndexOfKin() < shape.getClassIndex());
  const Scratch<yade::Box> box("Box");
  box.check("extents", box->extents, Vector3r(1, 2, 3));
  const Scratch<yade::Wall> wall("Wall");
  wall.check("sense", wall->sense, 1);
  wall.check("axis", wall->axis, 2);
}

void checkState() {
  const Scratch<yade::State> state("State");
  state.checkProperty("pos", state->pos, Vector3r(1, 2, 3));
  state.refuse("se3",
               &state->pos != &state->se3.position || &state->ori != &state->se3.orientation);
  state.check("vel", state->vel, Vector3r(4, 5, 6));
  state.check("mass", state->mass, 7.5);
  state.check("angVel", state->angVel, Vector3r(8, 9, 10));
  state.check("angMom", state->angMom, Vector3r(11, 12, 13));
  state.check("inertia", state->inertia, Vector3r(14, 15, 16));
  state.check("refPos", state->refPos, Vector3r(17, 18, 19));
  state.check("isDamped", state->isDamped, false);
  state.check("densityScaling", state->densityScaling, .5);
  py::setattr(state.object(), "blockedDOFs", py::str("xZ"));
  state.refuse("blockedDOFs", state->blockedDOFs != (yade::State::DOF_X | yade::State::DOF_RZ));
}

void checkMaterial() {
  const Scratch<yade::Material> material("Material");
  material.check("id", material->id, 3);
  material.check("label", material->label, "scratch");
  material.check("density", material->density, 2.5);
  const Scratch<yade::FrictMat> friction("FrictMat");
  friction.check("young", friction->young, 3.5);
  friction.check("poisson", friction->poisson, .25);
  friction.check("frictionAngle", friction->frictionAngle, .75);
  // Its own index, that of ElastMat, and none for Material: a new material class starts from these.
  const yade::Material& base = *friction;
  friction.refuse("classIndex", base.getClassIndex() < 0 || base.getBaseClassIndex(1) < 0 ||
                                    base.getBaseClassIndex(2) != -1);
}

void checkContactGeometry() {
  const Scratch<yade::ScGeom> geom("ScGeom");
  geom.check("normal", geom->normal, Vector3r(1, 2, 3));
  geom.check("contactPoint", geom->contactPoint, Vector3r(4, 5, 6));
  geom.check("refR1", geom->refR1, 7.5);
  geom.check("refR2", geom->refR2, 8.5);
  geom.check("penetrationDepth", geom->penetrationDepth, 9.5);
  geom.check("shearInc", geom->shearInc, Vector3r(10, 11, 12));
  const Scratch<yade::NormShearPhys> forces("NormShearPhys");
  forces.check("kn", forces->kn, 13.5);
  forces.check("ks", forces->ks, 14.5);
  forces.check("normalForce", forces->normalForce, Vector3r(15, 16, 17));
  forces.check("shearForce", forces->shearForce, Vector3r(18, 19, 20));
  geom.refuse("radius1", &geom->radius1 != &geom->refR1 || &geom->radius2 != &geom->refR2);
}

void checkBody() {
  const Scratch<yade::Body> body("Body");
  body.check("id", body->id, 5);
  body.check("groupMask", body->groupMask, 6);
  body.check("flags", body->flags, 14);
#ifdef YADE_MPI
  body.check("subdomain", body->subdomain, 8);
#endif
  body.check("clumpId", body->clumpId, 5);
  body.check("iterBorn", body->iterBorn, 10);
  body.check("timeBorn", body->timeBorn, 11.5);
  body.check("material", body->material, Scratch<yade::Material>("FrictMat").pointer());
  body.check("state", body->state, Scratch<yade::State>("State").pointer());
  body.check("shape", body->shape, Scratch<yade::Shape>("Sphere").pointer());
  body.check("bound", body->bound, Scratch<yade::Bound>("Aabb").pointer());
  body.refuse("isClump", !body->isClump() || body->isClumpMember() || body->isStandalone());
  body.refuse("isBounded", body->isBounded() || !body->getIsSubdomain());
}

void checkInteraction() {
  const Scratch<yade::Interaction> contact("Interaction");
  contact.check("id1", contact->id1, 3);
  contact.check("id2", contact->id2, 4);
  contact.check("iterMadeReal", contact->iterMadeReal, 5);
  contact.check("iterLastSeen", contact->iterLastSeen, 6);
  contact.check("cellDist", contact->cellDist, Vector3i(7, 8, 9));
  contact.check("linIx", contact->linIx, 10);
  contact.check("iterBorn", contact->iterBorn, 11);
  contact.checkProperty("isActive", contact->isActive, false);
  contact.refuse("isReal", contact->isReal() || contact->geom || contact->phys);
}

void checkCell() {
  const Scratch<yade::Cell> cell("Cell");
  cell.check("homoDeform", cell->homoDeform, 1);
  cell.check("velGradChanged", cell->velGradChanged, true);
  cell.check("flipFlippable", cell->flipFlippable, true);
  Matrix3r sheared;
  sheared << 2, .5, 0, 0, 3, .25, 0, 0, 4;
  cell.check("velGrad", cell->velGrad, Matrix3r(.1 * sheared));
  cell.check("nextVelGrad", cell->nextVelGrad, Matrix3r(.2 * sheared));
  cell.check("prevVelGrad", cell->prevVelGrad, Matrix3r(.3 * sheared));
  cell.check("trsf", cell->trsf, Matrix3r(.4 * sheared));
  cell.checkProperty("hSize", cell->hSize, sheared);
  const auto seen = [&](const char* attr) { return cell.object().attr(attr); };
  const Vector3r size = py::extract<Vector3r>(seen("size"));
  const Matrix3r shear = py::extract<Matrix3r>(seen("shearTrsf"));
  const Matrix3r unshear = py::extract<Matrix3r>(seen("unshearTrsf"));
  cell.refuse("size", cell->getSize() != size || size[0] != 2);
  cell.refuse("hasShear", !cell->hasShear());
  cell.refuse("shearTrsf", cell->getShearTrsf() != shear || cell->getUnshearTrsf() != unshear);
  cell.refuse("cos", !(cell->getCos().array() > 0).all() || !(cell->getCos().array() <= 1).all());
}

void checkEngines() {
  const Scratch<yade::NewtonIntegrator> newton("NewtonIntegrator");
  const auto& scene = yade::Omega::instance().getScene();
  newton.refuse("scene", newton->scene != scene.get());
  newton.check("dead", newton->dead, true);
  newton.check("ompThreads", newton->ompThreads, 2);
  newton.check("label", newton->label, "scratch");
  newton.checkProperty("execCount", newton->timingInfo.nExec, 7L);
  newton.checkProperty("execTime", newton->timingInfo.nsec, 8ULL);
  newton.check("damping", newton->damping, .125);
  newton.check("gravity", newton->gravity, Vector3r(1, 2, 3));
  newton.check("maxVelocitySq", newton->maxVelocitySq, 4.5);
  newton.check("prevCellSize", newton->prevCellSize, Vector3r(5, 6, 7));
  newton.check("mask", newton->mask, 12);
  newton.refuse("threadMaxVelocitySq", newton->threadMaxVelocitySq.empty());
}

void checkCollider() {
  const Scratch<yade::BoundFunctor> functor("Bo1_Sphere_Aabb");
  functor.check("label", functor->label, "scratch");
  const yade::BoundFunctor& base = *functor;
  functor.refuse("type", typeid(base) != typeid(yade::Bo1_Sphere_Aabb));
  functor.refuse("get1DFunctorType1", base.get1DFunctorType1() != "Sphere");
  functor.refuse("getFunctorTypes", base.getFunctorTypes() != std::vector<std::string>{"Sphere"});
  const auto& sphereFunctor = static_cast<const yade::Bo1_Sphere_Aabb&>(base);
  functor.check("aabbEnlargeFactor", sphereFunctor.aabbEnlargeFactor, 1.5);

  const Scratch<yade::IGeomFunctor> wall("Ig2_Wall_Sphere_ScGeom");
  wall.refuse("get2DFunctorType", wall->get2DFunctorType1() != "Wall" ||
                                      wall->get2DFunctorType2() != "Sphere" ||
                                      wall->checkOrder() != "Wall Sphere");

  const Scratch<yade::BoundDispatcher> bounds("BoundDispatcher");
  bounds.check("activated", bounds->activated, false);
  bounds.check("sweepDist", bounds->sweepDist, .125);
  bounds.check("minSweepDistFactor", bounds->minSweepDistFactor, .25);
  bounds.check("updatingDispFactor", bounds->updatingDispFactor, .5);
  bounds.check("targetInterv", bounds->targetInterv, 6.5);
  py::list functors;
  functors.append(functor.object());
  py::setattr(bounds.object(), "functors", functors);
  bounds.refuse("functors",
                bounds->functors.size() != 1 || bounds->functors[0] != functor.pointer());

  const Scratch<yade::Collider> collider("Collider");
  collider.check("avoidSelfInteractionMask", collider->avoidSelfInteractionMask, 3);
  collider.check("boundDispatcher", collider->boundDispatcher, bounds.pointer());
}

void checkLoop() {
  const Scratch<yade::FrictPhys> phys("FrictPhys");
  phys.check("tangensOfFrictionAngle", phys->tangensOfFrictionAngle, .25);
  const yade::IPhys& base = *phys;
  phys.refuse("classIndex", base.getClassIndex() < 0 || base.getBaseClassIndex(1) < 0);
  const Scratch<yade::Ig2_Sphere_Sphere_ScGeom> geom("Ig2_Sphere_Sphere_ScGeom");
  geom.check("interactionDetectionFactor", geom->interactionDetectionFactor, 1.5);
  geom.check("avoidGranularRatcheting", geom->avoidGranularRatcheting, false);
  const Scratch<yade::Law2_ScGeom_FrictPhys_CundallStrack> law(
      "Law2_ScGeom_FrictPhys_CundallStrack");
  law.check("neverErase", law->neverErase, true);
  law.check("sphericalBodies", law->sphericalBodies, false);
  law.check("traceEnergy", law->traceEnergy, true);

  const Scratch<yade::InteractionLoop> loop("InteractionLoop");
  loop.check("loopOnSortedInteractions", loop->loopOnSortedInteractions, true);
  loop.refuse("callbacks", !loop->callbacks.empty());
  py::list functors;
  functors.append(law.object());
  py::setattr(loop.object().attr("lawDispatcher"), "functors", functors);
  auto& laws = *loop->lawDispatcher;
  loop.refuse("lawDispatcher", laws.functors.size() != 1 || laws.functors[0] != law.pointer());
  yade::shared_ptr<yade::IGeom> contact = Scratch<yade::ScGeom>("ScGeom").pointer();
  yade::shared_ptr<yade::IPhys> friction = phys.pointer();
  bool isSwapped = true;
  loop.refuse("getFunctor2D",
              laws.getFunctor2D(contact, friction, isSwapped) != law.pointer() || isSwapped);
}

void checkScene(const Scratch<yade::Scene>& scene) {
  scene.check("dt", scene->dt, .5);
  scene.check("iter", scene->iter, 7);
  scene.check("subStepping", scene->subStepping, true);
  scene.check("subStep", scene->subStep, 8);
  scene.check("time", scene->time, .25);
  scene.check("speed", scene->speed, 3.5);
  scene.check("stopAtIter", scene->stopAtIter, 9);
  scene.check("stopAtTime", scene->stopAtTime, 10.5);
  scene.check("isPeriodic", scene->isPeriodic, true);
  scene.check("trackEnergy", scene->trackEnergy, true);
  scene.check("doSort", scene->doSort, true);
  scene.check("runInternalConsistencyChecks", scene->runInternalConsistencyChecks, false);
  scene.check("selectedBody", scene->selectedBody, 11);
#ifdef YADE_MPI
  scene.check("subdomain", scene->subdomain, 12);
  scene.check("subD", scene->subD, Scratch<yade::Shape>("Sphere").pointer());
#endif
  scene.check("cell", scene->cell, Scratch<yade::Cell>("Cell").pointer());
  scene.check("bound", scene->bound, Scratch<yade::Bound>("Aabb").pointer());
  const Scratch<yade::Engine> engine("ForceResetter");
  py::list engines;
  engines.append(engine.object());
  py::dict one;
  one["engines"] = engines;
  scene->pyUpdateAttrs(one);
  scene.refuse("engines", scene->engines.size() != 1 || scene->engines[0] != engine.pointer());
  scene.refuse("energy", scene->energy->getClassName() != "EnergyTracker");
  scene.refuse("bodies", scene->bodies->getClassName() != "BodyContainer");
  scene.refuse("interactions", scene->interactions->getClassName() != "InteractionContainer");
}

void checkIds(const Scratch<yade::BodyContainer>& bodies, const char* attr,
              const std::vector<int>& slot, int first) {
  py::list written;
  written.append(first);
  written.append(first + 1);
  py::dict one;
  one[attr] = written;
  bodies->pyUpdateAttrs(one);
  bodies.refuse(attr, slot != std::vector<int>{first, first + 1});
}

// Two bodies and a contact between them, in containers outside any simulation.
void checkContainers(const Scratch<yade::Scene>& scene) {
  const Scratch<yade::BodyContainer> bodies("BodyContainer", scene->bodies);
  bodies.check("dirty", bodies->dirty, false);
  bodies.check("checkedByCollider", bodies->checkedByCollider, true);
  bodies.check("useRedirection", bodies->useRedirection, true);
  bodies.check("enableRedirection", bodies->enableRedirection, false);
  checkIds(bodies, "insertedBodies", bodies->insertedBodies, 20);
  checkIds(bodies, "erasedBodies", bodies->erasedBodies, 30);
  checkIds(bodies, "realBodies", bodies->realBodies, 40);
#ifdef YADE_MPI
  checkIds(bodies, "subdomainBodies", bodies->subdomainBodies, 50);
#endif

  const Scratch<yade::InteractionContainer> contacts("InteractionContainer", scene->interactions);
  contacts.check("dirty", contacts->dirty, false);
  contacts.check("serializeSorted", contacts->serializeSorted, true);
  contacts.refuse("iterColliderLastRun", contacts->iterColliderLastRun != -1);

  const Scratch<yade::Body> first("Body");
  const Scratch<yade::Body> second("Body");
  bodies.refuse("body", !bodies->body.empty());
  first.check("id", first->id, 0);
  second.check("id", second->id, 1);
  bodies->body = {first.pointer(), second.pointer()};
  bodies.refuse("size", bodies->size() != 2 || (*bodies)[1] != second.pointer());
  first.refuse("intrs", !first->intrs.empty() || first->intrs.begin() != first->intrs.end());
  contacts->insert(0, 1);
  contacts.refuse("insert", contacts->size() != 1 || contacts->end() - contacts->begin() != 1);
  const auto contact = (*contacts)[0];
  contacts.refuse("find", contacts->find(1, 0) != contact || contact->linIx != 0);
  first.refuse("intrs", first->intrs.size() != 1 || first->intrs.begin()->second != contact);
  contacts->erase(0, 1, contact->linIx);
  contacts.refuse("erase", contacts->size() != 0 || !first->intrs.empty());
}

// Read only: the simulation of `O`, and the list of classes to publish.
void checkSingletons() {
  const auto& known = yade::ClassFactory::instance().pluginClasses;
  if (std::find(known.begin(), known.end(), "Collider") == known.end()) {
    throwMisplaced("ClassFactory.pluginClasses");
  }
  const py::object omega = py::import("yade.wrapper").attr("Omega")();
  const auto& scene = *yade::Omega::instance().getScene();
  const bool same = py::extract<long>(omega.attr("iter"))() == scene.iter &&
                    py::extract<double>(omega.attr("dt"))() == scene.dt &&
                    py::extract<bool>(omega.attr("periodic"))() == scene.isPeriodic &&
                    static_cast<std::size_t>(py::len(omega.attr("bodies"))) == scene.bodies->size();
  if (!same) throwMisplaced("Omega.scene");
}

void checkAll() {
  checkBound();
  checkShapes();
  checkState();
  checkMaterial();
  checkContactGeometry();
  checkBody();
  checkInteraction();
  checkCell();
  checkEngines();
  checkCollider();
  checkLoop();
  const Scratch<yade::Scene> scene("Scene");
  checkScene(scene);
  checkContainers(scene);
  checkSingletons();
}

// Returns the text of the pending Python error, and clears that error.
std::string takePythonError() {
  PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
  PyErr_Fetch(&type, &value, &trace);
  PyErr_NormalizeException(&type, &value, &trace);
  const py::handle<> typeHandle(py::allow_null(type)), traceHandle(py::allow_null(trace));
  const py::handle<> valueHandle(py::allow_null(value));
  if (value == nullptr) return "an unknown error";
  return py::extract<std::string>(py::str(py::object(valueHandle)))();
}

}  // namespace

void checkRunningYade() {
  try {
    checkAll();
  } catch (const py::error_already_set&) {
    throw UnsupportedYade(needed() + "lacks something of it: " + takePythonError());
  }
}

}  // namespace yadefrag
