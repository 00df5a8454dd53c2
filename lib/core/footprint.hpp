#pragma once
// Memory of a scene, by the use of its arrays.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/parallel.hpp"

namespace yadefrag {

enum class Use : std::uint8_t {
  kMesh,        ///< nodes, triangles, bodies
  kDynamics,    ///< the time integration without contact
  kHeld,        ///< nodes with a prescribed motion
  kMaterials,   ///< of bodies with several materials
  kLoads,       ///< constant and external forces
  kViscosity,   ///< bulk viscosity
  kSmoothing,   ///< smoothed strains
  kPlasticity,  ///< materials that yield
  kSurfaces,    ///< the two layers of the boundary
  kSmooth,      ///< the C¹-smooth parts of the boundary
  kSearch,      ///< the global search and its candidates
  kContact,     ///< actives and their forces
  kFracture,
  kCohesion,
  kCount
};

/// Allocated bytes; the arrays may use less.
class Footprint {
 public:
  template <class... Arrays>
  void add(Use use, const Arrays&... arrays) {
    ((bytes_[static_cast<std::size_t>(use)] += bytesOf(arrays)), ...);
  }

  [[nodiscard]] std::size_t of(Use use) const { return bytes_[static_cast<std::size_t>(use)]; }
  [[nodiscard]] std::size_t total() const {
    std::size_t sum = 0;
    for (const std::size_t bytes : bytes_) sum += bytes;
    return sum;
  }

 private:
  template <class T>
  static std::size_t bytesOf(const std::vector<T>& array) {
    return array.capacity() * sizeof(T);
  }
  template <class T>
  static std::size_t bytesOf(const std::vector<std::vector<T>>& arrays) {
    return bytesOfAll(arrays);
  }
  template <class T>
  static std::size_t bytesOf(const std::vector<PartList<T>>& arrays) {
    return bytesOfAll(arrays);
  }
  template <class Arrays>
  static std::size_t bytesOfAll(const Arrays& arrays) {
    std::size_t sum = arrays.capacity() * sizeof(typename Arrays::value_type);
    for (const auto& array : arrays) sum += array.capacity() * sizeof(array[0]);
    return sum;
  }

  std::array<std::size_t, static_cast<std::size_t>(Use::kCount)> bytes_{};
};

}  // namespace yadefrag
