#include "fracture/bonds.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/errors.hpp"
#include "core/tolerances/fracture.hpp"
#include "search/contact_search.hpp"

namespace yadefrag {
namespace {

std::string named(ComponentId a, ComponentId b) {
  return fmt::format("the bodies {} and {}", a.value, b.value);
}

}  // namespace

CommonSides commonSides(const Model& model, const CrackEdges& edges,
                        std::span<const ComponentId> bodies, double reach) {
  const auto [sides, owners] = FreeSides(model, edges, bodies);
  const std::vector<Line> lines = linesOf(model, model.nodes.position, sides);
  CommonSides result;
  std::vector<std::uint8_t> isMatched(sides.size());
  std::vector<BoxPair> others;
  for (const BoxPair& pair : nearPairs(lines, reach)) {
    const std::size_t i = pair.first.value, k = pair.second.value;
    if (owners[i] == owners[k]) continue;
    if (isMatched[i] == 0 && isMatched[k] == 0 && match(lines[i], lines[k])) {
      result.pairs.push_back({sides[i], sides[k]});
      isMatched[i] = isMatched[k] = 1;
    } else if (runAlong(lines[i], lines[k], reach)) {
      others.push_back(pair);
    }
  }
  for (const auto& [first, second] : others)
    for (const std::size_t i : {first.value, second.value}) {
      if (isMatched[i] != 0) continue;
      isMatched[i] = 1;  // counted once
      if (result.unmatched++ > 0) continue;
      result.bodies = {owners[first.value], owners[second.value]};
      result.place = .5 * (lines[i].begin + lines[i].end);
    }
  return result;
}

void requireMatch(const CommonSides& found, ComponentId a, ComponentId b) {
  if (found.unmatched > 0)
    throw InputError(fmt::format(
        "At ({:g}, {:g}) sides of {} coincide but have different ends, and these cannot be moved "
        "onto each other: they are too near each other, or nodes of other bonds; bondAll with a "
        "tolerance of that distance, or snapOutlines before the bodies are added, may help.",
        found.place.x, found.place.y, named(a, b)));
  if (found.pairs.empty())
    throw InputError(
        fmt::format("No sides of {} that are not bonded yet lie on each other; bodies to be bonded "
                    "must touch along sides.",
                    named(a, b)));
}

void checkBond(double strength, double energy) {
  const auto require = [](const char* name, double value, const char* unit) {
    if (value > 0 && std::isfinite(value)) return;
    throw InputError(fmt::format("{} is {:g}{}; that of a bond must be positive and finite.", name,
                                 value, unit));
  };
  require("strength", strength, " Pa");
  require("energy", energy, " J/m²");
}

std::vector<Side> freeSides(const Model& model, const CrackEdges& edges, ComponentId component) {
  const std::vector<KeyedSide> sides = sidesByNodes(model, model.components[component.value]);
  std::vector<Side> result;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i + 1 < sides.size() && sides[i].joins(sides[i + 1])) {
      ++i;
      continue;
    }
    const Side side = sides[i].side;
    if (side.element.value >= edges.ofElement.size() ||
        edges.ofElement[side.element.value][side.corner] == EdgeId::none())
      result.push_back(side);
  }
  std::sort(result.begin(), result.end());
  return result;
}

FreeSides::FreeSides(const Model& model, const CrackEdges& edges,
                     std::span<const ComponentId> bodies) {
  for (const ComponentId body : bodies) {
    const std::vector<Side> own = freeSides(model, edges, body);
    sides.insert(sides.end(), own.begin(), own.end());
    owners.resize(sides.size(), body);
  }
}

std::vector<Line> linesOf(const Model& model, std::span<const Vec2> places,
                          std::span<const Side> sides) {
  std::vector<Line> lines;
  lines.reserve(sides.size());
  for (const Side side : sides)
    lines.push_back({places[firstNode(model, side).value], places[lastNode(model, side).value]});
  return lines;
}

/// Equal outlines may differ by some roundings of their coordinates.
double samePlace(double length, Vec2 a, Vec2 b) {
  const double farthest = std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
  return std::max(tolerance::kBondGap * length,
                  8 * std::numeric_limits<double>::epsilon() * farthest);
}

bool match(const Line& a, const Line& b) {
  const double length = std::min(a.length(), b.length());
  const double gap = std::max(samePlace(length, a.begin, a.end), samePlace(length, b.begin, b.end));
  return norm(a.begin - b.end) <= gap && norm(a.end - b.begin) <= gap;
}

double reachOf(double length, double reach) {
  return reach > 0 ? reach : tolerance::kProbableBond * length;
}

bool runAlong(const Line& a, const Line& b, double reach) {
  // Along the longer one: the ends of the longer one may be far from the extended shorter one.
  if (b.length() > a.length()) return runAlong(b, a, reach);
  const double near = reachOf(b.length(), reach);
  const Vec2 along = (1 / a.length()) * (a.end - a.begin);
  const auto aside = [&](Vec2 x) { return std::abs(cross(along, x - a.begin)); };
  const double from = dot(along, b.end - a.begin), to = dot(along, b.begin - a.begin);
  return from < to && aside(b.begin) <= near && aside(b.end) <= near &&
         std::min(to, a.length()) - std::max(from, 0.) > near;
}

std::vector<BoxPair> nearPairs(const std::vector<Line>& lines, double reach) {
  std::vector<Box> boxes;
  for (const Line& l : lines) {
    const double by = reachOf(l.length(), reach);
    boxes.push_back({{std::min(l.begin.x, l.end.x) - by, std::min(l.begin.y, l.end.y) - by, 0},
                     {std::max(l.begin.x, l.end.x) + by, std::max(l.begin.y, l.end.y) + by, 0}});
  }
  std::vector<BoxPair> pairs = overlappingPairs(boxes);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace yadefrag
