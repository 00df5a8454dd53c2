#include "fracture/cohesion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/tolerances/fracture.hpp"
#include "fracture/edge_strength.hpp"
#include "mesh/model.hpp"

namespace yadefrag {
namespace {

/// The nodes at one end of an edge: those of its first and of its second triangle.
std::array<NodeId, 2> nodesAt(const Model& model, const CrackEdges& edges, EdgeId edge, int end) {
  const Side first = edges.side(edge, 0), second = edges.side(edge, 1);
  if (end == 0) return {firstNode(model, first), lastNode(model, second)};
  return {lastNode(model, first), firstNode(model, second)};
}

double criticalOpening(const Model& model, const CrackEdges& edges, EdgeId edge) {
  return tensionLaw(model, edges, edge).criticalOpening;
}

CohesiveHold holdOf(const Model& model, const CrackEdges& edges, EdgeId edge) {
  const auto [a, b] = edges.element[edge.value];
  const auto [brittle, friction] = materialBetween(model, a, b);
  const double beta = brittle.shearFactor;
  return {0, 0, beta, beta * beta / brittle.shearEnergyFactor, friction, {}};
}

Vec2 times(Vec2 a, Vec2 b) { return {a.x * b.x, a.y * b.y}; }

/// (m/Pa) Compliance across the edge and along it, from the `compliance` by axis. Nodes that are
/// held in one direction couple the two; the larger value is then used for both, and the sweeps
/// correct the difference. 0 if no node can move.
AcrossAlong byDirection(Vec2 compliance, Vec2 normal) {
  const double most = std::max(compliance.x, compliance.y);
  const double x = normal.x * normal.x, y = normal.y * normal.y;
  return {compliance.x * x + compliance.y * y > 0 ? most : 0,
          compliance.x * y + compliance.y * x > 0 ? most : 0};
}

}  // namespace

void Cohesion::add(const Model& model, const CrackEdges& edges, EdgeId cracked) {
  const std::vector<Vec2>& reference = model.nodes.reference;
  const Side side = edges.side(cracked, 0);
  const Vec2 along =
      reference[lastNode(model, side).value] - reference[firstNode(model, side).value];
  const auto [a, b] = edges.element[cracked.value];
  const auto depthOf = [&](ElementId element) {
    return model.depthOf(model.bodyOf(element), reference[firstNode(model, side).value],
                         reference[lastNode(model, side).value]);
  };
  edge.push_back(cracked);
  largest.push_back({0, 0});
  traction.push_back({});
  area.push_back(norm(along) / 2 * std::min(depthOf(a), depthOf(b)));
}

void Cohesion::renumberEdges(std::span<const EdgeId> renumbered) {
  keepRows(columns(), edge.size(),
           [&](std::size_t c) { return renumbered[edge[c].value] != EdgeId::none(); });
  for (EdgeId& one : edge) one = renumbered[one.value];
}

void Cohesion::collect(const Model& model, const CrackEdges& edges, std::span<const Vec2> before,
                       const StepLength& step, double drag) {
  points_.clear();
  couples_.clear();
  turned_.clear();
  for (std::uint32_t c = 0; c < edge.size(); ++c) {
    const auto [a, b] = nodesAt(model, edges, edge[c], 0);
    const auto [d, e] = nodesAt(model, edges, edge[c], 1);
    if (a == b && d == e) continue;
    const TensionLaw law = tensionLaw(model, edges, edge[c]);
    const double critical = law.criticalOpening;
    const Vec2 first = before[d.value] - before[a.value];
    const Vec2 second = before[e.value] - before[b.value];
    // Faces at a right angle are connected at one end at most, and will soon have no common normal.
    if (dot(first, second) <= 0) {
      turned_.push_back(c);
      continue;
    }
    const Vec2 across = rightOf(first + second);
    const Vec2 normal = (1 / norm(across)) * across;
    const std::array<NodeId, 4> nodes{a, b, d, e};
    std::array<Vec2, 4> rate;
    for (std::size_t i = 0; i < 4; ++i)
      rate[i] = step.squared() * area[c] * mobility(model.nodes, nodes[i], drag);
    const std::size_t known = points_.size();
    for (std::uint32_t end = 0; end < 2; ++end) {
      const NodeId here = end == 0 ? a : d, there = end == 0 ? b : e;
      // An end that transmits no traction has contact like any other surface, at any later
      // rotation.
      const double opening = counted(c, end, critical);
      if (here == there || opening >= critical) continue;
      Point& point = points_.emplace_back();
      point.here = here, point.there = there;
      point.normal = normal;
      point.rateHere = rate[2 * end], point.rateThere = rate[2 * end + 1];
      point.area = area[c], point.strength = law.strength;
      point.critical = critical;
      point.hold = holdOf(model, edges, edge[c]);
      point.hold.most = envelope(law, opening);
      point.hold.largest = largest[c][end];
      const Vec2 both = point.rateHere + point.rateThere;
      point.hold.compliance = byDirection(both, normal);
      point.isEven = both.x == both.y;
      point.apart = before[there.value] - before[here.value];
      point.slid = dot(point.apart, -rightOf(normal));
      const Vec2 last = traction[c][end];
      point.traction = last.x * normal - last.y * rightOf(normal);
      point.crack = c, point.end = end;
      point.couple = static_cast<std::uint32_t>(couples_.size());
    }
    if (points_.size() > known) couples_.emplace_back(nodes, rate, before);
  }
}

/// Groups of points that share nodes, directly or through other points: the parts of one node that
/// split.
void Cohesion::findGroups(std::size_t nodes) {
  firstAt_.resize(nodes);
  const auto count = static_cast<std::uint32_t>(points_.size());
  for (std::uint32_t i = count; i-- > 0;)
    firstAt_[points_[i].here.value] = firstAt_[points_[i].there.value] = i;
  sets_.reset(count);
  for (std::uint32_t i = 0; i < count; ++i)
    for (const NodeId node : {points_[i].here, points_[i].there})
      sets_.join(firstAt_[node.value], i);
  const std::uint32_t groups = sets_.number(groupOf_);
  fillRows(
      groups_, groups, count, [&](std::size_t i) { return groupOf_[i]; },
      [](std::size_t i) { return static_cast<std::uint32_t>(i); });
}

void Cohesion::apply(std::vector<Vec2>& position, const Point& point, Vec2 change) {
  position[point.here.value] += times(point.rateHere, change);
  position[point.there.value] -= times(point.rateThere, change);
}

/// Solves for the tractions of one point, with those of the others fixed.
void Cohesion::relax(std::vector<Vec2>& position, Point& point) {
  const Vec2 tangent = -rightOf(point.normal);
  const Vec2 apart = position[point.there.value] - position[point.here.value];
  const AcrossAlong& compliance = point.hold.compliance;
  const AcrossAlong trial{
      dot(apart, point.normal) + compliance.normal * dot(point.traction, point.normal),
      dot(apart, tangent) + compliance.shear * dot(point.traction, tangent)};
  point.tractions = faceTractions(point.hold, trial, point.slid);
  const FaceTractions& t = point.tractions;
  const Vec2 traction = t.normal * point.normal + (t.shear + t.friction) * tangent;
  point.change = traction - point.traction;
  point.traction = traction;
  apply(position, point, point.change);
}

/// (1) Largest change of an opening since the last call, divided by the opening by the strength.
double Cohesion::opened(const std::vector<Vec2>& position, std::span<const std::uint32_t> group) {
  double most = 0;
  for (const std::uint32_t i : group) {
    Point& point = points_[i];
    const AcrossAlong& compliance = point.hold.compliance;
    const Vec2 now = position[point.there.value] - position[point.here.value];
    const double change = norm(now - std::exchange(point.opening, now));
    most =
        std::max(most, change / (point.strength * std::max(compliance.normal, compliance.shear)));
  }
  return most;
}

/// Sweeps over points that share nodes, starting from the tractions of the last step, until no
/// traction changes any more, or no opening: around a node that is split all round, tractions that
/// move no node can grow by the same amount in each sweep. Returns the largest change in the last
/// sweep, divided by the strength; 0 if no opening changes.
double Cohesion::solve(std::vector<Vec2>& position, std::span<const std::uint32_t> group) {
  assert(!group.empty());
  for (const std::uint32_t i : group) points_[i].change = {};
  double worst = 0;
  for (int sweep = 1; sweep <= tolerance::kCohesionSweeps; ++sweep) {
    double now = 0, before = 0, common = 0;  // Pa², sums over the changes
    worst = 0;
    for (const std::uint32_t i : group) {
      Point& point = points_[i];
      const Vec2 last = point.change;
      relax(position, point);
      now += dot(point.change, point.change), before += dot(last, last);
      common += dot(point.change, last);
      worst = std::max(worst, dot(point.change, point.change) / (point.strength * point.strength));
    }
    worst = std::sqrt(worst);
    if (group.size() == 1 && points_[group[0]].isEven) return 0;  // exact after one solution
    if (worst <= tolerance::kCohesionChange) break;
    if (sweep % tolerance::kSweepsToSumUp != 0) continue;
    if (opened(position, group) <= tolerance::kSameOpening) return 0;
    const bool isSeries =
        common > 0 && common < before && common * common >= tolerance::kSameChange * now * before;
    if (!isSeries || sweep > tolerance::kCohesionSweeps - tolerance::kSweepsToSettle) continue;
    const double ratio = std::min(common / before, tolerance::kMostRatio);
    for (const std::uint32_t i : group) {
      const Vec2 rest = ratio / (1 - ratio) * points_[i].change;
      points_[i].traction += rest;
      apply(position, points_[i], rest);
    }
  }
  return worst;
}

/// Corrects the positions by the couples of the present tractions.
void Cohesion::balance(std::vector<Vec2>& position) {
  for (std::size_t i = 0; i < points_.size();) {
    const std::uint32_t couple = points_[i].couple;
    double moment = 0;
    for (; i < points_.size() && points_[i].couple == couple; ++i)
      moment += cross(points_[i].apart, points_[i].traction);
    couples_[couple].balance(position, moment);
  }
}

void Cohesion::correct(Model& model, const CrackEdges& edges, std::span<const Vec2> before,
                       const StepLength& step, double drag) {
  isCoupled_ = false;
  if (edge.empty()) return;
  collect(model, edges, before, step, drag);
  findGroups(model.nodes.size());
  std::vector<Vec2>& position = model.nodes.position;
  for (const Point& point : points_) apply(position, point, point.traction);
  // With the last step's tractions, so that only their change remains after the sweeps: it moves
  // nodes at which several cracks meet.
  balance(position);
  residual_ = 0;
  for (std::size_t g = 0; g < groups_.rows(); ++g)
    residual_ = std::max(residual_, solve(position, groups_.row(g)));
  balance(position);
}

double Cohesion::moved(const Point& point) {
  return std::max(norm(times(point.rateHere, point.change)),
                  norm(times(point.rateThere, point.change)));
}

void Cohesion::finish(Nodes& nodes, const StepLength& step) {
  if (std::exchange(isCoupled_, false)) balance(nodes.position);
  std::vector<Vec2>& velocity = nodes.velocity;
  for (const Point& point : points_) {
    velocity[point.here.value] += (1 / step.position) * times(point.rateHere, point.traction);
    velocity[point.there.value] -= (1 / step.position) * times(point.rateThere, point.traction);
  }
  for (const FaceCouple& couple : couples_) couple.push(velocity, step.position);
}

void Cohesion::addForces(std::vector<Vec2>& forces) const {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point& point = points_[i];
    forces[point.here.value] += point.area * point.traction;
    forces[point.there.value] -= point.area * point.traction;
    if (i == 0 || points_[i - 1].couple != point.couple)
      couples_[point.couple].addForces(forces, point.area);
  }
}

