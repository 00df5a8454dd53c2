#pragma once
// Types used by all YADE classes declared here, and their root classes. The virtual functions are
// declared but not defined here: vtables and type information are those of YADE's libraries.

#include <Eigen/Dense>
#include <boost/enable_shared_from_this.hpp>
#include <boost/python.hpp>
#include <boost/serialization/access.hpp>
#include <boost/shared_ptr.hpp>

#include <string>
#include <vector>

static_assert(EIGEN_MAX_ALIGN_BYTES == 0,
              "compile with EIGEN_DONT_VECTORIZE and EIGEN_DONT_ALIGN, as YADE's package is");

// The functions that YADE's macros define in each class that Python and the factory know.
#define YADEFRAG_YADE_FUNCTIONS                                        \
  string getBaseClassName(unsigned int i = 0) const override;          \
  int getBaseClassNumber() const override;                             \
  string getClassName() const override;                                \
  void pySetAttr(const string& key, const py::object& value) override; \
  py::dict pyDict() const override;                                    \
  void callPostLoad() override;                                        \
  void pyRegisterClass(py::object scope) override

// Those of the topmost class of a kind on which YADE dispatches, in the order of its own table.
#define YADEFRAG_INDEX_FUNCTIONS                                  \
 protected:                                                       \
  int& modifyClassIndex() override;                               \
                                                                  \
 public:                                                          \
  const int& getClassIndex() const override;                      \
  const int& getBaseClassIndex(int depth) const override;         \
  const int& getMaxCurrentlyUsedClassIndexOfKin() const override; \
                                                                  \
 protected:                                                       \
  void incrementMaxCurrentlyUsedClassIndexOfKin() override

namespace yade {

namespace py = boost::python;
using boost::shared_ptr;
using std::string;
using std::vector;

using Real = double;
using Vector3r = Eigen::Matrix<Real, 3, 1>;
using Vector3i = Eigen::Matrix<int, 3, 1>;
using Matrix3r = Eigen::Matrix<Real, 3, 3>;
using Quaternionr = Eigen::Quaternion<Real>;
using mask_t = int;

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

// Second base class, at byte 24, of the classes on which YADE dispatches. The order of the virtual
// functions is that of YADE's table. Classes that override them also have them in their own table,
// in another order: modifyClassIndex first, incrementMaxCurrentlyUsedClassIndexOfKin last.
class Indexable {
 protected:
  virtual void incrementMaxCurrentlyUsedClassIndexOfKin() = 0;
  virtual int& modifyClassIndex() = 0;

 public:
  virtual ~Indexable() = default;
  virtual const int& getClassIndex() const = 0;
  virtual const int& getBaseClassIndex(int depth) const = 0;
  virtual const int& getMaxCurrentlyUsedClassIndexOfKin() const = 0;
};

}  // namespace yade
