#pragma once
// The shape of a surface entry's body: one piece of a boundary, material on the left.

#include <tuple>
#include <vector>

#include <boost/serialization/nvp.hpp>
#include <boost/serialization/vector.hpp>

#include "abi/yade.hpp"
#include "core/errors.hpp"
#include "publish/indexed.hpp"
#include "publish/published.hpp"
#include "surface/contact_surface.hpp"
#include "surface/disc_contact.hpp"

namespace yadefrag {

/// Coordinates are those of the world: the body's position and orientation do not define the
/// position of the piece. FESolver updates all members.
class SurfaceSegment final
    : public Published<SurfaceSegment, Indexed<SurfaceSegment, yade::Shape>, yade::Shape> {
 public:
  static constexpr const char* kName = "SurfaceSegment";
  static constexpr const char* kDoc =
      "One piece of the boundary of a finite-element body, in the plane z = const: a straight "
      "segment or a Bezier arc, with the material on its left. Its coordinates are those of the "
      "world; the position of its body does not matter. FESolver makes these and moves them; one "
      "created by a script is a rigid wall.";

  using Vector3r = yade::Vector3r;
  Vector3r start = Vector3r::Zero(), end = Vector3r::Zero(), middle = Vector3r::Zero();
  Vector3r before = Vector3r::Zero(), after = Vector3r::Zero();
  int kind = static_cast<int>(Piece::kSegment);
  double halo = 0;
  int entry = -1, component = -1;
  bool selfContact = true;
  /// A contact with a sphere that a crack changed (crack_contacts.hpp). Its law has the overlap
  /// share · (overlap − tolerated).
  struct Changed {
    yade::Body::id_t sphere;
    double share, tolerated;  // 1, m
  };
  std::vector<Changed> changed;  // usually empty

  [[nodiscard]] bool isArc() const { return kind == static_cast<int>(Piece::kArc); }
  [[nodiscard]] BoundaryPiece piece() const {
    const auto flat = [](const Vector3r& v) { return Vec2{v[0], v[1]}; };
    return {flat(start), flat(middle), flat(end), flat(before), flat(after), isArc()};
  }

  /// Null for a contact that no crack has changed.
  [[nodiscard]] Changed* changedBy(yade::Body::id_t sphere);
  /// A share of 1 without a tolerated overlap removes the entry.
  void setChanged(const Changed& one);
  /// Of an overlap of `depth` (m; 0: none) with a sphere, the part that its law has. What is
  /// tolerated decreases with the overlap.
  double depthForLaw(yade::Body::id_t sphere, double depth);

  static constexpr auto attributes();
  template <class Archive>
  void archiveMore(Archive& archive);
};

template <class Archive>
void SurfaceSegment::archiveMore(Archive& archive) {
  std::vector<int> spheres;
  std::vector<double> values;
  for (const Changed& one : changed) {
    spheres.push_back(one.sphere);
    values.insert(values.end(), {one.share, one.tolerated});
  }
  archive& boost::serialization::make_nvp("changedIds", spheres);
  archive& boost::serialization::make_nvp("changedContacts", values);
  if constexpr (Archive::is_loading::value) {
    if (values.size() != 2 * spheres.size())
      throw InputError(
          "The saved state of a SurfaceSegment is damaged (its contacts with spheres are invalid); "
          "load another save.");
    changed.clear();
    for (std::size_t i = 0; i < spheres.size(); ++i)
      changed.push_back({spheres[i], values[2 * i], values[2 * i + 1]});
  }
}

constexpr auto SurfaceSegment::attributes() {
  using C = SurfaceSegment;
  return std::tuple(
      attribute("start", &C::start, "Begin of the piece (m)."),
      attribute("end", &C::end, "End of the piece (m)."),
      attribute("middle", &C::middle,
                "Of an arc: its central node (m), at which the tangents of its two ends "
                "meet."),
      attribute("before", &C::before,
                "Direction (unit vector) of the previous piece at `start`; zero: "
                "there is none, `start` is a free end."),
      attribute("after", &C::after,
                "Direction (unit vector) of the next piece at `end`; zero: "
                "there is none."),
      attribute("kind", &C::kind,
                "0: a segment between two nodes, 1 and 2: its first and second half, 3: an arc "
                "around a node."),
      attribute(
          "halo", &C::halo,
          "Length (m) by which the bound is larger than the piece, on every side: the distance "
          "that the piece may move before the next search."),
      attribute("entry", &C::entry, "Number of the surface entry in its FESolver; -1: none."),
      attribute("component", &C::component, "Number of the finite-element body; -1: none."),
      attribute("selfContact", &C::selfContact,
                "True if this piece may touch other pieces of its own body."));
}

}  // namespace yadefrag
