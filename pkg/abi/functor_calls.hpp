#pragma once
// Second base class, at byte 80, of the functors: the table through which dispatchers call them. It
// has a slot for every number of arguments from one to seven; only one slot is used.

#include <stdexcept>

#include "abi/body.hpp"

namespace yade {

class Interaction;

// For functors with one shape, whose call has four arguments.
template <class... Arguments>
class OneShapeCalls {
 public:
  virtual ~OneShapeCalls() = default;
  virtual string checkOrder() const { return {}; }

 private:
  virtual void go1() { unused(); }
  virtual void go2() { unused(); }
  virtual void go3() { unused(); }

 public:
  virtual void go(Arguments...) { unused(); }

 private:
  virtual void go5() { unused(); }
  virtual void go6() { unused(); }
  virtual void go7() { unused(); }
  virtual void goReverse1() { unused(); }
  virtual void goReverse2() { unused(); }
  virtual void goReverse3() { unused(); }
  virtual void goReverse4() { unused(); }
  virtual void goReverse5() { unused(); }
  virtual void goReverse6() { unused(); }
  virtual void goReverse7() { unused(); }
  [[noreturn]] static void unused() { throw std::logic_error("a functor's unused slot is called"); }
};

struct GLViewInfo;

using BoundCalls =
    OneShapeCalls<const shared_ptr<Shape>&, shared_ptr<Bound>&, const Se3r&, const Body*>;
using GlShapeCalls =
    OneShapeCalls<const shared_ptr<Shape>&, const shared_ptr<State>&, bool, const GLViewInfo&>;

class GeomCalls {
 public:
  virtual ~GeomCalls() = default;
  virtual string checkOrder() const { return {}; }

 private:
  virtual bool go1() { unused(); }
  virtual bool go2() { unused(); }
  virtual bool go3() { unused(); }
  virtual bool go4() { unused(); }
  virtual bool go5() { unused(); }
  virtual bool go6() { unused(); }

 public:
  virtual bool go(const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State&, const State&,
                  const Vector3r&, const bool&, const shared_ptr<Interaction>&) {
    unused();
  }

 private:
  virtual bool goReverse1() { unused(); }
  virtual bool goReverse2() { unused(); }
  virtual bool goReverse3() { unused(); }
  virtual bool goReverse4() { unused(); }
  virtual bool goReverse5() { unused(); }
  virtual bool goReverse6() { unused(); }

 public:
  virtual bool goReverse(const shared_ptr<Shape>&, const shared_ptr<Shape>&, const State&,
                         const State&, const Vector3r&, const bool&,
                         const shared_ptr<Interaction>&) {
    unused();
  }

 private:
  [[noreturn]] static void unused() { throw std::logic_error("a functor's unused slot is called"); }
};

// For functors whose call has three arguments.
template <class Result, class... Arguments>
class ThreeArgumentCalls {
 public:
  virtual ~ThreeArgumentCalls() = default;
  virtual string checkOrder() const { return {}; }

 private:
  virtual Result go1() { unused(); }
  virtual Result go2() { unused(); }

 public:
  virtual Result go(Arguments...) { unused(); }

 private:
  virtual Result go4() { unused(); }
  virtual Result go5() { unused(); }
  virtual Result go6() { unused(); }
  virtual Result go7() { unused(); }
  virtual Result goReverse1() { unused(); }
  virtual Result goReverse2() { unused(); }
  virtual Result goReverse3() { unused(); }
  virtual Result goReverse4() { unused(); }
  virtual Result goReverse5() { unused(); }
  virtual Result goReverse6() { unused(); }
  virtual Result goReverse7() { unused(); }
  [[noreturn]] static void unused() { throw std::logic_error("a functor's unused slot is called"); }
};

class IGeom;
class IPhys;

using PhysCalls = ThreeArgumentCalls<void, const shared_ptr<Material>&, const shared_ptr<Material>&,
                                     const shared_ptr<Interaction>&>;
using LawCalls = ThreeArgumentCalls<bool, shared_ptr<IGeom>&, shared_ptr<IPhys>&, Interaction*>;

}  // namespace yade
