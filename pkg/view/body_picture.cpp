#include "view/body_picture.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/element_state.hpp"
#include "fe/fe_solver.hpp"
#include "script/fragments.hpp"

namespace yadefrag {
namespace {

/// A colour with full saturation and brightness; `turn`: 0 red, 1/3 green, 2/3 blue.
Colour hue(double turn) {
  Colour colour;
  for (int k = 0; k < 3; ++k) {
    const double away = std::abs(std::remainder(turn - k / 3., 1.)) * 6;
    colour[static_cast<std::size_t>(k)] = static_cast<float>(std::clamp(2 - away, 0., 1.));
  }
  return colour;
}

/// Von Mises stress of each triangle.
std::vector<double> misesOf(const Model& model) {
  std::vector<double> values = stressesAcross(model);
  std::size_t e = 0;
  for (const auto& [xx, yy, xy] : stresses(model)) {
    const double x = yy - values[e], y = values[e] - xx, z = xx - yy;
    values[e++] = std::sqrt((x * x + y * y + z * z) / 2 + 3 * xy * xy);
  }
  return values;
}

std::vector<Colour> coloursOf(const FESolver& solver, const std::string& field) {
  const Model& model = solver.world().model;
  std::vector<Colour> colours;
  if (field == "mises") {
    const std::vector<double> values = misesOf(model);
    const double most = values.empty() ? 0 : *std::ranges::max_element(values);
    for (const double value : values)
      colours.push_back(hue(2. / 3 * (1 - value / (most + 1e-300))));
    return colours;
  }
  std::vector<std::uint32_t> numbers;
  if (field == "fragment") findFragments(model, &numbers, &solver.world().fracture);
  for (std::size_t e = 0; e < model.triangles.size(); ++e)
    colours.push_back(colourOf(numbers.empty() ? model.triangles.component[e].value : numbers[e]));
  return colours;
}

void addHeld(const FESolver& solver, std::vector<BodyPicture>& pictures) {
  const World& world = solver.world();
  for (const EdgeId edge : world.fracture.cohesion.edge) {
    const Side side = world.fracture.edges.side(edge, 0);
    const ElementId element = world.fracture.edges.element[edge.value][0];
    const auto at = [&](NodeId node) { return world.model.nodes.position[node.value]; };
    pictures[world.model.triangles.component[element.value].value].held.push_back(
        {at(firstNode(world.model, side)), at(lastNode(world.model, side))});
  }
}

}  // namespace

/// Hues at golden-section distances, with three steps of brightness.
Colour colourOf(std::uint32_t number) {
  Colour colour = hue(std::fmod(.6 + .6180339887498949 * number, 1.));
  const float bright = 1 - .2F * static_cast<float>(number % 3);
  for (float& part : colour) part = bright * (.25F + .75F * part);
  return colour;
}

std::vector<BodyPicture> picturesOf(const FESolver& solver, const std::string& field) {
  const World& world = solver.world();
  const ContactSurfaces& surfaces = world.surfaces;
  std::vector<BodyPicture> pictures(world.model.components.size());
  const auto at = [&](NodeId node) { return world.model.nodes.position[node.value]; };
  const std::vector<Colour> colours = coloursOf(solver, field);
  for (std::size_t e = 0; e < colours.size(); ++e) {
    if (world.model.triangles.isDropped(e)) continue;
    const auto& [a, b, c] = world.model.triangles.nodes[e];
    pictures[world.model.triangles.component[e].value].triangles.push_back(
        {{at(a), at(b), at(c)}, colours[e]});
  }
  for (std::size_t s = 0; s < surfaces.segments(); ++s) {
    if (surfaces.isGone(SegmentId(s))) continue;
    const EntryId entry = surfaces.segmentEntry[s];
    const NodeId next = surfaces.segmentNode[surfaces.segmentNext[s].value];
    pictures[surfaces.component[entry.value].value].outline.push_back(
        {at(surfaces.segmentNode[s]), at(next)});
  }
  const std::size_t entries = std::min(surfaces.entries(), solver.entryBodies().ids().size());
  for (std::size_t e = entries; e-- > 0;)
    if (solver.entryBodies().hasBody(EntryId(e)))
      pictures[surfaces.component[e].value].entry = static_cast<int>(e);
  addHeld(solver, pictures);
  return pictures;
}

}  // namespace yadefrag
