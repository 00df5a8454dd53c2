#pragma once
// Finds materials that a script changes after bodies have been made of them: these keep the values
// that the materials had when they were added.

#include <string>
#include <vector>

#include "fe/materials.hpp"

namespace yadefrag {

class MaterialWatch {
 public:
  void add(const yade::shared_ptr<FEMat>& material);
  /// One sentence for each changed attribute of a material.
  [[nodiscard]] std::vector<std::string> sentences() const;

 private:
  struct Used {
    yade::shared_ptr<FEMat> material;
    std::vector<double> values;  // as in `valuesOf`
  };
  std::vector<Used> used_;
};

}  // namespace yadefrag
