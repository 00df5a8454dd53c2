#pragma once
// Position, orientation and motion of a body.

#include <mutex>

#include "abi/indexable.hpp"
#include "abi/serializable.hpp"

namespace yade {

template <class Scalar>
class Se3 {
 public:
  Eigen::Matrix<Scalar, 3, 1> position;
  Eigen::Quaternion<Scalar> orientation;
};
using Se3r = Se3<Real>;

class State : public Serializable, public Indexable {
 public:
  enum { DOF_NONE = 0, DOF_X = 1, DOF_Y = 2, DOF_Z = 4, DOF_RX = 8, DOF_RY = 16, DOF_RZ = 32 };
  static const unsigned DOF_ALL = 63;

  Vector3r& pos;
  Quaternionr& ori;
  std::mutex updateMutex;
  Se3r se3;
  Vector3r vel;
  Real mass;
  Vector3r angVel;
  Vector3r angMom;
  Vector3r inertia;
  Vector3r refPos;
  Quaternionr refOri;
  unsigned blockedDOFs;
  bool isDamped;
  Real densityScaling;

  State();
  ~State() override;

 protected:
  int& modifyClassIndex() override;

 public:
  const int& getClassIndex() const override;
  const int& getBaseClassIndex(int depth) const override;
  const int& getMaxCurrentlyUsedClassIndexOfKin() const override;

 protected:
  void incrementMaxCurrentlyUsedClassIndexOfKin() override;
};

}  // namespace yade
