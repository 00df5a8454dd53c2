#pragma once
// The two root classes of YADE. Their virtual functions are declared but not defined here: vtables
// and type information are those of YADE's libraries.

#include <boost/enable_shared_from_this.hpp>
#include <boost/serialization/access.hpp>

#include "abi/basics.hpp"

namespace yade {

namespace Attr {
enum flags { noSave = 1, readonly = 2, triggerPostLoad = 4, hidden = 8, noResize = 16 };
}

class Factorable : public boost::enable_shared_from_this<Factorable> {
 public:
  Factorable() = default;
  Factorable(const Factorable&) = delete;
  Factorable& operator=(const Factorable&) = delete;
  virtual ~Factorable();
  virtual string getBaseClassName(unsigned int i = 0) const;
  virtual int getBaseClassNumber() const;
  virtual string getClassName() const;
};

class Serializable : public Factorable {
 public:
  Serializable() = default;
  ~Serializable() override;
  string getBaseClassName(unsigned int i = 0) const override;
  int getBaseClassNumber() const override;
  string getClassName() const override;
  virtual void pySetAttr(const string& key, const py::object& value);
  virtual py::dict pyDict() const;
  virtual py::dict pyDictCustom() const;
  virtual void callPostLoad();
  virtual void checkPyClassRegistersItself(const string& thisClassName) const;
  virtual void pyRegisterClass(py::object scope);
  virtual void pyHandleCustomCtorArgs(py::tuple& args, py::dict& kw);
  void pyUpdateAttrs(const py::dict& attributes);
};

}  // namespace yade
