#pragma once
// The periodic cell.

#include <cmath>

#include "abi/serializable.hpp"

namespace yade {

class Cell : public Serializable {
  Matrix3r _invTrsf;
  Matrix3r _trsfInc;
  Matrix3r _vGradTimesPrevH;
  Vector3r _size;
  Vector3r _cos;
  Vector3r _refSize;
  bool _hasShear;
  Matrix3r _shearTrsf;
  Matrix3r _unshearTrsf;
  double _glShearTrsfMatrix[16];

 public:
  enum { HOMO_NONE = 0, HOMO_POS = 1, HOMO_VEL = 2, HOMO_VEL_2ND = 3 };

  Matrix3r trsf;
  Matrix3r refHSize;
  Matrix3r hSize;
  Matrix3r prevHSize;
  Matrix3r velGrad;
  Matrix3r nextVelGrad;
  Matrix3r prevVelGrad;
  int homoDeform;
  bool velGradChanged;
  bool flipFlippable;

  Cell();
  ~Cell() override;

  const Vector3r& getSize() const { return _size; }
  const Vector3r& getCos() const { return _cos; }
  bool hasShear() const { return _hasShear; }
  const Matrix3r& getShearTrsf() const { return _shearTrsf; }
  const Matrix3r& getUnshearTrsf() const { return _unshearTrsf; }
  Vector3r shearPt(const Vector3r& pt) const { return _shearTrsf * pt; }
  Vector3r unshearPt(const Vector3r& pt) const { return _unshearTrsf * pt; }
  Vector3r intrShiftPos(const Vector3i& cellDist) const { return hSize * cellDist.cast<Real>(); }

  static Real wrapNum(const Real& x, const Real& size) {
    int period;
    return wrapNum(x, size, period);
  }
  static Real wrapNum(const Real& x, const Real& size, int& period) {
    const Real cells = x / size;
    const Real whole = std::floor(cells);
    period = static_cast<int>(whole);
    return (cells - whole) * size;
  }

 private:
  friend struct LayoutProbe;
};

}  // namespace yade
