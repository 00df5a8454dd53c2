#pragma once
// Bodies so far from all others that their nodes need not be watched one by one.

#include <cstdint>
#include <span>
#include <vector>

#include "core/footprint.hpp"
#include "mesh/model.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

class ApartBodies {
 public:
  /// Those with none of the `watched` nodes are apart; how far is not known.
  void takeFrom(const Model& model, std::span<const NodeId> watched);

  /// Chooses anew: apart is a body that cannot touch itself and has none within a few `reach` (m).
  /// True if the choice is another one; `wasApart` then tells of the former one.
  bool choose(const Model& model, const ContactSurfaces& surfaces, double reach);

  /// Looks again at how far from all others those are that are apart, as far as matters: `spare`.
  void look(const Model& model, const ContactSurfaces& surfaces, double reach);

  [[nodiscard]] bool any() const { return count_ > 0; }
  [[nodiscard]] bool isApart(ComponentId body) const { return apart_[body.value] != 0; }
  [[nodiscard]] bool wasApart(ComponentId body) const { return former_[body.value] != 0; }

  /// (m) A body may come so much nearer to one that is apart and is still farther than `reach`.
  [[nodiscard]] double spare() const { return spare_; }
  void comeNearer(double way) { spare_ -= way; }
  void restoreSpare(double spare) { spare_ = spare; }

  void addTo(Footprint& footprint) const { footprint.add(Use::kSearch, apart_, former_); }

 private:
  struct Gap {
    ComponentId a, b;
    double width;  // m
  };
  static std::vector<Gap> gapsBelow(const Model& model, const ContactSurfaces& surfaces,
                                    double width);
  void measure(const std::vector<Gap>& gaps, double widest, double reach);

  std::vector<std::uint8_t> apart_, former_;  // by component
  std::size_t count_ = 0;                     // of those that are apart
  double spare_ = -1;                         // m
};

}  // namespace yadefrag
