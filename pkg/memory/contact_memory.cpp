#include "loop/exposed.hpp"
#include "memory/block_memory.hpp"

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

// YADE from 2026.1 on.
template <class Physics>
constexpr bool kHasDissipation = requires(Physics physics) {
  physics.frictDissip;
};

template <class Physics>
void copyPhysics(const Physics& from, Physics& to) {
  to.kn = from.kn, to.ks = from.ks;
  to.normalForce = from.normalForce, to.shearForce = from.shearForce;
  to.tangensOfFrictionAngle = from.tangensOfFrictionAngle;
  if constexpr (kHasDissipation<Physics>) to.frictDissip = from.frictDissip;
}

// Bytes from the geometry of one contact to that of the next.
constexpr std::size_t kContactBytes =
    Block::wholeLines(sizeof(yade::ScGeom) + sizeof(yade::FrictPhys));

// A YADE that its user built may have more members, by its options: nothing is moved there.
constexpr bool kAreAllMembersKnown =
    sizeof(yade::ScGeom) == 192 &&
    sizeof(yade::FrictPhys) == (kHasDissipation<yade::FrictPhys> ? 112 : 104);

void moveTogether(yade::Scene& scene) {
  const OthersWait others(scene);
  BlockFiller filler;
  for (const auto& contact : *scene.interactions) {
    if (!isMovable<yade::ScGeom>(contact->geom) || !isMovable<yade::FrictPhys>(contact->phys)) {
      continue;
    }
    filler.begin(kContactBytes);
    moveInto<yade::ScGeom>(filler, contact->geom, copyGeometry);
    moveInto<yade::FrictPhys>(filler, contact->phys, copyPhysics<yade::FrictPhys>);
  }
}

}  // namespace

void ContactMemory::endStep(yade::Scene& scene) {
  if (!kAreAllMembersKnown) return;
  const auto visitAll = [&](const auto& visit) {
    for (const auto& contact : *scene.interactions)
      if (contact->isReal()) visit(contact->geom.get());
  };
  if (geometries_.endStep(kContactBytes, visitAll)) moveTogether(scene);
}

}  // namespace yadefrag
