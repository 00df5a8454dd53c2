#pragma once
// What the arrays of a scene are for, and how long they are.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace yadefrag {

enum class Use : std::uint8_t {
  kMesh,       ///< nodes, triangles, bodies
  kDynamics,   ///< the step without contact
  kHeld,       ///< nodes with a prescribed motion
  kMaterials,  ///< of bodies with several
  kLoads,      ///< constant and outer forces
  kViscosity,  ///< bulk viscosity
  kSmoothing,  ///< smoothed strains
  kSurfaces,   ///< the two layers of the boundary
  kSmooth,     ///< parts of it that are C¹-smooth
  kSearch,     ///< the global search and its candidates
  kContact,    ///< what touches
  kFriction,
  kFracture,
  kCohesion,
  kCount
};

/// Bytes as allocated, which may be more than what is in the arrays.
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
    std::size_t sum = arrays.capacity() * sizeof(std::vector<T>);
    for (const std::vector<T>& array : arrays) sum += bytesOf(array);
    return sum;
  }

  std::array<std::size_t, static_cast<std::size_t>(Use::kCount)> bytes_{};
};

}  // namespace yadefrag
