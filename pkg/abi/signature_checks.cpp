// This file compiles only if the functions of YADE that are used have these types. It is compiled
// against pkg/abi in each build, and against YADE's own headers by tools/check_source.py.

#include "abi/yade.hpp"

// The cast also selects one of several functions of the same name.
#define CHECK_FUNCTION(name, ...) static_assert(requires { static_cast<__VA_ARGS__>(&name); })

namespace yade {

CHECK_FUNCTION(Factorable::getBaseClassName, string (Factorable::*)(unsigned int) const);
CHECK_FUNCTION(Factorable::getBaseClassNumber, int (Factorable::*)() const);
CHECK_FUNCTION(Factorable::getClassName, string (Factorable::*)() const);
CHECK_FUNCTION(Serializable::pySetAttr, void (Serializable::*)(const string&, const py::object&));
CHECK_FUNCTION(Serializable::pyDict, py::dict (Serializable::*)() const);
CHECK_FUNCTION(Serializable::pyDictCustom, py::dict (Serializable::*)() const);
CHECK_FUNCTION(Serializable::callPostLoad, void (Serializable::*)());
CHECK_FUNCTION(Serializable::checkPyClassRegistersItself,
               void (Serializable::*)(const string&) const);
CHECK_FUNCTION(Serializable::pyRegisterClass, void (Serializable::*)(py::object));
CHECK_FUNCTION(Serializable::pyHandleCustomCtorArgs, void (Serializable::*)(py::tuple&, py::dict&));
CHECK_FUNCTION(Serializable::pyUpdateAttrs, void (Serializable::*)(const py::dict&));

CHECK_FUNCTION(Shape::getClassIndex, const int& (Shape::*)() const);
CHECK_FUNCTION(Shape::getBaseClassIndex, const int& (Shape::*)(int) const);
CHECK_FUNCTION(Shape::getMaxCurrentlyUsedClassIndexOfKin, const int& (Shape::*)() const);
CHECK_FUNCTION(Material::getClassIndex, const int& (Material::*)() const);
CHECK_FUNCTION(Material::getBaseClassIndex, const int& (Material::*)(int) const);
CHECK_FUNCTION(Material::newAssocState, shared_ptr<State> (Material::*)() const);
CHECK_FUNCTION(Material::stateTypeOk, bool (Material::*)(State*) const);
CHECK_FUNCTION(Material::byId, const shared_ptr<Material> (*)(int, Scene*));
CHECK_FUNCTION(Material::byLabel, const shared_ptr<Material> (*)(const string&, Scene*));

CHECK_FUNCTION(Engine::isActivated, bool (Engine::*)());
CHECK_FUNCTION(Engine::action, void (Engine::*)());
CHECK_FUNCTION(Dispatcher::getFunctorType, string (Dispatcher::*)() const);
CHECK_FUNCTION(Dispatcher::getDimension, int (Dispatcher::*)() const);
CHECK_FUNCTION(Dispatcher::getBaseClassType, string (Dispatcher::*)(unsigned int) const);
CHECK_FUNCTION(BoundDispatcher::processBody, void (BoundDispatcher::*)(const shared_ptr<Body>&));
CHECK_FUNCTION(Functor::getFunctorTypes, vector<string> (Functor::*)() const);
CHECK_FUNCTION(BoundFunctor::get1DFunctorType1, string (BoundFunctor::*)() const);
CHECK_FUNCTION(BoundFunctor::go,
               void (BoundFunctor::*)(const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&,
                                      const Body*));
CHECK_FUNCTION(IGeomFunctor::get2DFunctorType1, string (IGeomFunctor::*)() const);
CHECK_FUNCTION(IGeomFunctor::get2DFunctorType2, string (IGeomFunctor::*)() const);
CHECK_FUNCTION(IGeomFunctor::preStep, void (IGeomFunctor::*)());
CHECK_FUNCTION(IGeomFunctor::go,
               bool (IGeomFunctor::*)(const shared_ptr<Shape>&, const shared_ptr<Shape>&,
                                      const State&, const State&, const Vector3r&, const bool&,
                                      const shared_ptr<Interaction>&));
CHECK_FUNCTION(IGeomFunctor::goReverse,
               bool (IGeomFunctor::*)(const shared_ptr<Shape>&, const shared_ptr<Shape>&,
                                      const State&, const State&, const Vector3r&, const bool&,
                                      const shared_ptr<Interaction>&));
CHECK_FUNCTION(IPhysFunctor::go,
               void (IPhysFunctor::*)(const shared_ptr<Material>&, const shared_ptr<Material>&,
                                      const shared_ptr<Interaction>&));
CHECK_FUNCTION(LawFunctor::go,
               bool (LawFunctor::*)(shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*));
CHECK_FUNCTION(IGeomDispatcher::getFunctor2D,
               shared_ptr<IGeomFunctor> (IGeomDispatcher::*)(shared_ptr<Shape>&, shared_ptr<Shape>&,
                                                             bool&));
CHECK_FUNCTION(IPhysDispatcher::getFunctor2D,
               shared_ptr<IPhysFunctor> (IPhysDispatcher::*)(shared_ptr<Material>&,
                                                             shared_ptr<Material>&, bool&));
CHECK_FUNCTION(LawDispatcher::getFunctor2D,
               shared_ptr<LawFunctor> (LawDispatcher::*)(shared_ptr<IGeom>&, shared_ptr<IPhys>&,
                                                         bool&));
CHECK_FUNCTION(IntrCallback::stepInit, IntrCallback::FuncPtr (IntrCallback::*)());
CHECK_FUNCTION(InteractionLoop::action, void (InteractionLoop::*)());
#ifdef YADE_OPENGL
CHECK_FUNCTION(GlShapeFunctor::renders, string (GlShapeFunctor::*)() const);
CHECK_FUNCTION(GlShapeFunctor::initgl, void (GlShapeFunctor::*)());
CHECK_FUNCTION(GlShapeFunctor::go,
               void (GlShapeFunctor::*)(const shared_ptr<Shape>&, const shared_ptr<State>&, bool,
                                        const GLViewInfo&));
CHECK_FUNCTION(OpenGLRenderer::init, void (OpenGLRenderer::*)());
#endif

CHECK_FUNCTION(Collider::probeBoundingVolume, vector<Body::id_t> (Collider::*)(const Bound&));
CHECK_FUNCTION(Collider::invalidatePersistentData, void (Collider::*)());
#ifdef YADE_MPI
CHECK_FUNCTION(Collider::mayCollide, bool (Collider::*)(const Body*, const Body*, Body::id_t));
#else
CHECK_FUNCTION(Collider::mayCollide, bool (Collider::*)(const Body*, const Body*));
#endif
CHECK_FUNCTION(NewtonIntegrator::action, void (NewtonIntegrator::*)());

CHECK_FUNCTION(Body::userForcedDisplacementRedrawHook, void (Body::*)());
CHECK_FUNCTION(Body::byId, const shared_ptr<Body>& (*)(Body::id_t, Scene*));
CHECK_FUNCTION(Body::byId, const shared_ptr<Body>& (*)(Body::id_t, shared_ptr<Scene>));
CHECK_FUNCTION(Body::isBounded, bool (Body::*)() const);
CHECK_FUNCTION(Body::isStandalone, bool (Body::*)() const);
CHECK_FUNCTION(Body::isClump, bool (Body::*)() const);
CHECK_FUNCTION(Body::isClumpMember, bool (Body::*)() const);
CHECK_FUNCTION(Body::isDynamic, bool (Body::*)() const);
CHECK_FUNCTION(BodyContainer::size, std::size_t (BodyContainer::*)() const);
CHECK_FUNCTION(BodyContainer::operator[], shared_ptr<Body>& (BodyContainer::*)(unsigned int));
CHECK_FUNCTION(BodyContainer::exists, bool (BodyContainer::*)(Body::id_t) const);
CHECK_FUNCTION(BodyContainer::insert, Body::id_t (BodyContainer::*)(shared_ptr<Body>));
CHECK_FUNCTION(BodyContainer::erase, bool (BodyContainer::*)(Body::id_t, bool));
CHECK_FUNCTION(BodyContainer::updateRealBodies, void (BodyContainer::*)());

CHECK_FUNCTION(Interaction::isReal, bool (Interaction::*)() const);
CHECK_FUNCTION(Interaction::isFresh, bool (Interaction::*)(Scene*));
CHECK_FUNCTION(Interaction::swapOrder, void (Interaction::*)());
CHECK_FUNCTION(Interaction::reset, void (Interaction::*)());
CHECK_FUNCTION(InteractionContainer::size, std::size_t (InteractionContainer::*)());
CHECK_FUNCTION(InteractionContainer::insert,
               bool (InteractionContainer::*)(Body::id_t, Body::id_t));
CHECK_FUNCTION(InteractionContainer::insert,
               bool (InteractionContainer::*)(const shared_ptr<Interaction>&));
CHECK_FUNCTION(InteractionContainer::erase,
               bool (InteractionContainer::*)(Body::id_t, Body::id_t, int));
CHECK_FUNCTION(InteractionContainer::find,
               const shared_ptr<Interaction>& (InteractionContainer::*)(Body::id_t, Body::id_t));
CHECK_FUNCTION(InteractionContainer::clear, void (InteractionContainer::*)());
CHECK_FUNCTION(InteractionContainer::eraseNonReal, void (InteractionContainer::*)());
CHECK_FUNCTION(InteractionContainer::requestErase,
               void (InteractionContainer::*)(Body::id_t, Body::id_t));

CHECK_FUNCTION(Cell::getSize, const Vector3r& (Cell::*)() const);
CHECK_FUNCTION(Cell::getCos, const Vector3r& (Cell::*)() const);
CHECK_FUNCTION(Cell::hasShear, bool (Cell::*)() const);
CHECK_FUNCTION(Cell::getShearTrsf, const Matrix3r& (Cell::*)() const);
CHECK_FUNCTION(Cell::getUnshearTrsf, const Matrix3r& (Cell::*)() const);
CHECK_FUNCTION(Cell::shearPt, Vector3r (Cell::*)(const Vector3r&) const);
CHECK_FUNCTION(Cell::unshearPt, Vector3r (Cell::*)(const Vector3r&) const);
CHECK_FUNCTION(Cell::intrShiftPos, Vector3r (Cell::*)(const Vector3i&) const);
CHECK_FUNCTION(Cell::wrapNum, Real (*)(const Real&, const Real&));
CHECK_FUNCTION(Cell::wrapNum, Real (*)(const Real&, const Real&, int&));

CHECK_FUNCTION(ForceContainer::addMaxId, void (ForceContainer::*)(Body::id_t));
CHECK_FUNCTION(ForceContainer::addForce, void (ForceContainer::*)(Body::id_t, const Vector3r&));
CHECK_FUNCTION(ForceContainer::addTorque, void (ForceContainer::*)(Body::id_t, const Vector3r&));
CHECK_FUNCTION(ForceContainer::sync, void (ForceContainer::*)());
CHECK_FUNCTION(ForceContainer::getForce, const Vector3r& (ForceContainer::*)(Body::id_t));
CHECK_FUNCTION(ForceContainer::getTorque, const Vector3r& (ForceContainer::*)(Body::id_t));
CHECK_FUNCTION(EnergyTracker::setItem_py, void (EnergyTracker::*)(const string&, Real));
CHECK_FUNCTION(ScGeom::precompute, void (ScGeom::*)(const State&, const State&, const Scene*,
                                                    const shared_ptr<Interaction>&, const Vector3r&,
                                                    bool, const Vector3r&, bool));

CHECK_FUNCTION(Scene::timeStepperPresent, bool (Scene::*)());
CHECK_FUNCTION(Scene::timeStepperActive, bool (Scene::*)());
CHECK_FUNCTION(Scene::moveToNextTimeStep, void (Scene::*)());
CHECK_FUNCTION(ClassFactory::createShared, shared_ptr<Factorable> (ClassFactory::*)(string));
CHECK_FUNCTION(ClassFactory::registerPluginClasses, void (ClassFactory::*)(const char*[]));
CHECK_FUNCTION(ClassFactory::registerFactorable,
               bool (ClassFactory::*)(string, Factorable* (*)(), shared_ptr<Factorable> (*)(),
                                      void* (*)()));
CHECK_FUNCTION(Omega::loadPlugins, void (Omega::*)(vector<string>));
CHECK_FUNCTION(Omega::getScene, const shared_ptr<Scene>& (Omega::*)() const);
CHECK_FUNCTION(Omega::createSimulationLoop, void (Omega::*)());
CHECK_FUNCTION(Omega::isRunning, bool (Omega::*)());
CHECK_FUNCTION(Omega::pause, void (Omega::*)());
CHECK_FUNCTION(Omega::isInheritingFrom_recursive, bool (Omega::*)(const string&, const string&));

}  // namespace yade
