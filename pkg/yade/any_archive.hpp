#pragma once
// One of YADE's four archives (XML and binary, to and from a file) behind two virtual functions. As
// templates over the archive, all that is saved would be compiled four times.

#include <boost/serialization/array_wrapper.hpp>
#include <boost/serialization/nvp.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "core/errors.hpp"

namespace yadefrag {

class AnyArchive {
 public:
  AnyArchive(const AnyArchive&) = delete;
  AnyArchive& operator=(const AnyArchive&) = delete;
  virtual ~AnyArchive() = default;

  [[nodiscard]] bool isLoading() const { return isLoading_; }

  /// Saves the value under this name, or loads it.
  template <class Value>
  void item(const char* name, Value& value) {
    exchange(name, Slot(&value));
  }
  /// Saves `count` numbers under this name, or loads them.
  template <class Number>
  void numbers(const char* name, Number* first, std::size_t count) {
    exchange(name, Numbers(std::span(first, count)));
  }
  /// Rows as two columns, of whole numbers and of others: `visit(row, each)` calls `each` with each
  /// member of a row, which is an int, a bool or a double. Throws InputError if the columns do not
  /// fit to each other; `what`: whose state it is, and what is wrong with it.
  template <class Row, class Visit>
  void rows(const char* wholeName, const char* realName, std::vector<Row>& rows, const char* what,
            const Visit& visit) {
    std::vector<int> whole;
    std::vector<double> real;
    const auto append = [&]<class Member>(Member& member) {
      if constexpr (std::is_same_v<Member, double>)
        real.push_back(member);
      else
        whole.push_back(member);
    };
    for (Row& row : rows) visit(row, append);
    item(wholeName, whole), item(realName, real);
    if (!isLoading()) return;
    std::size_t inRow[2] = {}, next[2] = {};
    const auto read = [&]<class Member>(Member& member) {
      if constexpr (std::is_same_v<Member, double>)
        member = real[next[1]++];
      else
        member = static_cast<Member>(whole[next[0]++]);
    };
    Row row{};
    visit(row, [&]<class Member>(Member&) { ++inRow[std::is_same_v<Member, double> ? 1 : 0]; });
    const std::size_t count = whole.size() / inRow[0];
    if (whole.size() != count * inRow[0] || real.size() != count * inRow[1])
      throw InputError("The saved state " + std::string(what) + "; load another save.");
    rows.assign(count, row);
    for (Row& one : rows) visit(one, read);
  }

 protected:
  using Slot = std::variant<bool*, int*, long*, std::uint8_t*, std::uint32_t*, std::uint64_t*,
                            double*, std::string*, std::vector<int>*, std::vector<std::uint32_t>*,
                            std::vector<double>*>;
  using Numbers =
      std::variant<std::span<char>, std::span<std::uint8_t>, std::span<int>,
                   std::span<std::uint32_t>, std::span<std::uint64_t>, std::span<double>>;

  explicit AnyArchive(bool isLoading) : isLoading_(isLoading) {}
  virtual void exchange(const char* name, Slot slot) = 0;
  virtual void exchange(const char* name, Numbers numbers) = 0;

 private:
  bool isLoading_;
};

/// AnyArchive for one of Boost's archives.
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
