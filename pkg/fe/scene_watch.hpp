#pragma once
// What else is in the scene that the bodies of FESolver should touch, or be touched by: found when
// it first appears, so that a sentence can say what will not.

#include <cstddef>
#include <string>
#include <typeinfo>
#include <vector>

#include "abi/yade.hpp"

namespace yadefrag {

class SceneWatch {
 public:
  /// Looks at the bodies that came since the last call. True where there is something to say.
  bool look(const yade::Scene& scene);
  /// Sentences about what has been seen so far, of yadefrag/scene_check.py; none where that fails.
  /// `gravity`: m/s², of NewtonIntegrator; `rigidBodies`: do bodies touch YADE's walls, boxes and
  /// facets. Takes Python's lock.
  [[nodiscard]] std::vector<std::string> sentences(const yade::Vector3r& gravity,
                                                   bool rigidBodies) const;

 private:
  struct Kind {
    const std::type_info* type;
    std::string name;
    yade::Body::id_t first;
  };
  bool noteShape(const yade::Body& body);
  bool noteSphere(const yade::Body& body, double radius);

  std::size_t looked_ = 0;
  std::vector<Kind> kinds_;
  // Of spheres: one beside the plane of the bodies, one that leaves it, one that is free to.
  yade::Body::id_t beside_ = -1, leaving_ = -1, loose_ = -1;
};

}  // namespace yadefrag
