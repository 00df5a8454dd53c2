#pragma once
// Contacts of spheres with a boundary, from piece to piece and where it cracks.

#include <vector>

#include "bodies/entry_bodies.hpp"
#include "yade/any_archive.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

// --- Spheres that roll along a boundary. YADE has a contact for each piece, and a new contact
// begins without a tangential force, which a sphere that moves from one piece to the next would
// lose. That force is transferred here. It is divided if a sphere touches two pieces at once, e.g.
// at the junctions of a slightly concave boundary, where one contact decreases as the other one
// increases.

class RollingSpheres {
 public:
  /// Must be called after contacts have got their forces in this step, and before these are
  /// collected. Returns true if any force of this step has changed. `fromNextStep`: the spheres
  /// have moved by the forces of this step, which must stay the same on both sides of each contact.
  bool carry(yade::Scene& scene, const EntryBodies& bodies, const ContactSurfaces& surfaces,
             bool fromNextStep);
  void clear() { held_.clear(); }

  void archive(AnyArchive& archive);

 private:
  /// A contact at the end of the last step.
  struct Held {
    yade::Body::id_t sphere, piece;
    double shear;   // N, positive to the left of the normal
    double normal;  // N, pressure
    Vec2 direction;
  };
  struct Contact;
  using Contacts = std::vector<Contact>;

  static Contacts contactsOf(const EntryBodies& bodies);
  void carryEnded(Contacts& contacts, const yade::Scene& scene, const EntryBodies& bodies,
                  const ContactSurfaces& surfaces) const;
  void store(const Contacts& contacts);

  std::vector<Held> held_;  // by sphere, then piece
};

// --- Contacts of spheres with a boundary that cracks. The contacts of one sphere with the pieces
// of a boundary act as one spring. When a crack opens below the sphere, corners and faces appear
// that it overlaps at once, and pieces that shared an overlap at a junction have all of it each. If
// YADE's law had these overlaps, springs would be compressed although no force has done that work:
// a sphere that breaks a wall gained up to 1.7 times its energy. Therefore each contact keeps its
// force and its energy through the crack: by a share of the stiffness, and by an overlap that is
// tolerated, i.e. gets no force (SurfaceSegment::Changed). A new face has no force, and tolerates
// its overlap. Rejected: tolerated overlaps only. Pieces that shared a spring would have half of
// its energy.

class CrackContacts {
 public:
  /// Compares the pieces before and after the cracks of a step of `dt` (s), both at the positions
  /// before the step, so that no motion counts. Must be called when EntryBodies::follow has added
  /// the entries from `first` on, and before EntryBodies::update.
  void change(const yade::Scene& scene, const World& world, const EntryBodies& bodies,
              std::size_t first, double dt);
  /// Call it in every step. Pieces near such a sphere that do not touch it get the values of the
  /// nearest piece along the boundary that does, so that they continue its contact if the sphere
  /// moves on to them. When a sphere has separated from all pieces, its values are removed.
  void follow(const yade::Scene& scene, const World& world, const EntryBodies& bodies);

  void archive(AnyArchive& archive) {
    archive.item("crackSpheres", spheres_);
    archive.item("crackPieces", pieces_);
  }

 private:
  /// Spheres above cracks, ascending, and the pieces (bodies) that may have values for them.
  std::vector<int> spheres_, pieces_;
};

}  // namespace yadefrag
