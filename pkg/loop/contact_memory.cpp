#include <cstring>

#include "loop/block_memory.hpp"
#include "yade/exposed.hpp"

namespace yadefrag {

namespace {

void copyGeometry(const yade::ScGeom& from, yade::ScGeom& to) {
  to.normal = from.normal;
  to.contactPoint = from.contactPoint;
  to.refR1 = from.refR1, to.refR2 = from.refR2;
  to.*exposed(TwistAxis{}) = from.*exposed(TwistAxis{});
  to.*exposed(OrthonormalAxis{}) = from.*exposed(OrthonormalAxis{});
  to.penetrationDepth = from.penetrationDepth;
  to.shearInc = from.shearInc;
}

void copyGeometry(const yade::ScGeom6D& from, yade::ScGeom6D& to) {
  copyGeometry(static_cast<const yade::ScGeom&>(from), static_cast<yade::ScGeom&>(to));
  to.initialOrientation1 = from.initialOrientation1;
  to.initialOrientation2 = from.initialOrientation2;
  to.twistCreep = from.twistCreep;
  to.twist = from.twist, to.bending = from.bending;
}

// From the stiffness on all these classes consist of numbers.
template <class Phys>
void copyPhysics(const Phys& from, Phys& to) {
  const auto begin = reinterpret_cast<const char*>(&from.kn) - reinterpret_cast<const char*>(&from);
  std::memcpy(reinterpret_cast<char*>(&to) + begin, reinterpret_cast<const char*>(&from) + begin,
              sizeof(Phys) - static_cast<std::size_t>(begin));
}

// Bytes from the geometry of one contact to that of the next.
template <class Geom, class Phys>
constexpr std::size_t kContactBytes = Block::wholeLines(sizeof(Geom) + sizeof(Phys));

// A YADE that its user built may have more members, by its options: nothing is moved there. With
// all that are known: dissipation (2026.1), PARTIALSAT.
template <class Phys>
constexpr std::size_t kMostBytes = 112;
template <>
constexpr std::size_t kMostBytes<yade::MindlinPhys> = 424;
template <>
constexpr std::size_t kMostBytes<yade::ViscElPhys> = 168;
template <>
constexpr std::size_t kMostBytes<yade::CohFrictPhys> = 264;
template <class Geom, class Phys>
constexpr bool kAreAllMembersKnown = sizeof(yade::ScGeom) == 192 && sizeof(yade::ScGeom6D) == 320 &&
                                     sizeof(Phys) <= kMostBytes<Phys>;

template <class Geom, class Phys>
void moveTogether(yade::Scene& scene) {
  const OthersWait others(scene);
  BlockFiller filler;
  for (const auto& contact : *scene.interactions) {
    if (!isMovable<Geom>(contact->geom) || !isMovable<Phys>(contact->phys)) continue;
    filler.begin(kContactBytes<Geom, Phys>);
    moveInto<Geom>(filler, contact->geom,
                   [](const Geom& from, Geom& to) { copyGeometry(from, to); });
    moveInto<Phys>(filler, contact->phys, copyPhysics<Phys>);
  }
}

}  // namespace

template <class Geom, class Phys>
void ContactMemory::endStep(yade::Scene& scene) {
  if (!kAreAllMembersKnown<Geom, Phys>) return;
  const auto visitAll = [&](const auto& visit) {
    for (const auto& contact : *scene.interactions)
      if (contact->isReal()) visit(contact->geom.get());
  };
  if (geometries_.endStep(kContactBytes<Geom, Phys>, visitAll)) {
    moveTogether<Geom, Phys>(scene);
    returnFreed();
  }
}

template void ContactMemory::endStep<yade::ScGeom, yade::FrictPhys>(yade::Scene& scene);
template void ContactMemory::endStep<yade::ScGeom, yade::MindlinPhys>(yade::Scene& scene);
template void ContactMemory::endStep<yade::ScGeom, yade::ViscElPhys>(yade::Scene& scene);
template void ContactMemory::endStep<yade::ScGeom6D, yade::CohFrictPhys>(yade::Scene& scene);

}  // namespace yadefrag
