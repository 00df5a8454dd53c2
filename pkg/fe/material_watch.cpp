#include "fe/material_watch.hpp"

#include <fmt/core.h>

#include <utility>

#include "fe/plastic_materials.hpp"

namespace yadefrag {
namespace {

using Values = std::vector<std::pair<const char*, double>>;

void add(Values& all, const FEMat& material, const Attributes& attributes) {
  for (const Attribute& one : attributes)
    if (one.kind->number != nullptr)
      all.emplace_back(one.name, one.kind->number(one.slot(material)));
}

Values valuesOf(const FEMat& material) {
  Values all = {{"young", material.young},
                {"poisson", material.poisson},
                {"density", material.density},
                {"frictionAngle", material.frictionAngle}};
  add(all, material, FEMat::attributes());
  const auto addIf = [&]<class Kind>(const Kind* /*kind*/) {
    if (dynamic_cast<const Kind*>(&material) != nullptr) add(all, material, Kind::attributes());
  };
  addIf(static_cast<const BrittleFEMat*>(nullptr));
  addIf(static_cast<const PlasticFEMat*>(nullptr));
  addIf(static_cast<const FrictionalFEMat*>(nullptr));
  return all;
}

std::vector<double> numbersOf(const FEMat& material) {
  std::vector<double> numbers;
  for (const auto& [name, value] : valuesOf(material)) numbers.push_back(value);
  return numbers;
}

}  // namespace

void MaterialWatch::add(const yade::shared_ptr<FEMat>& material) {
  std::vector<double> values = numbersOf(*material);
  for (const Used& used : used_)
    if (used.material == material && used.values == values) return;
  used_.push_back({material, std::move(values)});
}

std::vector<std::string> MaterialWatch::sentences() const {
  std::vector<std::string> found;
  for (const Used& used : used_) {
    const Values now = valuesOf(*used.material);
    const std::string label = used.material->label.empty()
                                  ? fmt::format("number {}", used.material->id)
                                  : fmt::format("'{}'", used.material->label);
    for (std::size_t i = 0; i < now.size(); ++i)
      if (now[i].second != used.values[i])
        found.push_back(fmt::format(
            "{} of material {} was changed from {:g} to {:g} after bodies had been made of it: "
            "they keep {:g}; set it before addPolygon, or remove these bodies and add them again.",
            now[i].first, label, used.values[i], now[i].second, used.values[i]));
  }
  return found;
}

}  // namespace yadefrag
