#pragma once
// The class index by which YADE's dispatchers know shapes and materials.

#include "abi/yade.hpp"

namespace yadefrag {

/// Between a new class and its base: `class Self : public Published<Self, Indexed<Self, Base>,
/// Base>`. A dispatcher that knows no functor for Self goes on to Base.
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

}  // namespace yadefrag
