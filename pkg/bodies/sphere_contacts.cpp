#include "bodies/sphere_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/tolerances/contact.hpp"
#include "core/tolerances/spheres.hpp"
#include "yade/helpers.hpp"

namespace yadefrag {

namespace {

/// Two pieces with these unit normals are one face for a sphere that rolls.
bool areOneFace(Vec2 a, Vec2 b) {
  return dot(a, b) > 0 && std::abs(cross(a, b)) < tolerance::Contact().faceAngle;
}

using yade::Vector3r;

bool areNeighbours(const ContactSurfaces& surfaces, EntryId a, EntryId b) {
  return surfaces.next[a.value] == b || surfaces.next[b.value] == a;
}

}  // namespace

struct RollingSpheres::Contact {
  yade::Interaction* contact;
  const yade::ScGeom* geom;
  yade::NormShearPhys* phys;
  yade::Body::id_t sphere, piece;
  EntryId entry;
  double shear, normal;  // as in Held
  Vec2 direction;

  /// Ratio of tangential force to pressure: the available friction is at least this.
  [[nodiscard]] double ratio() const { return normal > 0 ? std::abs(shear) / normal : 0; }
  void addForce(yade::Scene& scene, double by, bool fromNextStep) const;
};

/// As in YADE's laws; the opposite force acts on the sphere.
void RollingSpheres::Contact::addForce(yade::Scene& scene, double by, bool fromNextStep) const {
  const Vector3r force = by * inSpace(-rightOf(direction));
  phys->shearForce += force;
  if (fromNextStep) return;
  for (const auto& [id, sign] : {std::pair(contact->getId1(), -1.), {contact->getId2(), 1.}}) {
    const Vector3r part = sign * force;
    scene.forces.addForce(id, part);
    const Vector3r& place = bodyAt(scene, id)->state->se3.position;
    scene.forces.addTorque(id, (geom->contactPoint - place).cross(part));
  }
}

/// Contacts of all spheres with pieces, by sphere, then piece.
RollingSpheres::Contacts RollingSpheres::contactsOf(const EntryBodies& bodies) {
  Contacts found;
  for (std::size_t e = 0; e < bodies.ids().size(); ++e) {
    if (!bodies.hasBody(EntryId(e))) continue;
    for (const auto& [other, contact] : bodies.body(EntryId(e)).intrs) {
      if (!contact->isReal()) continue;
      const auto* geom = dynamic_cast<const yade::ScGeom*>(contact->geom.get());
      auto* phys = dynamic_cast<yade::NormShearPhys*>(contact->phys.get());
      if (!geom || !phys) continue;
      const Vec2 direction = inPlane(geom->normal);
      found.push_back({contact.get(), geom, phys, other, bodies.ids()[e], EntryId(e),
                       cross(direction, inPlane(phys->shearForce)), phys->normalForce.norm(),
                       direction});
    }
  }
  std::ranges::sort(found, {}, [](const Contact& one) { return std::pair(one.sphere, one.piece); });
  return found;
}

/// Adds the tangential force of a contact that ended in this step to the sphere's contact with the
/// adjacent piece.
void RollingSpheres::carryEnded(Contacts& contacts, const yade::Scene& scene,
                                const EntryBodies& bodies, const ContactSurfaces& surfaces) const {
  const auto pairOf = [](const auto& one) { return std::pair(one.sphere, one.piece); };
  for (const Held& held : held_) {
    const EntryId entry = bodies.entryOf(held.piece);
    if (held.shear == 0 || entry == EntryId::none()) continue;
    if (std::ranges::binary_search(contacts, pairOf(held), {}, pairOf)) continue;
    const auto begin = std::ranges::lower_bound(contacts, held.sphere, {}, &Contact::sphere);
    const auto end = std::ranges::upper_bound(contacts, held.sphere, {}, &Contact::sphere);
    const auto heir = std::find_if(begin, end, [&](const Contact& one) {
      return areNeighbours(surfaces, one.entry, entry) && areOneFace(one.direction, held.direction);
    });
    if (heir == end) continue;
    const double ratio = std::max({heir->ratio(), std::abs(held.shear) / held.normal,
                                   smallerFriction(scene, heir->sphere, heir->piece)});
    const double most = ratio * heir->normal;
    heir->shear = std::clamp(heir->shear + held.shear, -most, most);
  }
}

bool RollingSpheres::carry(yade::Scene& scene, const EntryBodies& bodies,
                           const ContactSurfaces& surfaces, bool fromNextStep) {
  Contacts contacts = contactsOf(bodies);
  std::vector<double> former;
  for (const Contact& one : contacts) former.push_back(one.shear);
  carryEnded(contacts, scene, bodies, surfaces);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    for (std::size_t k = i + 1; k < contacts.size() && contacts[k].sphere == contacts[i].sphere;
         ++k) {
      Contact &a = contacts[i], &b = contacts[k];
      const double normal = a.normal + b.normal;
      if (!(normal > 0) || !areNeighbours(surfaces, a.entry, b.entry) ||
          !areOneFace(a.direction, b.direction))
        continue;
      const double shear = a.shear + b.shear;
      a.shear = shear * a.normal / normal, b.shear = shear - a.shear;
    }
  bool any = false;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (contacts[i].shear == former[i]) continue;
    contacts[i].addForce(scene, contacts[i].shear - former[i], fromNextStep);
    any = !fromNextStep;
  }
  store(contacts);
  return any;
}

void RollingSpheres::store(const Contacts& contacts) {
  held_.clear();
  for (const Contact& one : contacts)
    if (one.normal > 0)
      held_.push_back({one.sphere, one.piece, one.shear, one.normal, one.direction});
}

void RollingSpheres::archive(AnyArchive& archive) {
  archive.rows("rollingIds", "rollingForces", held_,
               "of FESolver is damaged (its contacts with spheres are invalid)",
               [](Held& one, const auto& each) {
                 each(one.sphere), each(one.piece), each(one.shear), each(one.normal);
                 each(one.direction.x), each(one.direction.y);
               });
}

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
