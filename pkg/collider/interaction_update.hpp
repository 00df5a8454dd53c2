#pragma once
// Brings YADE's interactions into line with what the search has found.

#include <functional>
#include <span>
#include <vector>

#include "abi/yade.hpp"
#include "collider/halo.hpp"
#include "search/partner_table.hpp"

namespace yadefrag {

class InteractionUpdate {
 public:
  using MayCollide = std::function<bool(const yade::Body*, const yade::Body*)>;

  /// Erases interactions that are neither near nor real, and makes those that are new, in the order
  /// of `near`: neighbours on the curve are then neighbours in memory, which is what the
  /// interaction loop's time depends on. One pass over what there is replaces a look-up per pair.
  void apply(yade::Scene& scene, std::span<const Neighbours> near, const MayCollide& mayCollide);

 private:
  using Bodies = std::vector<yade::shared_ptr<yade::Body>>;

  void markKnown(yade::InteractionContainer& interactions, std::span<const Neighbours> near,
                 const Bodies& bodies);
  void makeNew(yade::Scene& scene, std::span<const Neighbours> near, const MayCollide& mayCollide);

  PartnerTable partners_;
  std::vector<char> known_;   // by index: this interaction exists
  std::vector<int> toErase_;  // places in YADE's list, ascending
};

}  // namespace yadefrag
