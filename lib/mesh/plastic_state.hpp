#pragma once
// State of materials that yield, by triangle.
//
// A triangle that flows changes its stress-free shape. As in multiplicative plasticity
// (F = Fₑ Fₚ; Simo and Hughes 1998, Computational Inelasticity, ch. 9; de Souza Neto, Perić and
// Owen 2008, ch. 14), its elastic deformation is Fₑ = d Dₑ⁻¹ with the present edges d and the edges
// Dₑ of the stress-free shape, and λ across the plane. Flow multiplies Dₑ⁻¹ by exp(−Δεₚ).

#include <array>
#include <vector>

#include "core/columns.hpp"

namespace yadefrag {

/// All arrays are empty if no body yields, and otherwise have all triangles of the scene.
struct PlasticState {
  std::array<std::vector<double>, 4> edges;  ///< 1/m, Dₑ⁻¹ row by row
  std::vector<double> thickness;             ///< λ, elastic stretch across the plane
  std::vector<double> strain;                ///< p, equivalent plastic strain
  std::vector<double> temperature;           ///< K
  /// From 0 to 1, where the material has failed; empty if no body can.
  std::vector<double> damage;
  /// Factor of the failure strain and of the spall stress; empty if it is 1 everywhere.
  std::vector<double> resistance;

  template <class Self>
  static auto columnsOf(Self& self) {
    return [&self](auto visit) {
      visit(Column{"elasticEdges11", kOptional}, self.edges[0]);
      visit(Column{"elasticEdges12", kOptional}, self.edges[1]);
      visit(Column{"elasticEdges21", kOptional}, self.edges[2]);
      visit(Column{"elasticEdges22", kOptional}, self.edges[3]);
      visit(Column{"elasticThickness", kOptional}, self.thickness);
      visit(Column{"plasticStrain", kOptional}, self.strain);
      visit(Column{"temperature", kOptional}, self.temperature);
      visit(Column{"damage", kOptional}, self.damage);
      visit(Column{"resistance", kOptional}, self.resistance);
    };
  }

  [[nodiscard]] bool isUsed() const { return !thickness.empty(); }
  /// Makes a row that has not flowed.
  void begin(std::size_t row, const std::array<double, 4>& inverseEdges, double start) {
    for (std::size_t i = 0; i < 4; ++i) edges[i][row] = inverseEdges[i];
    thickness[row] = 1;
    strain[row] = 0;
    temperature[row] = start;
    if (!damage.empty()) damage[row] = 0;
  }
  void resize(std::size_t count) {
    for (auto& one : edges) one.resize(count);
    thickness.resize(count), strain.resize(count), temperature.resize(count);
  }
  [[nodiscard]] bool hasFailed(std::size_t row) const {
    return !damage.empty() && damage[row] >= 1;
  }
  [[nodiscard]] double resistanceOf(std::size_t row) const {
    return resistance.empty() ? 1 : resistance[row];
  }
};

}  // namespace yadefrag
