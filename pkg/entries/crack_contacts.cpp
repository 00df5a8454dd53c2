#include "entries/crack_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "abi/helpers.hpp"
#include "core/tolerances/spheres.hpp"

namespace yadefrag {
namespace {

using BodyId = yade::Body::id_t;

/// Contact of a sphere with one piece, as a spring.
struct Spring {
  EntryId entry;
  Vec2 normal;
  double share, depth;  // of the stiffness; m, compression
};
using Springs = std::vector<Spring>;

std::optional<DiscContact> contactOf(const BoundaryPiece& piece, const yade::Body& sphere) {
  const auto& at = sphere.state->se3.position;
  return discContact(piece, {at[0], at[1]}, static_cast<const yade::Sphere&>(*sphere.shape).radius);
}

/// Two pieces that share an overlap are one spring, compressed by the whole of it.
Spring springOf(EntryId entry, const DiscContact& touch) {
  return {entry, touch.normal, touch.penetration / touch.unshared, touch.unshared};
}

/// True only if the two cannot touch.
bool isFar(const BoundaryPiece& piece, const yade::Body& sphere) {
  const auto& at = sphere.state->se3.position;
  const double radius = static_cast<const yade::Sphere&>(*sphere.shape).radius;
  double reach = norm(piece.end - piece.start);
  if (piece.isArc) reach += norm(piece.middle - piece.start);
  return norm(Vec2{at[0], at[1]} - piece.start) > radius + reach;
}

SurfaceSegment& shapeOf(const EntryBodies& bodies, EntryId entry) {
  return static_cast<SurfaceSegment&>(*bodies.body(entry).shape);
}

/// The springs of all spheres near the boundary, touching or not, with the pieces before `last`, as
/// these were before the step. Those of fragments that this step has removed leave with them.
std::map<BodyId, Springs> springsBefore(const yade::Scene& scene, const ContactSurfaces& surfaces,
                                        const EntryBodies& bodies, std::size_t last) {
  std::map<BodyId, Springs> found;
  for (std::size_t e = 0; e < last; ++e) {
    if (!bodies.hasBody(EntryId(e))) continue;
    SurfaceSegment& piece = shapeOf(bodies, EntryId(e));
    for (const auto& [id, interaction] : bodies.body(EntryId(e)).intrs) {
      const yade::Body* const other = bodyAt(scene, id);
      if (!other || !dynamic_cast<const yade::Sphere*>(other->shape.get())) continue;
      Springs& springs = found[id];
      const auto touch = contactOf(piece.piece(), *other);
      if (!touch || surfaces.isGone(EntryId(e))) continue;
      const SurfaceSegment::Changed* const known = piece.changedBy(id);
      Spring spring = springOf(EntryId(e), *touch);
      if (known) {
        spring.depth -= known->tolerated / spring.share;
        spring.share *= known->share;
      }
      spring.depth = std::max(spring.depth, 0.);
      springs.push_back(spring);
    }
  }
  return found;
}

/// The spring of a piece that no longer touches the sphere passes to the new contact with the most
/// similar normal: the two are parts of one face.
void passOn(Springs& before, const Springs& after) {
  const auto in = [](const Springs& all, EntryId entry) {
    return std::ranges::find(all, entry, &Spring::entry) != all.end();
  };
  Springs heirs;
  for (const Spring& one : before) {
    if (in(after, one.entry)) continue;
    const Spring* best = nullptr;
    for (const Spring& other : after)
      if (!in(before, other.entry) && !in(heirs, other.entry) &&
          dot(other.normal, one.normal) > (best ? dot(best->normal, one.normal) : 0))
        best = &other;
    if (best) heirs.push_back({best->entry, best->normal, one.share, one.depth});
  }
  before.insert(before.end(), heirs.begin(), heirs.end());
}

/// Pieces near a sphere have an interaction with it, also without contact. By entry.
std::vector<EntryId> piecesNear(const yade::Body& sphere, const EntryBodies& bodies) {
  std::vector<EntryId> near;
  for (const auto& [other, contact] : sphere.intrs) {
    const EntryId entry = bodies.entryOf(other);
    if (entry != EntryId::none() && bodies.hasBody(entry)) near.push_back(entry);
  }
  std::ranges::sort(near, {}, &EntryId::value);
  return near;
}

/// The touching piece with the fewest junctions between it and `entry`; none() if all are far.
EntryId nearestAlong(const ContactSurfaces& surfaces, EntryId entry,
                     const std::set<std::uint32_t>& touching) {
  EntryId ahead = entry, behind = entry;
  for (int junctions = 1; junctions <= tolerance::kJunctionsToContact; ++junctions) {
    ahead = surfaces.next[ahead.value], behind = surfaces.prev[behind.value];
    for (const EntryId one : {behind, ahead})
      if (touching.contains(one.value)) return one;
  }
  return EntryId::none();
}

}  // namespace

void CrackContacts::change(const yade::Scene& scene, const World& world, const EntryBodies& bodies,
                           std::size_t first, double dt) {
  std::map<BodyId, Springs> known = springsBefore(scene, world.surfaces, bodies, first);
  if (known.empty()) return;
  const Nodes& nodes = world.model.nodes;
  std::vector<Vec2> former(nodes.size());
  for (std::size_t i = 0; i < former.size(); ++i)
    former[i] = nodes.position[i] - dt * nodes.velocity[i];
  const BoundaryPieces pieces(world.surfaces, former);
  std::set<int> spheres(spheres_.begin(), spheres_.end());
  for (auto& [id, before] : known) {
    const yade::Body& sphere = *bodyAt(scene, id);
    Springs after;
    const auto evaluate = [&](EntryId entry) {
      if (!bodies.hasBody(entry) || world.surfaces.isGone(entry)) return;
      if (isFar(pieces.alone(entry), sphere)) return;
      const auto touch = contactOf(pieces.whole(entry), sphere);
      if (touch) after.push_back(springOf(entry, *touch));
    };
    for (const EntryId entry : piecesNear(sphere, bodies))
      if (entry.value < first) evaluate(entry);
    for (std::size_t e = first; e < world.surfaces.entries(); ++e) evaluate(EntryId(e));
    passOn(before, after);
    for (const Spring& one : after) {
      const auto same = std::ranges::find(before, one.entry, &Spring::entry);
      const bool isNew = same == before.end();
      const double share = isNew ? 1 : same->share / one.share;
      const double tolerated = one.share * std::max(one.depth - (isNew ? 0 : same->depth), 0.);
      const auto isSmall = [](double part) { return std::abs(part) <= tolerance::kSameOverlap; };
      if (isSmall(share - 1) && isSmall(tolerated / one.depth) &&
          !shapeOf(bodies, one.entry).changedBy(id))
        continue;
      const SurfaceSegment::Changed now{id, share, tolerated};
      shapeOf(bodies, one.entry).setChanged(now);
      spheres.insert(id);
      pieces_.push_back(bodies.ids()[one.entry.value]);
    }
  }
  spheres_.assign(spheres.begin(), spheres.end());
}

void CrackContacts::follow(const yade::Scene& scene, const World& world,
                           const EntryBodies& bodies) {
  if (spheres_.empty()) return;
  std::vector<int> spheres;
  std::set<std::pair<int, BodyId>> kept;  // piece and sphere
  for (const BodyId id : spheres_) {
    const yade::Body* const sphere = bodyAt(scene, id);
    if (!sphere || !dynamic_cast<const yade::Sphere*>(sphere->shape.get())) continue;
    const std::vector<EntryId> near = piecesNear(*sphere, bodies);
    // A piece whose overlap is tolerated has no contact, which must not begin while the overlap is
    // there, also after the fragment that the sphere has touched was removed.
    const auto isTolerated = [&](EntryId entry) {
      SurfaceSegment& piece = shapeOf(bodies, entry);
      return piece.changedBy(id) && contactOf(piece.piece(), *sphere);
    };
    std::set<std::uint32_t> touching;
    for (const EntryId entry : near)
      if (sphere->intrs.at(bodies.ids()[entry.value])->isReal() || isTolerated(entry))
        touching.insert(entry.value);
    for (const EntryId entry : near) {
      const EntryId from =
          touching.contains(entry.value) ? entry : nearestAlong(world.surfaces, entry, touching);
      if (from == EntryId::none()) continue;
      const SurfaceSegment::Changed* const values = shapeOf(bodies, from).changedBy(id);
      if (!values) continue;
      if (from != entry) shapeOf(bodies, entry).setChanged(SurfaceSegment::Changed(*values));
      kept.emplace(bodies.ids()[entry.value], id);
    }
    if (!touching.empty()) spheres.push_back(id);
  }
  for (const BodyId piece : std::set<int>(pieces_.begin(), pieces_.end())) {
    const EntryId entry = bodies.entryOf(piece);
    if (entry == EntryId::none() || !bodies.hasBody(entry)) continue;
    std::erase_if(shapeOf(bodies, entry).changed, [&](const SurfaceSegment::Changed& one) {
      return !kept.contains({piece, one.sphere});
    });
  }
  spheres_.swap(spheres);
  pieces_.clear();
  for (const auto& [piece, sphere] : kept)
    if (pieces_.empty() || pieces_.back() != piece) pieces_.push_back(piece);
}

}  // namespace yadefrag
