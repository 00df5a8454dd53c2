#pragma once
// Checks a declaration of pkg/abi: writes an attribute through Python and reads it through the
// declaration.

#include <string>
#include <utility>

#include "abi/support_check.hpp"
#include "abi/yade.hpp"

namespace yadefrag {

// Throws UnsupportedYade: "Body.groupMask is not where ...".
[[noreturn]] void throwMisplaced(const std::string& typeAndMember);

inline bool otherThan(bool value) { return !value; }
inline std::string otherThan(const std::string& value) { return value + "_"; }
template <class Value>
Value otherThan(const Value& value) {  // numbers, vectors, matrices
  return value * 2;
}
template <class Type>
boost::shared_ptr<Type> otherThan(const boost::shared_ptr<Type>& value) {
  return value;
}

// A scratch object of a class of yade.wrapper, accessible from Python and through the declaration.
template <class Type>
class Scratch {
 public:
  explicit Scratch(const char* pythonClass)
      : name_(pythonClass),
        object_(yade::py::import("yade.wrapper").attr(pythonClass)()),
        seen_(yade::py::extract<boost::shared_ptr<Type>>(object_)()) {}

  // For an object that YADE stores inside another one.
  Scratch(const char* name, boost::shared_ptr<Type> seen)
      : name_(name), object_(), seen_(std::move(seen)) {}

  Type& operator*() const { return *seen_; }
  Type* operator->() const { return seen_.get(); }
  const boost::shared_ptr<Type>& pointer() const { return seen_; }
  const yade::py::object& object() const { return object_; }

  // Uses YADE's attribute list, which also contains read-only and hidden attributes.
  template <class Slot, class Value>
  void check(const char* attr, const Slot& slot, const Value& value) const {
    writeTwice(attr, slot, Slot(value), [&](const yade::py::object& written) {
      yade::py::dict one;
      one[attr] = written;
      seen_->pyUpdateAttrs(one);
    });
  }

  // Uses Python's assignment, for properties that are not in that list.
  template <class Slot, class Value>
  void checkProperty(const char* attr, const Slot& slot, const Value& value) const {
    writeTwice(attr, slot, Slot(value),
               [&](const yade::py::object& written) { yade::py::setattr(object_, attr, written); });
  }

  void refuse(const char* member, bool wrong) const {
    if (wrong) throwMisplaced(std::string(name_) + "." + member);
  }

 private:
  // Two values, because uninitialised memory may still contain one of them from an earlier check.
  template <class Slot, class Write>
  void writeTwice(const char* attr, const Slot& slot, const Slot& wanted, Write&& write) const {
    for (const Slot& value : {otherThan(wanted), wanted}) {
      write(yade::py::object(value));
      refuse(attr, !(slot == value));
    }
  }

  const char* name_;
  yade::py::object object_;
  boost::shared_ptr<Type> seen_;
};

}  // namespace yadefrag
