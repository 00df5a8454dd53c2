#pragma once
// AnyArchive for one of Boost's archives.

#include <boost/serialization/array_wrapper.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include "publish/any_archive.hpp"

namespace yadefrag {

template <class Archive>
class ArchiveOf final : public AnyArchive {
 public:
  explicit ArchiveOf(Archive& archive)
      : AnyArchive(Archive::is_loading::value), archive_(archive) {}

  /// For types that AnyArchive does not know.
  [[nodiscard]] Archive& archive() const { return archive_; }

 private:
  void exchange(const char* name, Slot slot) override {
    std::visit([&](auto* value) { archive_& boost::serialization::make_nvp(name, *value); }, slot);
  }
  void exchange(const char* name, Numbers numbers) override {
    std::visit(
        [&](auto span) {
          const auto array = boost::serialization::make_array(span.data(), span.size());
          archive_& boost::serialization::make_nvp(name, array);
        },
        numbers);
  }

  Archive& archive_;
};

}  // namespace yadefrag