void Cohesion::addWork(EnergyLedger& ledger, const Model& model,
                       std::span<const Vec2> previousVelocity, const StepLength& step) const {
  const auto mean = [&](NodeId node) {
    return .5 * (previousVelocity[node.value] + model.nodes.velocity[node.value]);
  };
  for (const Point& point : points_) {
    // Relative to the faces, which rotate: the couple's work is that of the rotation.
    const Vec2 carried = -couples_[point.couple].rotation(mean) * rightOf(point.apart);
    const Vec2 apart =
        step.velocity * point.area * (mean(point.there) - mean(point.here) - carried);
    const double slip = dot(apart, -rightOf(point.normal));
    const FaceTractions& t = point.tractions;
    (t.normal < 0 ? ledger.contact : ledger.fracture) += t.normal * dot(apart, point.normal);
    ledger.fracture += t.shear * slip;
    ledger.friction += t.friction * slip;
  }
}

/// Broken ends of edges that are cohesive at the other end: they transmit no traction, but their
/// opening is needed.
void Cohesion::widenBroken(const Model& model, const CrackEdges& edges) {
  for (std::size_t c = 0; c < edge.size(); ++c) {
    const double critical = criticalOpening(model, edges, edge[c]);
    for (const std::size_t end : {0, 1}) {
      if (largest[c][end] < critical) continue;
      const auto [here, there] = nodesAt(model, edges, edge[c], static_cast<int>(end));
      const Vec2 apart = model.nodes.position[there.value] - model.nodes.position[here.value];
      largest[c][end] = std::max(largest[c][end], norm(apart));
    }
  }
}

