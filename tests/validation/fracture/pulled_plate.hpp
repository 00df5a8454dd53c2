#pragma once
// The plate of 100 × 40 mm with a notch to its middle whose long sides are pulled by 1 MPa from the
// first step on, in plane strain: crack branching (Borden et al. 2012, Comput. Methods Appl. Mech.
// Eng. 217, 77; Song, Wang and Belytschko 2008, Comput. Mech. 42, 239).

#include <algorithm>
#include <cmath>
#include <vector>

#include "meshing/triangulate.hpp"
#include "step/world.hpp"

namespace yadefrag::test {

struct PulledPlate {
  static constexpr double kLong = .1, kHigh = .04, kTip = kLong / 2;  // m
  static constexpr double kTraction = 1e6;                            // Pa
  static constexpr double kStrength = 3.08e6;                         // Pa
  static constexpr double kFractureEnergy = 3;                        // J/m²
  static constexpr double kRayleigh = 2125;                           // m/s
  static constexpr ElasticMaterial kMaterial{32e9, .2, 2450, false};

  /// With the slit of the notch a tenth of an element wide at its mouth.
  static Polygon outline(double size) {
    const double slit = size / 20, middle = kHigh / 2;
    return {{{0, 0},
             {kLong, 0},
             {kLong, kHigh},
             {0, kHigh},
             {0, middle + slit},
             {kTip, middle},
             {0, middle - slit}},
            {}};
  }

  static BodySpec spec() {
    BodySpec spec;
    spec.material = kMaterial;
    spec.brittle.tensileStrength = kStrength;
    spec.brittle.fractureEnergy = kFractureEnergy;
    return spec;
  }

  /// Adds the body and pulls it.
  static void add(World& world, const TriangleMesh& mesh, const BodySpec& spec) {
    world.addBody(mesh, spec);
    std::vector<Vec2> loads(mesh.nodes.size());
    pullSide(mesh, kHigh, kTraction, loads);
    pullSide(mesh, 0, -kTraction, loads);
    world.setLoads(loads);
  }

 private:
  /// (N) Of the nodes of the upper or the lower side.
  static void pullSide(const TriangleMesh& mesh, double y, double traction,
                       std::vector<Vec2>& loads) {
    std::vector<std::size_t> side;
    for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
      if (std::abs(mesh.nodes[i].y - y) < 1e-9) side.push_back(i);
    std::ranges::sort(side, {}, [&](std::size_t i) { return mesh.nodes[i].x; });
    for (std::size_t k = 1; k < side.size(); ++k) {
      const double length = mesh.nodes[side[k]].x - mesh.nodes[side[k - 1]].x;
      loads[side[k]].y += traction * length / 2;
      loads[side[k - 1]].y += traction * length / 2;
    }
  }
};

}  // namespace yadefrag::test
