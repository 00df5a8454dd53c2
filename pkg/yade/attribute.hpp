#pragma once
// Attributes of the published classes: name in Python and archives, type and place in the object.
// What depends on the type only is compiled once for each of some ten types (ValueKind): with
// functions for each class, attribute and archive the compiler took a minute.

#include <bit>
#include <cassert>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "yade/any_archive.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

class StepLock;

/// What a type of attributes can do; `slot` is a value of this type.
struct ValueKind {
  yade::py::object (*copy)(const void* slot);
  /// To the value itself, so that `o.v[0] = 1` changes the object; null: Python gets a copy.
  yade::py::object (*reference)(void* slot, const yade::py::object& owner);
  /// Throws Python's TypeError if the object has no such value.
  void (*set)(void* slot, const yade::py::object& value);
  void (*archive)(AnyArchive& archive, const char* name, void* slot);
  /// Null unless it is a number.
  double (*number)(const void* slot);
};

/// Defined for the types in use, by yade/value_kind.hpp.
template <class Value>
const ValueKind& kindOf();

struct Attribute {
  const char* name;
  const char* doc;
  int flags;  // flags of yade::Attr
  const ValueKind* kind;
  std::ptrdiff_t offset;  // bytes from the begin of the object

  [[nodiscard]] bool has(int flag) const { return (flags & flag) != 0; }
  [[nodiscard]] void* slot(yade::Serializable& object) const {
    return reinterpret_cast<char*>(&object) + offset;
  }
  [[nodiscard]] const void* slot(const yade::Serializable& object) const {
    return reinterpret_cast<const char*>(&object) + offset;
  }
};

using Attributes = std::vector<Attribute>;

// In the ABI of pkg/yade a pointer to a member is the member's offset, and Serializable is at the
// begin of each class of YADE.
template <class Class, class Value>
Attribute attribute(const char* name, Value Class::*member, const char* doc, int flags = 0) {
  static_assert(sizeof member == sizeof(std::ptrdiff_t));
  assert(static_cast<yade::Serializable*>(reinterpret_cast<Class*>(64)) ==
         reinterpret_cast<yade::Serializable*>(64));
  return {name, doc, flags, &kindOf<Value>(), std::bit_cast<std::ptrdiff_t>(member)};
}
/// A member of a member.
template <class Class, class Part, class Value>
Attribute attribute(const char* name, Part Class::*part, Value Part::*member, const char* doc,
                    int flags = 0) {
  const std::ptrdiff_t inPart = std::bit_cast<std::ptrdiff_t>(member);
  return {name, doc, flags, &kindOf<Value>(), std::bit_cast<std::ptrdiff_t>(part) + inPart};
}
template <class... Each>
Attributes attributeList(const Each&... each) {
  return {each...};
}

inline Attributes joined(std::initializer_list<Attributes> lists) {
  Attributes all;
  for (const Attributes& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

/// What a class has: its attributes, and the lock that is held while they are read, set or saved
/// (null: none).
struct AttributeTable {
  Attributes attributes;
  StepLock* (*lockOf)(const yade::Serializable& object);

  /// Adds the attributes to a Python class; hidden ones are left out, as in YADE.
  void define(const yade::py::object& pyClass) const;
  /// Sets an attribute by name; false: there is none of this name.
  bool set(yade::Serializable& object, const std::string& name,
           const yade::py::object& value) const;
  [[nodiscard]] yade::py::dict values(const yade::Serializable& object) const;
  void archive(AnyArchive& archive, yade::Serializable& object) const;
};

}  // namespace yadefrag
