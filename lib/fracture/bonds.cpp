#include "fracture/bonds.hpp"

#include <fmt/core.h>

#include <cmath>
#include <string>

#include "core/errors.hpp"
#include "fracture/side_lines.hpp"

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

}  // namespace yadefrag
