#include "yade/attribute.hpp"

#include <boost/mpl/vector.hpp>

#include <mutex>
#include <string>

#include "yade/archives.hpp"
#include "yade/step_lock.hpp"
#include "yade/value_kind.hpp"

namespace yadefrag {
namespace {

namespace py = yade::py;

using Guard = std::unique_lock<StepLock>;

Guard guardOf(const AttributeTable& table, const yade::Serializable& object) {
  StepLock* const lock = table.lockOf(object);
  return lock == nullptr ? Guard() : Guard(*lock);
}

yade::Serializable& objectOf(const py::object& self) {
  return py::extract<yade::Serializable&>(self);
}

// Python keeps these functions to its end, and the tables are never freed.
struct Getter {
  const AttributeTable* table;
  const Attribute* attribute;

  py::object operator()(const py::object& self) const {
    yade::Serializable& object = objectOf(self);
    const Guard guard = guardOf(*table, object);
    const ValueKind& kind = *attribute->kind;
    if (kind.reference != nullptr) return kind.reference(attribute->slot(object), self);
    return kind.copy(attribute->slot(object));
  }
};

struct Setter {
  const AttributeTable* table;
  const Attribute* attribute;

  void operator()(const py::object& self, const py::object& value) const {
    yade::Serializable& object = objectOf(self);
    const Guard guard = guardOf(*table, object);
    attribute->kind->set(attribute->slot(object), value);
    if (attribute->has(yade::Attr::triggerPostLoad)) object.callPostLoad();
  }
};

}  // namespace

void AttributeTable::define(const py::object& pyClass) const {
  const py::object property = py::import("builtins").attr("property");
  const py::default_call_policies policies;
  for (const Attribute& one : attributes) {
    if (one.has(yade::Attr::hidden)) continue;
    // YADE's documentation and inspector read the flags from the docstring.
    const std::string doc =
        std::string(one.doc) + " :yattrflags:`" + std::to_string(one.flags) + "` ";
    const py::object getter = py::make_function(
        Getter{this, &one}, policies, boost::mpl::vector<py::object, const py::object&>());
    py::object setter;
    if (!one.has(yade::Attr::readonly))
      setter = py::make_function(Setter{this, &one}, policies,
                                 boost::mpl::vector<void, const py::object&, const py::object&>());
    py::setattr(pyClass, one.name, property(getter, setter, py::object(), doc));
  }
}

bool AttributeTable::set(yade::Serializable& object, const std::string& name,
                         const py::object& value) const {
  const Guard guard = guardOf(*this, object);
  for (const Attribute& one : attributes) {
    if (name != one.name) continue;
    one.kind->set(one.slot(object), value);
    return true;
  }
  return false;
}

py::dict AttributeTable::values(const yade::Serializable& object) const {
  const Guard guard = guardOf(*this, object);
  py::dict result;
  for (const Attribute& one : attributes)
    if (!one.has(yade::Attr::hidden)) result[one.name] = one.kind->copy(one.slot(object));
  return result;
}

void AttributeTable::archive(AnyArchive& archive, yade::Serializable& object) const {
  for (const Attribute& one : attributes)
    if (!one.has(yade::Attr::noSave)) one.kind->archive(archive, one.name, one.slot(object));
}

template const ValueKind& kindOf<bool>();
template const ValueKind& kindOf<int>();
template const ValueKind& kindOf<long>();
template const ValueKind& kindOf<double>();
template const ValueKind& kindOf<std::string>();
template const ValueKind& kindOf<yade::Vector3r>();

}  // namespace yadefrag
