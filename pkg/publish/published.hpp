#pragma once
// Registration of a class with YADE (names, Python, archives), written once for all classes.

#include <boost/python/raw_function.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/shared_ptr.hpp>

#include <stdexcept>
#include <tuple>
#include <utility>

#include "publish/attribute.hpp"

namespace yadefrag {

namespace py = yade::py;

// `new Self(args, **kw)`, as Python constructs YADE's own classes.
template <class Self>
boost::shared_ptr<Self> makeFromPython(py::tuple args, py::dict kw) {
  boost::shared_ptr<Self> made(new Self);
  made->pyHandleCustomCtorArgs(args, kw);
  if (py::len(args) > 0) {
    throw std::runtime_error(
        std::string(Self::kName) + " takes keyword arguments only, besides " +
        "what its base takes; not understood: " + std::to_string(py::len(args)) + " more.");
  }
  if (py::len(kw) > 0) made->pyUpdateAttrs(kw);
  return made;
}

// class Self final : public Published<Self, Base, YadeBase>
//   kName, kDoc          name of the class in Python, and its docstring
//   attributes()         static constexpr: a tuple of attribute(...); a Base may define it
//   postLoad(Self&)      optional, public: called after attributes were changed or loaded
//   archiveMore(archive) optional, public, template: saves and loads state that is no attribute
//   pyExtra(pyClass)     optional, public, static template: more definitions for Python
//   betweenSteps()       optional, public: a lock held while attributes are read, set or saved
// Base may be a class that YADE does not register; YadeBase is its nearest registered base.
template <class Self, class Base, class YadeBase = Base>
class Published : public Base {
 public:
  using Base::Base;

  std::string getClassName() const override { return Self::kName; }
  int getBaseClassNumber() const override { return 1; }
  std::string getBaseClassName(unsigned int i = 0) const override {
    return i == 0 ? YadeBase::getClassName() : std::string();
  }

  void pySetAttr(const std::string& key, const py::object& value) override {
    [[maybe_unused]] const auto guard = guardOf(self());
    const auto setIfNamed = [&](const auto& attr) {
      if (key != attr.name) return false;
      auto& slot = self().*attr.member;
      slot = py::extract<std::remove_cvref_t<decltype(slot)>>(value)();
      return true;
    };
    const bool found = std::apply([&](const auto&... attr) { return (setIfNamed(attr) || ...); },
                                  Self::attributes());
    if (!found) Base::pySetAttr(key, value);  // the last base throws YADE's AttributeError
  }

  py::dict pyDict() const override {
    [[maybe_unused]] const auto guard = guardOf(self());
    py::dict result;
    forEach([&](const auto& attr) {
      if (!attr.has(yade::Attr::hidden)) result[attr.name] = self().*attr.member;
    });
    result.update(this->pyDictCustom());
    result.update(Base::pyDict());
    return result;
  }

  void callPostLoad() override {
    Base::callPostLoad();
    ownPostLoad();
  }

  void pyRegisterClass(py::object scope) override {
    const py::scope inside(scope);
    py::class_<Self, boost::shared_ptr<Self>, py::bases<YadeBase>, boost::noncopyable> pyClass(
        Self::kName, Self::kDoc, py::no_init);
    const py::object init = py::make_constructor(&makeFromPython<Self>);
    pyClass.def("__init__", py::raw_function(
                                [init](py::tuple args, const py::dict& kw) {
                                  const py::object instance = args[0];
                                  return init(instance, py::tuple(args.slice(1, py::_)), kw);
                                },
                                1));
    forEach([&](const auto& attr) { defineAttribute<Self>(pyClass, attr); });
    if constexpr (requires { Self::pyExtra(pyClass); }) Self::pyExtra(pyClass);
  }

 private:
  friend class boost::serialization::access;

  Self& self() { return static_cast<Self&>(*this); }
  const Self& self() const { return static_cast<const Self&>(*this); }

  template <class Function>
  static void forEach(Function&& function) {
    std::apply([&](const auto&... attr) { (function(attr), ...); }, Self::attributes());
  }

  void ownPostLoad() {
    if constexpr (requires(Self & s) { s.postLoad(s); }) self().postLoad(self());
  }

  template <class Archive>
  void serialize(Archive& archive, unsigned /*version*/) {
    [[maybe_unused]] const auto guard = guardOf(self());
    using boost::serialization::make_nvp;
    static const std::string baseName = YadeBase::getClassName();
    archive& make_nvp(baseName.c_str(), boost::serialization::base_object<YadeBase>(self()));
    forEach([&](const auto& attr) {
      if (!attr.has(yade::Attr::noSave)) archive& make_nvp(attr.name, self().*attr.member);
    });
    if constexpr (requires { self().archiveMore(archive); }) self().archiveMore(archive);
    if constexpr (Archive::is_loading::value) ownPostLoad();
  }
};

}  // namespace yadefrag
