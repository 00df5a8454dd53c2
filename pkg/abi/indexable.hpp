#pragma once
// Second base class, at byte 24, of the classes on which YADE dispatches. The order of the virtual
// functions is that of YADE's table. Classes that override them also have them in their own table,
// in another order: modifyClassIndex first, incrementMaxCurrentlyUsedClassIndexOfKin last.

namespace yade {

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
