#include "meshing/joint_network.hpp"

#include <cmath>
#include <optional>

#include "core/arrays.hpp"
#include "core/tolerances/mesh.hpp"
#include "search/contact_search.hpp"

namespace yadefrag {
namespace {

Box boxOf(const JointNetwork::Line& line, double reach) {
  return {
      {std::min(line.begin.x, line.end.x) - reach, std::min(line.begin.y, line.end.y) - reach, 0},
      {std::max(line.begin.x, line.end.x) + reach, std::max(line.begin.y, line.end.y) + reach, 0}};
}

/// The intersection, if it is within both lines.
std::optional<Vec2> crossingOf(const JointNetwork::Line& a, const JointNetwork::Line& b) {
  const double sine = cross(a.along(), b.along());
  if (sine == 0) return std::nullopt;
  const double onA = cross(b.begin - a.begin, b.along()) / sine;
  const double onB = cross(b.begin - a.begin, a.along()) / sine;
  if (onA < 0 || onA > 1 || onB < 0 || onB > 1) return std::nullopt;
  return a.begin + onA * a.along();
}

std::vector<BoxPair> sortedPairs(const std::vector<Box>& boxes) {
  std::vector<BoxPair> pairs = overlappingPairs(boxes);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

JointNetwork::JointNetwork(const std::vector<const std::vector<Vec2>*>& loops,
                           const JointLines& joints, const SizeField& size, double tolerance)
    : size_(size), tolerance_(tolerance), grid_(size.largest()) {
  for (const auto* loop : loops)
    for (std::size_t i = 0; i < loop->size(); ++i) {
      newPoint((*loop)[i]);
      edges_.push_back({(*loop)[i], (*loop)[(i + 1) % loop->size()]});
    }
  for (const auto& [begin, end] : joints) joints_.push_back({begin, end});
}

void JointNetwork::join() {
  if (joints_.empty()) return;
  addCrossings();
  startChains();
  for (int round = 0; round < tolerance::kJointRounds; ++round)
    if (!bend()) return;
}

double JointNetwork::reachAt(Vec2 p) const {
  return std::max(tolerance_, tolerance::kJointMeets * size_.at(p));
}

std::uint32_t JointNetwork::newPoint(Vec2 p) {
  const auto number = static_cast<std::uint32_t>(points_.size());
  points_.push_back(p);
  grid_.insert(p, size_.at(p), number);
  return number;
}

/// A place of a joint, at p so far, is now at a point.
void JointNetwork::count(Vec2 p, std::uint32_t point) {
  const double way = norm(points_[point] - p);
  if (way <= tolerance::kJointMeets * size_.at(p)) return;
  places_.insert(point);
  joined_.count = places_.size();
  joined_.farthest = std::max(joined_.farthest, way);
}

/// The known point nearest to p within the tolerance, or a new one, on an edge within the
/// tolerance.
std::uint32_t JointNetwork::pointAt(Vec2 p) {
  const auto known = [&](Vec2 at) {
    std::uint32_t nearest = static_cast<std::uint32_t>(points_.size());
    double least = reachAt(at);
    (void)grid_.any(at, size_.at(at), least, 0, [&](std::uint32_t i) {
      const double way = norm(points_[i] - at);
      if (way < least || (way == least && i < nearest)) least = way, nearest = i;
      return false;
    });
    return nearest;
  };
  if (const std::uint32_t point = known(p); point < points_.size()) return count(p, point), point;
  std::uint32_t edge = 0;
  double least = INFINITY;
  for (std::uint32_t i = 0; i < edges_.size(); ++i)
    if (const double way = edges_[i].distanceTo(p); way < least) least = way, edge = i;
  if (!(least <= reachAt(p))) return newPoint(p);
  const bool isOn = least <= tolerance::kJointMeets * size_.at(p);
  const Vec2 foot = isOn ? p : edges_[edge].nearest(p);
  std::uint32_t point = known(foot);
  if (point == points_.size()) {
    point = newPoint(foot);
    onEdge_.emplace_back(edge, point);
  }
  count(p, point);
  return point;
}

void JointNetwork::addCrossings() {
  std::vector<Box> boxes;
  for (const std::vector<Line>* lines : {&edges_, &joints_})
    for (const Line& line : *lines)
      boxes.push_back(boxOf(line, std::max(reachAt(line.begin), reachAt(line.end))));
  const std::size_t first = edges_.size();
  const std::vector<BoxPair> pairs = sortedPairs(boxes);
  // Those with edges come first: points near them lie on them.
  for (const auto& [a, b] : pairs)
    if (a.value < first && b.value >= first) addCrossing(joints_[b.value - first], edges_[a.value]);
  for (const auto& [a, b] : pairs)
    if (a.value >= first) addCrossing(joints_[a.value - first], joints_[b.value - first]);
}

/// A joint that ends before it reaches the other line, within the tolerance, crosses it, too.
void JointNetwork::addCrossing(const Line& a, const Line& b) {
  const auto longer = [&](const Line& line) {
    const Vec2 unit = (1 / norm(line.along())) * line.along();
    return Line{line.begin - reachAt(line.begin) * unit, line.end + reachAt(line.end) * unit};
  };
  auto p = crossingOf(longer(a), longer(b));
  if (!p) return;
  for (const Vec2 end : {a.begin, a.end, b.begin, b.end})  // exactly, without rounding
    if (norm(end - *p) <= tolerance::kJointMeets * size_.at(end)) p = end;
  (void)pointAt(*p);
}

void JointNetwork::startChains() {
  for (const Line& joint : joints_) {
    Chain chain{pointAt(joint.begin), pointAt(joint.end)};
    if (chain[0] == chain[1]) chain.pop_back();
    chains_.push_back(std::move(chain));
  }
}

std::vector<JointNetwork::Side> JointNetwork::chainSides() const {
  std::vector<Side> sides;
  for (const Chain& chain : chains_)
    for (std::size_t i = 1; i < chain.size(); ++i)
      sides.push_back(std::minmax(chain[i - 1], chain[i]));
  sortUnique(sides);
  return sides;
}

std::vector<JointNetwork::Chain> JointNetwork::pointsOnEdges() const {
  std::vector<Chain> result(edges_.size());
  for (const auto& [edge, point] : onEdge_) result[edge].push_back(point);
  for (std::size_t e = 0; e < edges_.size(); ++e)
    std::sort(result[e].begin(), result[e].end(), [&](std::uint32_t a, std::uint32_t b) {
      return edges_[e].footOf(points_[a]) < edges_[e].footOf(points_[b]);
    });
  return result;
}

std::vector<JointNetwork::Side> JointNetwork::edgeSides() const {
  std::vector<Side> sides;
  const std::vector<Chain> within = pointsOnEdges();
  // The points of the loops are numbered in the order of the edges.
  for (std::uint32_t e = 0, first = 0; e < edges_.size(); ++e) {
    std::uint32_t from = e;
    for (const std::uint32_t point : within[e]) {
      sides.push_back(std::minmax(from, point));
      from = point;
    }
    const bool closes = e + 1 == edges_.size() || points_[e + 1] != edges_[e].end;
    sides.push_back(std::minmax(from, closes ? first : e + 1));
    if (closes) first = e + 1;
  }
  return sides;
}

/// Chains bend to the points that they pass, and get a point where they cross. False if there is
/// none.
bool JointNetwork::bend() {
  const std::vector<Side> own = chainSides(), fixed = edgeSides();
  const auto numPoints = static_cast<std::uint32_t>(points_.size());
  std::vector<Box> boxes;
  for (const std::vector<Side>* sides : {&own, &fixed})
    for (const Side& side : *sides) boxes.push_back(boxOf(lineOf(side), 0));
  for (const Vec2 p : points_) boxes.push_back(boxOf({p, p}, reachAt(p)));
  const std::size_t firstFixed = own.size(), firstPoint = firstFixed + fixed.size();
  for (const auto& [first, second] : sortedPairs(boxes)) {
    const std::size_t a = first.value, b = second.value;
    if (a >= firstFixed) continue;
    if (b >= firstPoint)
      pass(own[a], static_cast<std::uint32_t>(b - firstPoint));
    else
      meet(own[a], b < firstFixed ? own[b] : fixed[b - firstFixed], b >= firstFixed);
  }
  return applyInsertions() || points_.size() > numPoints;
}

void JointNetwork::pass(Side side, std::uint32_t point) {
  if (point == side.first || point == side.second) return;
  const Line line = lineOf(side);
  const Vec2 p = points_[point];
  // Within the circle around the side: an acute bend would let the next side pass the point before.
  if (dot(line.begin - p, line.end - p) >= 0 || line.distanceTo(p) > reachAt(p)) return;
  count(line.nearest(p), point);
  insertions_[side].insert(point);
}

void JointNetwork::meet(Side a, Side b, bool isEdge) {
  if (a.first == b.first || a.first == b.second || a.second == b.first || a.second == b.second)
    return;
  const auto p = crossingOf(lineOf(a), lineOf(b));
  if (!p) return;
  const std::uint32_t point = pointAt(*p);
  if (point != a.first && point != a.second) insertions_[a].insert(point);
  if (!isEdge && point != b.first && point != b.second) insertions_[b].insert(point);
}

/// Inserts points into chains, in their order along each side. A chain that returns to a point is
/// cut short there.
bool JointNetwork::applyInsertions() {
  if (insertions_.empty()) return false;
  for (Chain& chain : chains_) {
    Chain longer;
    const auto append = [&](std::uint32_t point) {
      const auto known = std::find(longer.begin(), longer.end(), point);
      if (known != longer.end()) return longer.erase(known + 1, longer.end()), void();
      longer.push_back(point);
    };
    for (std::size_t i = 0; i < chain.size(); ++i) {
      append(chain[i]);
      if (i + 1 == chain.size()) break;
      const auto found = insertions_.find(std::minmax(chain[i], chain[i + 1]));
      if (found == insertions_.end()) continue;
      Chain within(found->second.begin(), found->second.end());
      const Line line{points_[chain[i]], points_[chain[i + 1]]};
      std::stable_sort(within.begin(), within.end(), [&](std::uint32_t a, std::uint32_t b) {
        return line.footOf(points_[a]) < line.footOf(points_[b]);
      });
      for (const std::uint32_t point : within) append(point);
    }
    chain = std::move(longer);
  }
  insertions_.clear();
  return true;
}

}  // namespace yadefrag
