#pragma once
// The class index by which YADE's dispatchers identify shapes and materials.

#include "abi/yade.hpp"

namespace yadefrag {

/// Between a new class and its base: `class Self : public Published<Self, Indexed<Self, Base>,
/// Base>`. A dispatcher without a functor for Self uses that of Base.
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
