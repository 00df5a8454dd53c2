// The extension behind `import yadefrag`. Loading it changes nothing: yadefrag/__init__.py checks
// the running YADE and then publishes the classes. (An exception while Boost.Python initialises a
// module is lost, so that this is not done there.)

#include "collider/colliders.hpp"
#include "core/lanes.hpp"
#include "loop/curve_integrator.hpp"
#include "loop/curve_loop.hpp"
#include "materials/materials.hpp"
#include "materials/surface_segment.hpp"
#include "solver/fe_solver.hpp"
#include "yade/publish.hpp"
#include "yade/running.hpp"
#ifdef YADE_OPENGL
#include "bindings/body_picture.hpp"
#endif

#include <boost/python.hpp>
#include <unordered_map>
#include <vector>

#include "yade/yade.hpp"

namespace yadefrag {
namespace {

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

// Lists that are passed from Python to YADE.

namespace converter = py::converter;

/// The only conversion to this vector that YADE has registered; null if there is also another one.
template <class Item>
converter::rvalue_from_python_chain* conversion() {
  const converter::registration* known =
      converter::registry::query(py::type_id<std::vector<boost::shared_ptr<Item>>>());
  if (known == nullptr || known->rvalue_chain == nullptr) return nullptr;
  return known->rvalue_chain->next == nullptr ? known->rvalue_chain : nullptr;
}

/// True if a conversion leaves a list's item with one additional reference.
bool keepsReferences() {
  const py::object item(boost::shared_ptr<yade::Body>(new yade::Body));
  py::list list;
  list.append(item);
  const Py_ssize_t before = Py_REFCNT(item.ptr());
  {
    const std::vector<boost::shared_ptr<yade::Body>> converted =
        py::extract<std::vector<boost::shared_ptr<yade::Body>>>(list);
  }
  return Py_REFCNT(item.ptr()) == before + 1;
}

/// Number of references that YADE never releases, by item. Protected by Python's lock.
std::unordered_map<PyObject*, Py_ssize_t>& lostReferences() {
  static std::unordered_map<PyObject*, Py_ssize_t> lost;
  return lost;
}

template <class Item>
struct Watching {
  static inline converter::constructor_function yades = nullptr;

  /// Other sequences may create an item at each access: they are left unchanged.
  static void construct(PyObject* sequence, converter::rvalue_from_python_stage1_data* data) {
    yades(sequence, data);
    if (!PyList_Check(sequence) && !PyTuple_Check(sequence)) return;
    const Py_ssize_t count = PySequence_Fast_GET_SIZE(sequence);
    for (Py_ssize_t i = 0; i < count; ++i)
      ++lostReferences()[PySequence_Fast_GET_ITEM(sequence, i)];
  }

  static void install() {
    converter::rvalue_from_python_chain* chain = conversion<Item>();
    if (chain == nullptr || chain->construct == &construct) return;
    yades = chain->construct;
    chain->construct = &construct;
  }
};

template <class... Items>
void installFor() {
  (Watching<Items>::install(), ...);
}

/// YADE's conversion of a list to a std::vector of shared pointers never releases its references to
/// the items (2023.02a, custom_vector_from_seq: PySequence_GetItem). Engines, functors and bodies
/// that were ever in such a list, and all objects that they own, are therefore never freed. After
/// this call these references are recorded. Does nothing if YADE releases them itself.
void watchListItems() {
  if (!keepsReferences()) return;
  installFor<yade::Body, yade::Engine, yade::BoundFunctor, yade::IGeomFunctor, yade::IPhysFunctor,
             yade::LawFunctor>();
}

/// Frees the items without any other reference; returns their number. Must be called with Python's
/// lock and between two steps. Rejected: to release them at once; the last reference may then be
/// released in the simulation's thread, which frees a Python object without the lock.
std::size_t freeListItems() {
  std::size_t freed = 0;
  auto& lost = lostReferences();
  // A removed engine releases its functors, which may also be in the list: repeat.
  for (bool again = true; again;) {
    std::vector<PyObject*> alone;
    for (const auto& [item, count] : lost)
      if (Py_REFCNT(item) == count) alone.push_back(item);
    for (PyObject* item : alone) {
      const Py_ssize_t count = lost.extract(item).mapped();
      for (Py_ssize_t i = 0; i < count; ++i) Py_DECREF(item);
    }
    freed += alone.size();
    again = !alone.empty();
  }
  return freed;
}

}  // namespace
}  // namespace yadefrag

BOOST_PYTHON_MODULE(_yadefrag) {
  namespace py = boost::python;
  py::def("instructionSet", &yadefrag::instructionSet);
  yadefrag::defineBodyParts();
  yadefrag::defineMeshes();
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
