#pragma once
// Spheres that roll along a boundary. YADE has a contact for each piece, and a new contact begins
// without a tangential force, which a sphere that moves from one piece to the next would lose. That
// force is transferred here. It is divided if a sphere touches two pieces at once, e.g. at the
// junctions of a slightly concave boundary, where one contact decreases as the other one increases.

#include <vector>

#include "abi/yade.hpp"
#include "entries/entry_bodies.hpp"
#include "publish/any_archive.hpp"

namespace yadefrag {

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

}  // namespace yadefrag
