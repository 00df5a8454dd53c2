#pragma once
// The reader of polygon files, for Python.

#include <string>

#include "abi/yade.hpp"

namespace yadefrag {

/// (outline, holes) as lists of pairs; ValueError as polygonFromText.
yade::py::tuple polygonOfText(const std::string& text);

}  // namespace yadefrag
