#pragma once
// Spheres that roll along a boundary. YADE has a contact for each piece, and a new contact begins
// without a tangential force, which a sphere that moves from one piece to the next would lose. That
// force is transferred here. It is divided if a sphere touches two pieces at once, e.g. at the
// junctions of a slightly concave boundary, where one contact decreases as the other one increases.

#include <vector>

#include <boost/serialization/nvp.hpp>
#include <boost/serialization/vector.hpp>

#include "abi/yade.hpp"
#include "core/errors.hpp"
#include "entries/entry_bodies.hpp"

namespace yadefrag {

class RollingSpheres {
 public:
  /// Must be called after contacts have got their forces in this step, and before these are
  /// collected. Returns true if any force of this step has changed. `fromNextStep`: the spheres
  /// have moved by the forces of this step, which must stay the same on both sides of each contact.
  bool carry(yade::Scene& scene, const EntryBodies& bodies, const ContactSurfaces& surfaces,
             bool fromNextStep);
  void clear() { held_.clear(); }

  template <class Archive>
  void archive(Archive& archive);

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

template <class Archive>
void RollingSpheres::archive(Archive& archive) {
  std::vector<int> ids;
  std::vector<double> values;
  for (const Held& held : held_) {
    ids.insert(ids.end(), {held.sphere, held.piece});
    values.insert(values.end(), {held.shear, held.normal, held.direction.x, held.direction.y});
  }
  archive& boost::serialization::make_nvp("rollingIds", ids);
  archive& boost::serialization::make_nvp("rollingForces", values);
  if constexpr (Archive::is_loading::value) {
    if (values.size() != 2 * ids.size() || ids.size() % 2 != 0)
      throw InputError(
          "The saved state of FESolver is damaged (its contacts with spheres are invalid); load "
          "another save.");
    held_.clear();
    for (std::size_t i = 0; 2 * i < ids.size(); ++i) {
      const double* value = values.data() + 4 * i;
      held_.push_back({ids[2 * i], ids[2 * i + 1], value[0], value[1], {value[2], value[3]}});
    }
  }
}

}  // namespace yadefrag
