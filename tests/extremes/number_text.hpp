#pragma once
// Numbers as the manual's tables write them, and read back.

#include <string>

namespace yadefrag::test {

/// Two digits: 10⁻⁹, 3.2·10⁵, 0.02, 47; – for NAN, ∞.
std::string numberText(double value);

/// The reverse; NAN for what is no number.
double numberOf(const std::string& text);

}  // namespace yadefrag::test
