#include "step/apart_bodies.hpp"

#include <algorithm>

#include "core/tolerances/step.hpp"
#include "search/overlapping_pairs.hpp"
#include "step/body_places.hpp"

namespace yadefrag {

namespace {

/// Boxes around the surface of each body; arcs are inside the hull of their nodes.
std::vector<Box> bodyBoxes(const Model& model, const ContactSurfaces& surfaces, double margin) {
  std::vector<Box> boxes(model.components.size(), Box::absent());
  const Nodes& nodes = model.nodes;
  for (const NodeId node : surfaces.segmentNode) {
    if (nodes.mass[node.value] == 0) continue;  // of a removed triangle
    include(boxes[nodes.component[node.value].value], nodes.position[node.value]);
  }
  for (Box& box : boxes)
    for (std::size_t axis = 0; axis < 2; ++axis) box.min[axis] -= margin, box.max[axis] += margin;
  return boxes;
}

/// Removed bodies keep their numbers. A body that can touch itself is always checked.
bool mayBeApart(const Component& body) {
  return body.firstTriangle < body.lastTriangle && !body.selfContact;
}

/// (m) Lower bound of the distance of two bodies, from their boxes with margins.
double gapBetween(const Box& a, const Box& b, double margin) {
  const double x = std::max(a.min[0] - b.max[0], b.min[0] - a.max[0]);
  const double y = std::max(a.min[1] - b.max[1], b.min[1] - a.max[1]);
  return std::max(x, y) + 2 * margin;
}

}  // namespace

std::vector<ApartBodies::Gap> ApartBodies::gapsBelow(const Model& model,
                                                     const ContactSurfaces& surfaces,
                                                     double width) {
  const std::vector<Box> boxes = bodyBoxes(model, surfaces, width / 2);
  const bool few = boxes.size() <= tolerance::kFewBoxes;
  const SearchMethod method = few ? SearchMethod::kBruteForce : SearchMethod::kLebesgue;
  const std::vector<BoxPair> pairs = overlappingPairs(boxes, 1, method);
  std::vector<Gap> gaps;
  gaps.reserve(pairs.size());
  for (const auto& [first, second] : pairs)
    gaps.push_back({ComponentId(first.value), ComponentId(second.value),
                    gapBetween(boxes[first.value], boxes[second.value], width / 2)});
  return gaps;
}

void ApartBodies::takeFrom(const Model& model, std::span<const NodeId> watched) {
  apart_.clear();
  for (const Component& body : model.components) apart_.push_back(mayBeApart(body) ? 1 : 0);
  for (const NodeId node : watched) apart_[model.nodes.component[node.value].value] = 0;
  former_ = apart_;
  count_ = std::count(apart_.begin(), apart_.end(), 1);
  spare_ = -1;
}

bool ApartBodies::choose(const Model& model, const ContactSurfaces& surfaces, double reach) {
  std::swap(former_, apart_);
  const std::size_t bodies = model.components.size();
  apart_.resize(bodies);
  for (std::size_t c = 0; c < bodies; ++c) apart_[c] = mayBeApart(model.components[c]) ? 1 : 0;
  count_ = std::count(apart_.begin(), apart_.end(), 1);
  if (count_ > 0) {
    const double widest = tolerance::kApartSearch * reach;
    const std::vector<Gap> gaps = gapsBelow(model, surfaces, widest);
    for (const Gap& gap : gaps)
      if (gap.width <= tolerance::kApart * reach) apart_[gap.a.value] = apart_[gap.b.value] = 0;
    count_ = std::count(apart_.begin(), apart_.end(), 1);
    measure(gaps, widest, reach);
  }
  return apart_ != former_;
}

void ApartBodies::look(const Model& model, const ContactSurfaces& surfaces, double reach) {
  const double widest = tolerance::kApartSearch * reach;
  measure(gapsBelow(model, surfaces, widest), widest, reach);
}

void ApartBodies::measure(const std::vector<Gap>& gaps, double widest, double reach) {
  spare_ = widest - reach;
  for (const Gap& gap : gaps)
    if (isApart(gap.a) || isApart(gap.b)) spare_ = std::min(spare_, gap.width - reach);
}

}  // namespace yadefrag
