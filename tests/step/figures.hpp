#pragma once
// Measured figures that a report can be made of: in the XML output, and in the message of a
// failure.

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

namespace yadefrag::test {

inline void record(const std::string& name, double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  ::testing::Test::RecordProperty(name, text);
}

/// Records a value and expects it within `tolerance` of `wanted`.
inline void figure(const std::string& name, double value, double wanted, double tolerance) {
  record(name, value);
  EXPECT_NEAR(value, wanted, tolerance) << name;
}

}  // namespace yadefrag::test