void Cohesion::keepOpenings(const Model& model, const CrackEdges& edges) {
  const std::vector<Vec2>& position = model.nodes.position;
  for (const Point& point : points_) {
    const FaceTractions& t = point.tractions;
    traction[point.crack][point.end] = {t.normal, t.shear + t.friction};
    double& widest = largest[point.crack][point.end];
    const Vec2 apart = position[point.there.value] - position[point.here.value];
    const AcrossAlong opening{dot(apart, point.normal), dot(apart, -rightOf(point.normal))};
    widest =
        std::max(widest, effectiveOpening(opening, point.hold.shearFactor, point.hold.shearRatio));
  }
  points_.clear();
  couples_.clear();
  widenBroken(model, edges);
  const auto critical = [&](std::size_t c) { return criticalOpening(model, edges, edge[c]); };
  for (const std::uint32_t c : turned_) largest[c].fill(critical(c));
  turned_.clear();  // without a crack the next step collects nothing
  released.clear();
  keepRows(columns(), edge.size(), [&](std::size_t c) {
    const double wide = critical(c);
    const bool holds = counted(c, 0, wide) < wide || counted(c, 1, wide) < wide;
    if (!holds) released.push_back(edge[c]);
    return holds;
  });
}

void Cohesion::removeDropped(const Triangles& triangles, const CrackEdges& edges) {
  keepRows(columns(), edge.size(), [&](std::size_t c) {
    const auto& [a, b] = edges.element[edge[c].value];
    return !triangles.isDropped(a.value) && !triangles.isDropped(b.value);
  });
}

