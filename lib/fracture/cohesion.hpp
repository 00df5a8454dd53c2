#pragma once
// The couple of a crack's tractions.
//
// Opposite tractions t act on nodes that are apart by the opening o. Unless t is parallel to o,
// they have a moment: with a shear factor, under friction or pressure after a slip, and, of first
// order in the step, for any law, since o is that of the step's begin and t that of its end. The
// law is written in the frame of the crack, which rotates with the faces; the forces that belong to
// it (the derivatives of its energy by the positions) contain a couple on the faces that balances
// this moment. Without it, a free body gains angular momentum (Vossen, Schreurs, van der Sluis and
// Geers 2013, Comput. Methods Appl. Mech. Eng. 254, 146).
//
// The couple is a force on the two nodes at one end, and the opposite force on those at the other
// end, across the line between both. At each end the force is divided in proportion to the masses,
// so that both nodes move alike: the openings do not change.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "contact/contact_row.hpp"
#include "core/csr.hpp"
#include "core/disjoint_sets.hpp"
#include "core/step_times.hpp"
#include "core/vec2.hpp"
#include "core/work_list.hpp"
#include "fracture/cohesive_law.hpp"
#include "fracture/crack_edges.hpp"
#include "mesh/model.hpp"
#include "time/energy_ledger.hpp"

namespace yadefrag {

class FaceCouple {
 public:
  /// `nodes`: both nodes at the first end, then at the other, at `before` (m). `rate`: m/Pa, by
  /// axis, likewise.
  FaceCouple(const std::array<NodeId, 4>& nodes, const std::array<Vec2, 4>& rate,
             std::span<const Vec2> before);

  /// Sets the moment of the tractions, Σ o × t (Pa m), and corrects the positions by its change.
  void balance(std::vector<Vec2>& position, double moment);
  /// Corrects the velocities; `duration`: s, of the step.
  void push(std::vector<Vec2>& velocity, double duration) const;
  /// (N) `area`: m², of each end.
  void addForces(std::vector<Vec2>& forces, double area) const;
  /// (rad/s) Rotation of the line, for velocities by node.
  template <class Velocity>
  [[nodiscard]] double rotation(Velocity velocity) const {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) sum += part_[i] * dot(across_, velocity(nodes_[i]));
    return sum;
  }

 private:
  [[nodiscard]] Vec2 moved(std::size_t i, double moment) const {
    return {rate_[i].x * part_[i] * moment * across_.x, rate_[i].y * part_[i] * moment * across_.y};
  }

  std::array<NodeId, 4> nodes_;
  std::array<Vec2, 4> rate_;
  std::array<double, 4> part_;  // of the force, by node; negative at the first end
  Vec2 across_;                 // 1/m, the unit normal of the line over its length
  double moment_ = 0;           // Pa m
};

// --- Tractions between the faces of cracks that have not opened wide (extrinsic cohesive law,
// Camacho and Ortiz 1996; linear, or with another softening curve).
//
// A crack that opens further has the traction of the law for the opening at the begin of the step:
// the leapfrog then sums the work by the trapezoid rule, which is exact for a straight line, and
// has an error of second order at a knee. With the opening at the end of the step, the dissipated
// energy would be lower by the part 2Δδ/δc, where Δδ is the opening in a step. Unloading limits
// this traction: the opening must not fall below the unloading line. A crack that has hardly opened
// has an unloading line too stiff for any step; it is then treated as a contact, by the traction
// that keeps its opening, up to the limit of the law.
//
// As long as one end of a crack is cohesive, its faces are opposite each other, node to node, and
// their overlap is prevented here, too. If the law pulled the nodes together and contact pushed
// them apart in turn, corner on corner, they would slide past each other, and contact would remove
// an overlap that it did not prevent. Faces that are pressed together also have friction: the
// traction along the face continues from βσc + μp, at which the crack opened.

class Cohesion final : public CoupledForces {
 public:
  /// Makes a crack cohesive. `reference`: m, stress-free, by node.
  void add(const Model& model, const CrackEdges& edges, EdgeId edge);
  /// Changes edge numbers; none(): the edge was removed.
  void renumberEdges(std::span<const EdgeId> renumbered);

  /// Corrects the predicted x* by the cohesive tractions; `before`: m, xⁿ, for the normals. The
  /// stored openings of the cracks change only in `keepOpenings`.
  void correct(Model& model, const CrackEdges& edges, std::span<const Vec2> before,
               const StepLength& step, double drag);
  // While contact is solved:
  [[nodiscard]] std::uint32_t groupOf(NodeId node) const override;
  void begin(std::span<const Vec2> position) override;
  void noteMoved(NodeId node) override;
  double sweep(std::vector<Vec2>& position, double tolerance) override;
  double converge(std::vector<Vec2>& position) override;
  /// Corrects v* by the final tractions.
  void finish(Nodes& nodes, const StepLength& step);

