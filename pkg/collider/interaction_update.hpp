#pragma once
// Updates YADE's interactions to the result of the search.

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "collider/sphere_reach.hpp"
#include "core/csr.hpp"
#include "core/tolerances/threads.hpp"
#include "search/partner_table.hpp"
#include "search/sorted_list.hpp"
#include "yade/yade.hpp"

namespace yadefrag {

class InteractionUpdate {
 public:
  using MayCollide = std::function<bool(const yade::Body*, const yade::Body*)>;
  using IsNear = std::function<bool(yade::Body::id_t, yade::Body::id_t)>;

  /// Erases interactions that are neither near nor real, and creates new ones in the order of the
  /// Lebesgue curve: neighbours in space are then neighbours in memory, which determines the time
  /// of the interaction loop. `boxes`: by body id. One pass over the existing interactions replaces
  /// a look-up per pair.
  void apply(yade::Scene& scene, const Neighbours& near, std::span<const Box> boxes,
             const MayCollide& mayCollide, int threads);

  /// Replaces `apply` if only the boxes of `changed` (ascending) are new; `near` are the pairs with
  /// at least one of these bodies. Only their interactions are checked, and those kept because of a
  /// contact: for these `isNear(id1, id2)`, id1 < id2, is called.
  void applyChanged(yade::Scene& scene, const Neighbours& near, std::span<const Box> boxes,
                    std::span<const BoxId> changed, const MayCollide& mayCollide,
                    const IsNear& isNear);

  /// Number of interactions created elsewhere, minus those erased, since the last call of either
  /// function.
  [[nodiscard]] long madeByOthers(const yade::Scene& scene) const {
    return static_cast<long>(scene.interactions->size()) - static_cast<long>(sizeAfter_);
  }

 private:
  using Bodies = std::vector<yade::shared_ptr<yade::Body>>;

  static bool mayErase(const yade::Interaction& is, const Bodies& bodies);
  /// What one thread finds in its part of YADE's list.
  struct alignas(tolerance::kThreadsApart) Part {
    std::vector<yade::Interaction*> gone;  // to be erased, in the order of the list
    std::vector<std::pair<yade::Body::id_t, yade::Body::id_t>> held;
  };
  void markKnown(yade::InteractionContainer& interactions, const Neighbours& near,
                 const Bodies& bodies, int threads);
  void markOne(yade::Interaction& is, const Neighbours& near, const Bodies& bodies, Part& part);
  void eraseGone(yade::Scene& scene);
  [[nodiscard]] std::vector<CodedSlot> unknown(const Neighbours& near,
                                               std::span<const Box> boxes) const;
  void makeNew(yade::Scene& scene, const Neighbours& near, std::span<const Box> boxes,
               const MayCollide& mayCollide);
  void checkBodies(yade::Scene& scene, const Neighbours& near, std::span<const BoxId> changed);
  void checkHeld(yade::Scene& scene, const IsNear& isNear);

  PartnerTable partners_;
  std::vector<char> known_;          // by index: true if this interaction exists
  std::vector<Part> parts_;          // by thread
  Csr<std::uint32_t> nearOf_;        // indices of pairs, by index in `changed`
  std::vector<std::uint32_t> mark_;  // by body id, while one body is checked: index of pair + 1
  std::vector<yade::Interaction*> gone_;
  /// In contact although their boxes do not overlap: erased when the contact ends.
  std::vector<std::pair<yade::Body::id_t, yade::Body::id_t>> held_;
  std::size_t sizeAfter_ = 0;
};

}  // namespace yadefrag