// --- While contact is solved: sweeps over the tractions at nodes that contact moves, too.

std::uint32_t Cohesion::groupOf(NodeId node) const {
  assert(groupOf_.size() == points_.size() && node.value < firstAt_.size());
  const std::uint32_t i = firstAt_[node.value];
  if (i >= points_.size() || (points_[i].here != node && points_[i].there != node)) return kNoGroup;
  return groupOf_[i];
}

void Cohesion::begin(std::span<const Vec2> position) {
  start_.clear();
  for (const Point& point : points_)
    start_.push_back({position[point.here.value], position[point.there.value]});
  const auto nodeOf = [&](std::size_t i) {
    return i % 2 == 0 ? points_[i / 2].here : points_[i / 2].there;
  };
  fillRows(
      pointsAt_, points_.size(), 2 * points_.size(),
      [&](std::size_t i) { return firstAt_[nodeOf(i).value]; },
      [](std::size_t i) { return static_cast<std::uint32_t>(i / 2); });
  waiting_.clear(points_.size());
  improved_.clear();
  isCoupled_ = true;
}

void Cohesion::noteMoved(NodeId node) {
  for (const std::uint32_t i : pointsAt_.row(firstAt_[node.value])) waiting_.add(i);
}

/// Visits all points that wait; after a change that `matters` the others at its nodes wait.
template <class Matters>
double Cohesion::improve(std::vector<Vec2>& position, Matters matters) {
  double most = 0;
  waiting_.visitUp([&](std::size_t i) {
    Point& point = points_[i];
    relax(position, point);
    most = std::max(most, moved(point));
    improved_.push_back(static_cast<std::uint32_t>(i));
    if (!matters(point)) return;
    noteMoved(point.here), noteMoved(point.there);
    if (point.isEven) waiting_.remove(i);
  });
  return most;
}

double Cohesion::sweep(std::vector<Vec2>& position, double tolerance) {
  return improve(position, [&](const Point& point) { return moved(point) > tolerance; });
}

double Cohesion::converge(std::vector<Vec2>& position) {
  for (const std::uint32_t i : improved_) waiting_.add(i);
  for (int sweep = 0; sweep < tolerance::kCohesionSweeps; ++sweep) {
    double worst = 0;
    improve(position, [&](const Point& point) {
      const double change = norm(point.change) / point.strength;
      worst = std::max(worst, change);
      return change > tolerance::kCohesionChange;
    });
    if (worst <= tolerance::kCohesionChange) break;
  }
  double most = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
    most = std::max({most, norm(position[points_[i].here.value] - start_[i][0]),
                     norm(position[points_[i].there.value] - start_[i][1])});
  return most;
}

}  // namespace yadefrag