  /// Largest change of a traction, divided by the strength, in the last sweep of the last step.
  [[nodiscard]] double residual() const { return residual_; }

  /// Adds the work of the step's tractions, with the mean velocity: that of the law to `fracture`,
  /// that of the traction against overlap to `contact`, that of friction to `friction`.
  void addWork(EnergyLedger& ledger, const Model& model, std::span<const Vec2> previousVelocity,
               const StepLength& step) const;
  /// Call it at the end of the step, after contact. Stores the cracks' largest openings, and
  /// removes cracks that no longer transmit traction; these are listed in `released`.
  void keepOpenings(const Model& model, const CrackEdges& edges);

  /// (N) Adds the forces of the present step's tractions, by node.
  void addForces(std::vector<Vec2>& forces) const;
  /// True if the present step has tractions.
  [[nodiscard]] bool isPulling() const { return !points_.empty(); }

  /// Removes cracks between removed triangles.
  void removeDropped(const Triangles& triangles, const CrackEdges& edges);

  std::vector<EdgeId> released;  ///< cracks that were removed in the last step

  // By cohesive crack; each end of an edge has its own opening (see countedOpening).
  std::vector<EdgeId> edge;
  std::vector<std::array<double, 2>> largest;  ///< m, δmax
  /// Pa, in the last step, across the crack and along it: the start values of the next step. The
  /// load of cracks side by side can be divided between them in many ways with the same motion of
  /// the nodes; without start values the sweeps would converge slowly.
  std::vector<std::array<Vec2, 2>> traction;
  std::vector<double> area;  ///< m², half of the face's area

  /// All of these (core/columns.hpp), in the order of saved states.
  template <class Self>
  static auto columnsOf(Self& self) {
    return [&self](auto visit) {
      visit(Column{"cohesiveEdge"}, self.edge);
      visit(Column{"cohesiveLargest"}, self.largest);
      visit(Column{"cohesiveTraction"}, self.traction);
      visit(Column{"cohesiveArea"}, self.area);
    };
  }
  auto columns() { return columnsOf(*this); }
  auto columns() const { return columnsOf(*this); }

 private:
  struct Point {
    NodeId here, there;        // node of the edge's first and second triangle
    Vec2 normal;               // unit, outward from the first triangle
    Vec2 rateHere, rateThere;  // m/Pa, by axis
    double area, strength, critical;
    CohesiveHold hold;
    Vec2 apart;   // m, the opening at the begin of the step
    double slid;  // m, slip at the begin of the step
    FaceTractions tractions{};
    Vec2 traction{};  // Pa, sum of the tractions on `here`
    Vec2 change{};    // Pa, in the last sweep
    Vec2 opening{};   // m, at the last call of `opened`
    bool isEven;      // equal compliance in all directions
    std::uint32_t crack, end;
    std::uint32_t couple;  // that of its crack; one or two consecutive points have the same
  };

  [[nodiscard]] double counted(std::size_t crack, std::size_t end, double critical) const {
    return countedOpening(largest[crack][end], largest[crack][1 - end], critical);
  }
  void widenBroken(const Model& model, const CrackEdges& edges);
  void collect(const Model& model, const CrackEdges& edges, std::span<const Vec2> before,
               const StepLength& step, double drag);
  void findGroups(std::size_t nodes);
  double solve(std::vector<Vec2>& position, std::span<const std::uint32_t> group);
  double opened(const std::vector<Vec2>& position, std::span<const std::uint32_t> group);
  void balance(std::vector<Vec2>& position);
  template <class Matters>
  double improve(std::vector<Vec2>& position, Matters matters);
  static void apply(std::vector<Vec2>& position, const Point& point, Vec2 change);
  static void relax(std::vector<Vec2>& position, Point& point);
  /// (m) Displacement by the last change of a traction.
  static double moved(const Point& point);

  std::vector<Point> points_;
  std::vector<FaceCouple> couples_;  // of the cracks with points
  /// By node: the first point there; of a node without points, any number.
  std::vector<std::uint32_t> firstAt_;
  DisjointSets sets_;                   // sets of points
  std::vector<std::uint32_t> groupOf_;  // by point
  Csr<std::uint32_t> groups_;           // groups of points that share nodes
  double residual_ = 0;
  // While contact is solved:
  Csr<std::uint32_t> pointsAt_;             // by firstAt_: all points of a node
  WorkList waiting_;                        // points whose tractions are to be improved
  std::vector<std::uint32_t> improved_;     // points that were visited
  std::vector<std::array<Vec2, 2>> start_;  // m, by point, before contact
  bool isCoupled_ = false;
  std::vector<std::uint32_t> turned_;  // cracks whose faces enclose a right angle or more
};

}  // namespace yadefrag
