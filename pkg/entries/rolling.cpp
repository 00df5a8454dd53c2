#include "entries/rolling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "abi/helpers.hpp"
#include "core/tolerances/contact.hpp"

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

}  // namespace yadefrag
