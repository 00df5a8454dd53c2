// The extension behind `import yadefrag`. Loading it changes nothing: yadefrag/__init__.py checks
// the running YADE and then publishes the classes. (An exception while Boost.Python initialises a
// module is lost, so that this is not done there.)

#include "collider/colliders.hpp"
#include "core/instruction_set.hpp"
#include "entries/surface_segment.hpp"
#include "fe/fe_solver.hpp"
#include "fe/materials.hpp"
#include "fe/running.hpp"
#include "integrator/curve_integrator.hpp"
#include "loop/curve_loop.hpp"
#include "publish/publish.hpp"
#include "python/list_items.hpp"
#include "script/definitions.hpp"
#ifdef YADE_OPENGL
#include "view/gl_surface_segment.hpp"
#endif

namespace yadefrag {

template <class... Classes>
struct ClassList {
  static py::tuple publishAll() {
    publish<Classes...>(__FILE__);
    return py::make_tuple(Classes::kName...);
  }
};

// Every class that this project adds to YADE.
using NewClasses =
    ClassList<LebesgueCollider, LinearCodeCollider, HierarchyCollider, CurveLoop, CurveIntegrator,
              FEMat, BrittleFEMat, PlasticFEMat, FrictionalFEMat, SurfaceSegment,
              Bo1_SurfaceSegment_Aabb, Ig2_Sphere_SurfaceSegment_ScGeom,
#ifdef YADE_OPENGL
              Gl1_SurfaceSegment,
#endif
              FESolver>;

/// The instruction set that is used on this processor.
std::string instructionSet() {
  return bestInstructionSet() == InstructionSet::kAvx2 ? "AVX2" : "SSE2";
}

/// A renderer that was created before the classes of this module has no functors and no table
/// entries for the new shapes: YADE would end the process.
void renewRenderer([[maybe_unused]] const py::object& renderer) {
#ifdef YADE_OPENGL
  yade::Serializable& object = py::extract<yade::Serializable&>(renderer);
  if (object.getClassName() == "OpenGLRenderer") static_cast<yade::OpenGLRenderer&>(object).init();
#endif
}

}  // namespace yadefrag

BOOST_PYTHON_MODULE(_yadefrag) {
  namespace py = boost::python;
  py::def("instructionSet", &yadefrag::instructionSet);
  yadefrag::defineBodyParts();
  yadefrag::defineMeshes();
  yadefrag::defineOutlines();
  py::def("isInStep", &yadefrag::isInStep);
  py::def("requirePaused", &yadefrag::requirePaused,
          "Raises RuntimeError if another thread runs the scene.");
  py::def("beginRun", &yadefrag::beginRun);
  py::def("waitForEnd", &yadefrag::waitForEnd,
          "Waits for the end of a run, for some hundredths of a second; False: it goes on. It "
          "checks at "
          "intervals in proportion to the time: O.wait() checks every 40 ms.");
  py::def("stopRun", &yadefrag::stopRun);
  py::def("whyStopped", &yadefrag::whyStopped,
          "Reason why FESolver has refused a step since the last call; '' for none.");
  py::def("watchListItems", &yadefrag::watchListItems);
  py::def("freeListItems", &yadefrag::freeListItems,
          "Frees engines, functors and bodies to which only YADE's unreleased references remain.");
  py::def("renewRenderer", &yadefrag::renewRenderer);
  py::def("publish", &yadefrag::NewClasses::publishAll,
          "Adds the new classes to YADE, once; returns their names.");
}
