#include "python/list_items.hpp"

#include <boost/python.hpp>
#include <unordered_map>
#include <vector>

#include "abi/yade.hpp"

namespace yadefrag {
namespace {

namespace py = boost::python;
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

}  // namespace

void watchListItems() {
  if (!keepsReferences()) return;
  installFor<yade::Body, yade::Engine, yade::BoundFunctor, yade::IGeomFunctor, yade::IPhysFunctor,
             yade::LawFunctor>();
}

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

}  // namespace yadefrag
