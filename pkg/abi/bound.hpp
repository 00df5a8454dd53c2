#pragma once
// Bounding boxes of bodies; their corners are in the unsheared coordinates of a periodic cell.

#include "abi/indexable.hpp"
#include "abi/serializable.hpp"

namespace yade {

class Bound : public Serializable, public Indexable {
 public:
  int lastUpdateIter;
  Vector3r refPos;
  Real sweepLength;
  Vector3r color;
  Vector3r min;
  Vector3r max;

  Bound() = delete;
  ~Bound() override;

 protected:
  int& modifyClassIndex() override;

 public:
  const int& getClassIndex() const override;
  const int& getBaseClassIndex(int depth) const override;
  const int& getMaxCurrentlyUsedClassIndexOfKin() const override;

 protected:
  void incrementMaxCurrentlyUsedClassIndexOfKin() override;
};

class Aabb : public Bound {
 public:
  Aabb();
  ~Aabb() override;
  const int& getClassIndex() const override;
  const int& getBaseClassIndex(int depth) const override;

 protected:
  int& modifyClassIndex() override;
};

}  // namespace yade
