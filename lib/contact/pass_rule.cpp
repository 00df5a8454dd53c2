#include "contact/pass_rule.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances/contact.hpp"
#include "surface/piece_geometry.hpp"

namespace yadefrag {

namespace {

/// True if the boundary turns left by more than an angle (given as its sine) at the begin of the
/// entry.
bool isSharp(const ContactSurfaces& surfaces, const PieceGeometry& geometry, EntryId entry,
             double sine) {
  const EntryId former = surfaces.prev[entry.value];
  if (surfaces.piece[entry.value] == Piece::kArc || surfaces.piece[former.value] == Piece::kArc)
    return false;
  const Vec2 in = geometry.tangent(former, 1);
  const Vec2 out = geometry.tangent(entry, 0);
  const double lengths = norm(in) * norm(out);
  if (dot(in, out) < tolerance::kFolded * lengths) return true;
  return cross(in, out) > 0 && (dot(in, out) < 0 || cross(in, out) > sine * lengths);
}

}  // namespace

void PassRule::update(const ContactSurfaces& surfaces, std::span<const Vec2> reference,
                      const ContactSettings& settings, bool anyRigid) {
  passes_ = settings.passes;
  anyRigid_ = anyRigid;
  if (passes_ == 2 && !anyRigid) return;
  // With two passes only corners of rigid boundaries are determined.
  const double sine = passes_ == 2 ? tolerance::kLineCorner : settings.constants.faceAngle;
  const PieceGeometry geometry(surfaces, reference);
  const std::size_t count = surfaces.entries();
  std::uint32_t loops = 0;
  for (const std::uint32_t loop : surfaces.loop) loops = std::max(loops, loop + 1);
  fineness_.assign(loops, 0);
  sharp_.resize(count);
  std::vector<double> pieces(loops, 0);
  for (std::size_t e = 0; e < count; ++e) {
    const EntryId entry(e);
    fineness_[surfaces.loop[e]] += geometry.length(entry);
    pieces[surfaces.loop[e]] += 1;
    sharp_[e] = isSharp(surfaces, geometry, entry, sine) ? 1 : 0;
  }
  // With a tolerance for rounding: equal meshes at different positions are equally fine.
  for (std::uint32_t l = 0; l < loops; ++l)
    if (pieces[l] > 0)
      fineness_[l] = std::round(std::log2(fineness_[l] / pieces[l]) * tolerance::kFinenessSteps);
}

}  // namespace yadefrag
