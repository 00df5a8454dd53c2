#include <concepts>

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
void copyFriction(const Physics& from, Physics& to) {
  to.kn = from.kn, to.ks = from.ks;
  to.normalForce = from.normalForce, to.shearForce = from.shearForce;
  to.tangensOfFrictionAngle = from.tangensOfFrictionAngle;
  if constexpr (kHasDissipation<Physics>) to.frictDissip = from.frictDissip;
}

void copyPhysics(const yade::FrictPhys& from, yade::FrictPhys& to) { copyFriction(from, to); }

// What comes with features and versions of YADE.
template <class Physics>
void copyMore(const Physics& from, Physics& to) {
  if constexpr (requires { to.beta; }) to.beta = from.beta;
  if constexpr (requires { to.initD; }) to.initD = from.initD, to.isBroken = from.isBroken;
}

void copyPhysics(const yade::MindlinPhys& from, yade::MindlinPhys& to) {
  copyFriction(from, to);
  to.kr = from.kr, to.ktw = from.ktw;
  to.kno = from.kno, to.kso = from.kso, to.maxBendPl = from.maxBendPl;
  to.normalViscous = from.normalViscous, to.shearViscous = from.shearViscous;
  to.shearElastic = from.shearElastic, to.usElastic = from.usElastic, to.usTotal = from.usTotal;
  to.momentBend = from.momentBend, to.momentTwist = from.momentTwist;
  to.radius = from.radius, to.adhesionForce = from.adhesionForce;
  to.isAdhesive = from.isAdhesive, to.isSliding = from.isSliding;
  to.betan = from.betan, to.betas = from.betas;
  to.prevU = from.prevU, to.Fs = from.Fs;
  copyMore(from, to);
}

// Bytes from the geometry of one contact to that of the next.
template <class Phys>
constexpr std::size_t kContactBytes = Block::wholeLines(sizeof(yade::ScGeom) + sizeof(Phys));

// A YADE that its user built may have more members, by its options: nothing is moved there.
template <class Phys>
consteval bool areAllMembersKnown() {
  std::size_t bytes = kHasDissipation<Phys> ? 112 : 104;
  if constexpr (std::derived_from<Phys, yade::MindlinPhys>) {
    bytes += 288;
    if constexpr (requires(Phys physics) { physics.beta; }) bytes += 8;
    if constexpr (requires(Phys physics) { physics.initD; }) bytes += 16;
  }
  return sizeof(yade::ScGeom) == 192 && sizeof(Phys) == bytes;
}

template <class Phys>
void moveTogether(yade::Scene& scene) {
  const OthersWait others(scene);
  BlockFiller filler;
  for (const auto& contact : *scene.interactions) {
    if (!isMovable<yade::ScGeom>(contact->geom) || !isMovable<Phys>(contact->phys)) continue;
    filler.begin(kContactBytes<Phys>);
    moveInto<yade::ScGeom>(filler, contact->geom, copyGeometry);
    moveInto<Phys>(filler, contact->phys,
                   [](const Phys& from, Phys& to) { copyPhysics(from, to); });
  }
}

}  // namespace

template <class Phys>
void ContactMemory::endStep(yade::Scene& scene) {
  if (!areAllMembersKnown<Phys>()) return;
  const auto visitAll = [&](const auto& visit) {
    for (const auto& contact : *scene.interactions)
      if (contact->isReal()) visit(contact->geom.get());
  };
  if (geometries_.endStep(kContactBytes<Phys>, visitAll)) moveTogether<Phys>(scene);
}

template void ContactMemory::endStep<yade::FrictPhys>(yade::Scene& scene);
template void ContactMemory::endStep<yade::MindlinPhys>(yade::Scene& scene);

}  // namespace yadefrag
