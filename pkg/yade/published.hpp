#pragma once
// Registration of a class with YADE (names, Python, archives), written once for all classes.

#include <boost/python/raw_function.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/shared_ptr.hpp>

#include <mutex>
#include <stdexcept>

#include "yade/any_archive.hpp"
#include "yade/attribute.hpp"
#include "yade/step_lock.hpp"

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

/// The class index by which YADE's dispatchers identify shapes and materials. Between a new class
/// and its base: `class Self : public Published<Self, Indexed<Self, Base>, Base>`. A dispatcher
/// without a functor for Self uses that of Base.
template <class Self, class Base>
class Indexed : public Base {
 public:
  const int& getClassIndex() const override { return index(); }
  const int& getBaseClassIndex(int depth) const override {
    return depth == 1 ? Base::getClassIndex() : Base::getBaseClassIndex(depth - 1);
  }

 protected:
  Indexed() {
    if (index() != -1) return;
    index() = this->getMaxCurrentlyUsedClassIndexOfKin() + 1;
    this->incrementMaxCurrentlyUsedClassIndexOfKin();
  }
  int& modifyClassIndex() override { return index(); }

 private:
  static int& index() {
    static int index = -1;
    return index;
  }
};

// class Self final : public Published<Self, Base, YadeBase>
//   kName, kDoc          name of the class in Python, and its docstring
//   attributes()         static: attributeList(attribute(...), ...); a Base may define it
//   postLoad(Self&)      optional, public: called after attributes were changed or loaded
//   archiveMore(archive) optional, public: saves and loads state that is no attribute
//   pyExtra(pyClass)     optional, public, static: more definitions for Python
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
    // The last base throws YADE's AttributeError.
    if (!table().set(*this, key, value)) Base::pySetAttr(key, value);
  }

  py::dict pyDict() const override {
    py::dict result = table().values(*this);
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
    table().define(pyClass);
    if constexpr (requires { Self::pyExtra(pyClass); }) Self::pyExtra(pyClass);
  }

 private:
  friend class boost::serialization::access;

  Self& self() { return static_cast<Self&>(*this); }
  const Self& self() const { return static_cast<const Self&>(*this); }

  static const AttributeTable& table() {
    // Never freed: Python's functions refer to it.
    static const auto* const all = new AttributeTable{Self::attributes(), &lockOf};
    return *all;
  }

  static StepLock* lockOf([[maybe_unused]] const yade::Serializable& object) {
    if constexpr (requires(const Self& s) { s.betweenSteps(); })
      return &static_cast<const Self&>(object).betweenSteps();
    else
      return nullptr;
  }

  void ownPostLoad() {
    if constexpr (requires(Self & s) { s.postLoad(s); }) self().postLoad(self());
  }

  template <class Archive>
  void serialize(Archive& archive, unsigned /*version*/) {
    StepLock* const lock = lockOf(*this);
    const auto guard = lock == nullptr ? std::unique_lock<StepLock>() : std::unique_lock(*lock);
    static const std::string baseName = YadeBase::getClassName();
    archive& boost::serialization::make_nvp(baseName.c_str(),
                                            boost::serialization::base_object<YadeBase>(self()));
    ArchiveOf<Archive> any(archive);
    table().archive(any, *this);
    if constexpr (requires { self().archiveMore(any); }) self().archiveMore(any);
    if constexpr (Archive::is_loading::value) ownPostLoad();
  }
};

}  // namespace yadefrag
