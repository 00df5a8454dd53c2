#pragma once
// The reader of polygon files, and grains, for Python.

#include <cstdint>
#include <string>

#include "abi/yade.hpp"

namespace yadefrag {

/// (outline, holes) as lists of pairs; ValueError as polygonFromText.
yade::py::tuple polygonOfText(const std::string& text);

/// The grains of outline/voronoi.hpp, as lists of pairs; `outline` is an array of its points.
yade::py::list voronoiOf(const yade::py::object& outline, std::uint32_t count, std::uint64_t seed,
                         int rounds, double shortest);

}  // namespace yadefrag
