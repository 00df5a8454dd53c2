#pragma once
// What still holds the two faces of a crack that has not opened wide (extrinsic linear cohesive
// law, Camacho and Ortiz 1996).
//
// A crack that opens further is pulled back by what the law gives for the opening at the step's
// begin: the leapfrog then sums the work by the trapezoid rule, which is exact below a straight
// line. Taken at the step's end, the law would spend 2Δδ/δc too little, Δδ the opening in a step.
// But no crack is pulled below the unloading line: so one that has hardly opened, whose line is
// stiffer than any step resolves, is held like a contact by whatever keeps it as it is, up to what
// the law allows.
//
// As long as one end of a crack holds, its faces are opposite each other, node to node, and are
// kept apart here, too: pulled together here and pushed apart by contact in turn, corner on corner,
// they would slide past each other, and contact would push out what it has not kept out. Pressed
// together they rub, too: the traction along the face goes on from βσc + μp, at which it opened.

#include <array>
#include <span>
#include <vector>

#include "core/csr.hpp"
#include "core/disjoint_sets.hpp"
#include "core/footprint.hpp"
#include "core/step_length.hpp"
#include "dynamics/energy_ledger.hpp"
#include "fracture/cohesive_law.hpp"
#include "fracture/crack_edges.hpp"

namespace yadefrag {

class Cohesion {
 public:
  /// From now on the crack holds together as the law says. `reference`: m, stress-free, by node.
  void add(const Model& model, const CrackEdges& edges, EdgeId edge,
           std::span<const Vec2> reference);
  /// Edges are known by new numbers, none() if they are gone.
  void renumberEdges(std::span<const EdgeId> renumbered);

  /// From the predicted x* and v* without cohesion to those with it; `before`: m, xⁿ, for the
  /// normals. Returns the largest correction of a position (m). What the cracks know of their
  /// openings changes in `settle` alone.
  double correct(Model& model, const CrackEdges& edges, std::span<const Vec2> before,
                 const StepLength& step, double drag);

  /// Largest change of a traction, of its strength, in the last sweep of the last step.
  [[nodiscard]] double residual() const { return residual_; }

  /// Adds what the tractions of the step took, with its mean velocity: of the law to `fracture`, of
  /// what keeps the faces apart to `contact`, of friction to `friction`.
  void book(EnergyLedger& ledger, const Model& model, std::span<const Vec2> previousVelocity,
            const StepLength& step) const;
  /// At the end of the step, when contact has closed what it closes: cracks learn how far they have
  /// opened, and those that hold nothing any more are forgotten, and listed in `released`.
  void settle(const Model& model, const CrackEdges& edges);

  /// (N) Adds the tractions of the present step, by node.
  void addForces(std::vector<Vec2>& forces) const;

  /// Cracks inside dropped triangles hold nothing any more either.
  void removeDropped(const Triangles& triangles, const CrackEdges& edges);

  std::vector<EdgeId> released;  ///< in the last step
  void addTo(Footprint& footprint) const {
    footprint.add(Use::kCohesion, edge, largest, traction, area, points_, firstAt_, groupOf_,
                  groups_.values, groups_.offsets, turned_, released);
    sets_.addTo(footprint, Use::kCohesion);
  }

  // By crack that holds; both ends of an edge have an opening of their own (see countedOpening).
  std::vector<EdgeId> edge;
  std::vector<std::array<double, 2>> largest;  ///< m, δmax
  /// Pa, in the last step, across the crack and along it: where the next one begins. Cracks side by
  /// side share a load in many ways that move the nodes alike, and sweeps are slow to choose.
  std::vector<std::array<Vec2, 2>> traction;
  std::vector<double> area;  ///< m², half the face's

 private:
  struct Point {
    NodeId here, there;        // of the edge's first and second triangle
    Vec2 normal;               // out of the first
    Vec2 rateHere, rateThere;  // m/Pa, by axis
    double area, strength, critical;
    CohesiveHold hold;
    double slid;  // m, at the step's begin
    FaceTractions tractions{};
    Vec2 traction{};  // Pa, all of them, on `here`
    Vec2 change{};    // Pa, in the last sweep
    bool isEven;      // as compliant in all directions
    std::uint32_t crack, end;
  };

  template <class Keep>
  void keepOnly(Keep keep);
  [[nodiscard]] double counted(std::size_t crack, std::size_t end, double critical) const {
    return countedOpening(largest[crack][end], largest[crack][1 - end], critical);
  }
  void widenBroken(const Model& model, const CrackEdges& edges);
  void collect(const Model& model, const CrackEdges& edges, std::span<const Vec2> before,
               const StepLength& step, double drag);
  void findGroups(std::size_t nodes);
  double solve(std::vector<Vec2>& position, std::span<const std::uint32_t> group);
  static void apply(std::vector<Vec2>& position, const Point& point, Vec2 change);
  static void relax(std::vector<Vec2>& position, Point& point);

  std::vector<Point> points_;
  std::vector<std::uint32_t> firstAt_;  // by node of a point: the first point there
  DisjointSets sets_;                   // of points
  std::vector<std::uint32_t> groupOf_;  // by point
  Csr<std::uint32_t> groups_;           // of points that share nodes
  double residual_ = 0;
  std::vector<std::uint32_t> turned_;  // cracks whose faces are at a right angle, or more
};

}  // namespace yadefrag
