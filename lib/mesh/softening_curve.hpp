#pragma once
// How the traction of a crack decreases with its opening: a polygon.

#include <span>
#include <string_view>
#include <vector>

namespace yadefrag {

struct SofteningPoint {
  double opening;   ///< of the critical opening δc
  double traction;  ///< of the strength σc
  friend bool operator==(const SofteningPoint&, const SofteningPoint&) = default;
};

/// From (0, 1) to (1, 0); openings increase, tractions do not. Its area determines δc: the polygon
/// has the area Gc for any shape.
class SofteningCurve {
 public:
  /// The straight line.
  SofteningCurve() : SofteningCurve(std::vector<SofteningPoint>{{0, 1}, {1, 0}}) {}
  /// Throws InputError if the points are not as described above.
  explicit SofteningCurve(std::vector<SofteningPoint> points);

  [[nodiscard]] static bool isValid(std::span<const SofteningPoint> points);

  [[nodiscard]] const std::vector<SofteningPoint>& points() const { return points_; }
  /// (m) δc, for σc (Pa) and Gc (J/m²): 2Gc/σc for the straight line.
  [[nodiscard]] double criticalOpening(double strength, double energy) const {
    return energy / area_ / strength;
  }
  /// (m) The opening over which a line of the curve's steepest slope falls from σc to 0: δc for the
  /// straight line.
  [[nodiscard]] double steepOpening(double strength, double energy) const {
    return criticalOpening(strength, energy) / steepest_;
  }
  /// Area below that line over Gc, at most 1.
  [[nodiscard]] double steepPart() const { return steepPart_; }

  friend bool operator==(const SofteningCurve& a, const SofteningCurve& b) {
    return a.points_ == b.points_;
  }

 private:
  std::vector<SofteningPoint> points_;
  double area_ = 0;      // of δcσc
  double steepest_ = 0;  // slope, of σc/δc
  double steepPart_ = 1;
};

/// The curve of this name; throws InputError for an unknown name.
///   linear        σ/σc = 1 − w/δc
///   bilinear, petersson
///                 knee at w = 0.8 Gc/σc, σ = σc/3; δc = 3.6 Gc/σc (Petersson 1981, Lund Institute
///                 of Technology, TVBM-1006)
///   ceb-fip-2010  knee at w = Gc/σc, σ = σc/5; δc = 5 Gc/σc (fib Model Code 2010, 5.1.8.2)
///   exponential   σ/σc = exp(−wσc/Gc), up to w = 7 Gc/σc
///   reinhardt     σ/σc = (1 + (3w/δc)³) exp(−6.93w/δc) − (1 + 3³) exp(−6.93) w/δc, δc =
///                 5.14 Gc/σc (Cornelissen, Hordijk and Reinhardt 1986, Heron 31, 45)
/// The last two are polygons that differ from the formula by less than 0.001 σc.
[[nodiscard]] SofteningCurve softeningNamed(std::string_view name);

/// All names, for messages.
[[nodiscard]] std::span<const std::string_view> softeningNames();

}  // namespace yadefrag
