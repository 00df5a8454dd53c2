#pragma once
// Finds other bodies in the scene that should have contact with the bodies of FESolver, when they
// first appear, so that a message can report contacts that are not computed.

#include <cstddef>
#include <string>
#include <typeinfo>
#include <vector>

#include "yade/yade.hpp"

namespace yadefrag {

class SceneWatch {
 public:
  /// Checks the bodies that were added since the last call. Returns true if there is a message.
  bool check(const yade::Scene& scene);
  /// Number of the scene's bodies at the last call.
  [[nodiscard]] std::size_t checked() const { return checked_; }
  /// The last call has found spheres.
  [[nodiscard]] bool hasNewSpheres() const { return hasNewSpheres_; }
  /// A body that obeys forces; -1 if there was none.
  [[nodiscard]] yade::Body::id_t free() const { return free_; }
  /// Throws std::invalid_argument if there are bodies that have no meaning around an axis.
  void requireRound() const;
  /// Messages about these bodies, from yadefrag/scene/scene_check.py; none if that fails.
  /// `gravity`: m/s², of NewtonIntegrator; `rigidBodies`: contact with YADE's walls, boxes and
  /// facets is on; `thickness`: m, largest of the bodies of FESolver. Acquires Python's lock.
  [[nodiscard]] std::vector<std::string> sentences(const yade::Vector3r& gravity, bool rigidBodies,
                                                   double thickness) const;

 private:
  struct Kind {
    const std::type_info* type;
    std::string name;
    yade::Body::id_t first;
  };
  bool noteShape(const yade::Body& body);
  bool noteSphere(const yade::Body& body, double radius);

  std::size_t checked_ = 0;
  int spheres_ = 0;  // number of spheres, up to 2
  bool hasNewSpheres_ = false;
  std::vector<Kind> kinds_;
  // Spheres: one beside the plane of the bodies, one that leaves it, one that may leave it.
  yade::Body::id_t beside_ = -1, leaving_ = -1, loose_ = -1;
  yade::Body::id_t free_ = -1;  // obeys forces
  double largest_ = 0;          // m, radius
};

// --- Checks the order of a scene's engines: all forces must act on their bodies before they are
// reset.

class EngineOrder {
 public:
  /// Throws std::invalid_argument if `solver` is in O.engines twice, or if contact forces are reset
  /// before `solver` or NewtonIntegrator has used them: momentum would be lost. Checks only if
  /// engines have changed since the last call; returns true in that case.
  bool require(const yade::Scene& scene, const yade::Engine& solver);
  /// True if NewtonIntegrator used the forces of InteractionLoop before `solver`, in the engines of
  /// the last `require`.
  [[nodiscard]] bool spheresMoveFirst() const { return spheresMoveFirst_; }

  /// Throws std::invalid_argument if the forces of `solver` on rigid bodies are reset within the
  /// step, or, if any of these is movable, before NewtonIntegrator has used them, or never.
  static void requireReturn(const yade::Scene& scene, const yade::Engine& solver, bool anyMovable);

 private:
  struct Item {
    const std::type_info* type;
    bool isSolver, isDead;
    bool operator==(const Item&) const = default;
  };

  std::vector<Item> checked_;  // the engines of the last `require`
  bool spheresMoveFirst_ = false;
};

}  // namespace yadefrag
