#pragma once
// One attribute of a published class: its name in Python and archives, and its storage.

#include <boost/mpl/vector.hpp>
#include <mutex>
#include <type_traits>
#include <variant>

#include "abi/yade.hpp"

namespace yadefrag {

template <class Class, class Value>
struct Attribute {
  const char* name;
  Value Class::*member;
  const char* doc;
  int flags;  // flags of yade::Attr

  constexpr bool has(int flag) const { return (flags & flag) != 0; }
};

template <class Class, class Value>
constexpr Attribute<Class, Value> attribute(const char* name, Value Class::*member, const char* doc,
                                            int flags = 0) {
  return {name, member, doc, flags};
}

// Vectors and matrices are passed to Python as references, so that `o.v[0] = 1` changes the object.
template <class Value>
inline constexpr bool kByReference = std::is_base_of_v<Eigen::MatrixBase<Value>, Value>;

/// Prevents a step of another thread while attributes are read or set. A class that steps in its
/// own thread has a `betweenSteps()` that can be locked; for all others nothing happens.
template <class Self>
auto guardOf(const Self& self) {
  if constexpr (requires { self.betweenSteps(); })
    return std::unique_lock(self.betweenSteps());
  else
    return std::monostate();
}

// Both take Self, which is registered in Python, since the member may belong to an unregistered
// base.
template <class Self, class Class, class Value>
yade::py::object attributeGetter(Value Class::*member) {
  namespace py = yade::py;
  if constexpr (kByReference<Value>) {
    return py::make_function([member](Self& self) -> Value& { return self.*member; },
                             py::return_internal_reference<>(),
                             boost::mpl::vector<Value&, Self&>());
  } else {
    return py::make_function(
        [member](Self& self) -> Value {
          [[maybe_unused]] const auto guard = guardOf(self);
          return self.*member;
        },
        py::default_call_policies(), boost::mpl::vector<Value, Self&>());
  }
}

template <class Self, class Value, class Class>
yade::py::object attributeSetter(const Attribute<Class, Value>& attr) {
  namespace py = yade::py;
  const auto member = attr.member;
  const bool notify = attr.has(yade::Attr::triggerPostLoad);
  return py::make_function(
      [member, notify](Self& self, const Value& value) {
        [[maybe_unused]] const auto guard = guardOf(self);
        self.*member = value;
        if (notify) self.callPostLoad();
      },
      py::default_call_policies(), boost::mpl::vector<void, Self&, const Value&>());
}

// Adds the attribute to a Python class; hidden attributes are left out, as in YADE.
template <class Self, class PyClass, class Class, class Value>
void defineAttribute(PyClass& pyClass, const Attribute<Class, Value>& attr) {
  if (attr.has(yade::Attr::hidden)) return;
  // YADE's documentation and inspector read the flags from the docstring.
  const std::string doc =
      std::string(attr.doc) + " :yattrflags:`" + std::to_string(attr.flags) + "` ";
  const auto getter = attributeGetter<Self>(attr.member);
  if (attr.has(yade::Attr::readonly)) {
    pyClass.add_property(attr.name, getter, doc.c_str());
  } else {
    pyClass.add_property(attr.name, getter, attributeSetter<Self>(attr), doc.c_str());
  }
}

}  // namespace yadefrag
