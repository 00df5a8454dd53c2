#pragma once
// Defines kindOf<Value>(). Only the sources that list the types of attributes include it: `template
// const ValueKind& kindOf<T>();`.

#include <type_traits>

#include "yade/any_archive.hpp"
#include "yade/archives.hpp"
#include "yade/attribute.hpp"

namespace yadefrag {

/// For values of which the archive itself has to know the type; false: it is another archive.
template <class Archive, class Value>
bool archiveIn(AnyArchive& archive, const char* name, Value& value) {
  auto* const known = dynamic_cast<ArchiveOf<Archive>*>(&archive);
  if (known != nullptr) known->archive() & boost::serialization::make_nvp(name, value);
  return known != nullptr;
}

template <class Value>
struct ValueFunctions {
  static constexpr bool kIsPlain =
      std::is_arithmetic_v<Value> || std::is_same_v<Value, std::string>;
  static constexpr bool kIsVector = std::is_base_of_v<Eigen::MatrixBase<Value>, Value>;

  static const Value& at(const void* slot) { return *static_cast<const Value*>(slot); }
  static Value& at(void* slot) { return *static_cast<Value*>(slot); }

  static yade::py::object copy(const void* slot) { return yade::py::object(at(slot)); }
  static yade::py::object reference(void* slot, const yade::py::object& owner) requires kIsVector {
    yade::py::object result(yade::py::ptr(&at(slot)));
    yade::py::objects::make_nurse_and_patient(result.ptr(), owner.ptr());
    return result;
  }
  static void set(void* slot, const yade::py::object& value) {
    at(slot) = yade::py::extract<Value>(value)();
  }
  static void archive(AnyArchive& archive, const char* name, void* slot) {
    if constexpr (kIsPlain) {
      archive.item(name, at(slot));
    } else {
      namespace from = boost::archive;
      [[maybe_unused]] const bool isKnown =
          archiveIn<from::xml_oarchive>(archive, name, at(slot)) ||
          archiveIn<from::xml_iarchive>(archive, name, at(slot)) ||
          archiveIn<from::binary_oarchive>(archive, name, at(slot)) ||
          archiveIn<from::binary_iarchive>(archive, name, at(slot));
      assert(isKnown);
    }
  }
  static double number(const void* slot) requires std::is_arithmetic_v<Value> {
    return static_cast<double>(at(slot));
  }
};

template <class Value>
const ValueKind& kindOf() {
  using F = ValueFunctions<Value>;
  static const ValueKind kind = [] {
    ValueKind made = {&F::copy, nullptr, &F::set, &F::archive, nullptr};
    if constexpr (F::kIsVector) made.reference = &F::reference;
    if constexpr (std::is_arithmetic_v<Value>) made.number = &F::number;
    return made;
  }();
  return kind;
}

}  // namespace yadefrag
