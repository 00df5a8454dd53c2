#pragma once
// Damage of materials that yield, in a step (mesh/failure_law.hpp): it follows the flow of each
// triangle. Triangles that have failed are listed, so that cracks look at their edges.

#include <vector>

#include "dynamics/element_kernel.hpp"
#include "dynamics/plastic_return.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// Stress after the return, and the flow that led to it.
struct FlowStep {
  double strain;       ///< Δp
  double temperature;  ///< K, before
  double mean, mises;  ///< Pa, of τ; mean and von Mises' stress; of a cone before the return
  double volume;       ///< τ/σ: J, or det F of a cone
  double resistance;   ///< factor of the failure strain and of the spall stress
};

/// The damage after a step of Δt (s), from that before it; at most 1.
[[nodiscard]] double damageAfter(const PlasticMaterial& m, double damage, const FlowStep& step,
                                 double dt);

class PlasticDamage {
 public:
  void rebuild(const Model& model);
  /// Before each step.
  void begin(std::size_t threads);
  /// Of a triangle that is about to fail or has flowed.
  void add(Model& model, const PlasticMaterial& m, std::uint32_t element, const FlowStep& step,
           double dt, std::size_t thread);
  /// Undoes the changes of the last step.
  void takeBack(Model& model);
  /// Appends the triangles that have failed.
  void appendFailed(std::vector<ElementRange>& ranges) const;

 private:
  struct Former {
    std::uint32_t element;
    double damage;
  };
  struct Thread {
    std::vector<Former> former;
    std::vector<std::uint32_t> failed;  // in the last step
  };

  std::vector<std::uint32_t> failed_;  // before it, ascending
  std::vector<Thread> threads_;
};

}  // namespace yadefrag
