#pragma once
// Isolated bodies: so far from all others that their nodes need not be checked one by one.

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/model.hpp"
#include "surface/contact_surface.hpp"

namespace yadefrag {

class ApartBodies {
 public:
  /// Bodies with none of the `watched` nodes are isolated; their distance from others is not known.
  void takeFrom(const Model& model, std::span<const NodeId> watched);

  /// Determines the isolated bodies again: those that cannot touch themselves and have no other
  /// body within a few `reach` (m). Returns true if the set has changed; `wasApart` then describes
  /// the former one.
  bool choose(const Model& model, const ContactSurfaces& surfaces, double reach);

  /// Computes again the distance of isolated bodies from all others, as far as it is needed:
  /// `spare`.
  void look(const Model& model, const ContactSurfaces& surfaces, double reach);

  [[nodiscard]] bool any() const { return count_ > 0; }
  [[nodiscard]] bool isApart(ComponentId body) const { return apart_[body.value] != 0; }
  [[nodiscard]] bool wasApart(ComponentId body) const { return former_[body.value] != 0; }

  /// (m) A body may approach an isolated one by this distance and is still farther away than
  /// `reach`.
  [[nodiscard]] double spare() const { return spare_; }
  void comeNearer(double way) { spare_ -= way; }
  void restoreSpare(double spare) { spare_ = spare; }

 private:
  struct Gap {
    ComponentId a, b;
    double width;  // m
  };
  static std::vector<Gap> gapsBelow(const Model& model, const ContactSurfaces& surfaces,
                                    double width);
  void measure(const std::vector<Gap>& gaps, double widest, double reach);

  std::vector<std::uint8_t> apart_, former_;  // by component
  std::size_t count_ = 0;                     // number of isolated bodies
  double spare_ = -1;                         // m
};

}  // namespace yadefrag
