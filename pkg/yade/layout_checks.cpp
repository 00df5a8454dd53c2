// This file compiles only if every declaration in pkg/yade has the layout of YADE's own class.

#include <cstddef>

#include "yade/layout.hpp"
#include "yade/yade.hpp"

// These classes have virtual functions. GCC lays them out as YADE's build did, and can measure
// their offsets.
#pragma GCC diagnostic ignored "-Winvalid-offsetof"

namespace yade {

// NOLINTBEGIN(bugprone-macro-parentheses,readability-function-size): types; a line for each member.
#define CHECK_SIZE(Type, bytes) static_assert(sizeof(Type) == bytes, #Type);
// Not of members that are bytes here, nor of references, which have no address.
#define CHECK_MEMBER(Type, member, bytes)                              \
  []<class T>(T*) {                                                    \
    if constexpr (requires { &T::member; })                            \
      static_assert(offsetof(T, member) == bytes, #Type "::" #member); \
  }(static_cast<Type*>(nullptr));

// A friend of the classes whose inline functions read private members.
struct LayoutProbe {
  static void check() { YADEFRAG_LAYOUT(CHECK_SIZE, CHECK_MEMBER) }
};
// NOLINTEND(bugprone-macro-parentheses,readability-function-size)

// The offsets of State's two reference members cannot be measured: the two are between the base and
// the mutex, in this order.
static_assert(offsetof(State, updateMutex) == 24 + sizeof(Indexable) + 2 * sizeof(void*));
static_assert(sizeof(Se3r) == 56 && offsetof(Se3r, orientation) == 24);

// ScGeom's two reference members are between these two.
static_assert(offsetof(ScGeom, penetrationDepth) ==
              yadefrag::layoutBytes("ScGeom", "orthonormal_axis") + sizeof(Vector3r) +
                  2 * sizeof(void*));

// BoundDispatcher's members begin after YADE's template.
static_assert(sizeof(Dispatcher1D<BoundFunctor>) == 152);

// The table of functors, and that of swapped arguments, begin after Dispatcher.
static_assert(offsetof(IPhysDispatcher, functors) == sizeof(Dispatcher) + 2 * sizeof(vector<int>));

}  // namespace yade
