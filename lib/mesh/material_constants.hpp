#pragma once
// The constants of materials. Each is listed once, with its limits and its docstring: checks, saved
// states and Python's attributes are made from these lists, so that a new constant needs a member
// of its struct and a line in material_constants.cpp.

#include <fmt/core.h>

#include <span>
#include <string>
#include <string_view>

#include "mesh/body_material.hpp"

namespace yadefrag {

/// A sentence about a value that is refused; `unit` with a leading space, or empty; `right`: what
/// it must be.
inline std::string wrongValue(std::string_view name, double value, std::string_view unit,
                              std::string_view right) {
  return fmt::format("{} is {:g}{}; it must be {}.", name, value, unit, right);
}

struct Limits {
  bool (*hold)(double value);
  const char* words;  ///< what a value must be
};

template <class Material>
struct Constant {
  const char* name;  ///< in Python, messages and saved states
  const char* unit;  ///< with a leading space, or empty
  double Material::*member;
  Limits limits;
  const char* doc = "";  ///< empty: the attribute is not the member itself
};

template <class Material>
struct Constants : std::span<const Constant<Material>> {
  using std::span<const Constant<Material>>::span;

  /// Empty, or a sentence on the first value beyond its limits.
  [[nodiscard]] std::string wrong(const Material& of) const {
    for (const Constant<Material>& one : *this)
      if (!one.limits.hold(of.*one.member)) return wrong(of, one.member, one.limits.words);
    return {};
  }
  /// A sentence on a value that does not fit to the others; `right`: what it must be.
  [[nodiscard]] std::string wrong(const Material& of, double Material::*member,
                                  const char* right) const {
    for (const Constant<Material>& one : *this)
      if (one.member == member) return wrongValue(one.name, of.*member, one.unit, right);
    return right;
  }
};

[[nodiscard]] Constants<ElasticMaterial> elasticConstants();
/// A strength of 0 is within its limits: such a material never cracks.
[[nodiscard]] Constants<BrittleMaterial> brittleConstants();
/// Of a material that yields: a metal, or one that yields by friction.
[[nodiscard]] Constants<PlasticMaterial> metalConstants();
[[nodiscard]] Constants<PlasticMaterial> coneConstants();
[[nodiscard]] Constants<FailureLaw> failureConstants();

}  // namespace yadefrag
