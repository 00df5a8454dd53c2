#pragma once
// Columns of plain numbers in YADE's archives, with a checksum of all values. Damaged lengths are
// refused before memory is needed for them.

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <sstream>
#include <string>
#include <type_traits>
#include <vector>

#include "core/errors.hpp"
#include "core/random_bits.hpp"
#include "step/world.hpp"
#include "yade/any_archive.hpp"

namespace yadefrag {

/// The numbers of which a value consists.
template <class T>
struct ScalarOf {
  using Type = T;
};
template <>
struct ScalarOf<Vec2> {
  using Type = double;
};
template <>
struct ScalarOf<Piece> {
  using Type = std::uint8_t;
};
template <class Tag>
struct ScalarOf<Id<Tag>> {
  using Type = std::uint32_t;
};
template <class T, std::size_t kCount>
struct ScalarOf<std::array<T, kCount>> : ScalarOf<T> {};

class ColumnArchive {
 public:
  explicit ColumnArchive(AnyArchive& archive) : archive_(archive) {}

 protected:
  [[nodiscard]] bool isLoading() const { return archive_.isLoading(); }

  /// (count) A damaged length must not exhaust the memory: values are read in parts of this size,
  /// and the archive ends before the memory is full.
  static constexpr std::uint64_t kPart = 1 << 16;

  [[noreturn]] static void refuse(const std::string& what) {
    throw InputError("The saved state of FESolver is damaged or from another version (" + what +
                     "); load another save.");
  }

  /// Of all values so far: false if the stored one is another.
  bool checksum() {
    std::uint64_t stored = sum_.value();
    archive_.item("checksum", stored);
    return stored == sum_.value();
  }

  void lines(const char* name, std::vector<std::string>& all) {
    std::vector<char> text;
    for (const std::string& line : all) {
      text.insert(text.end(), line.begin(), line.end());
      text.push_back('\n');
    }
    value(name, text);
    if (isLoading()) {
      all.clear();
      std::istringstream lines(std::string(text.begin(), text.end()));
      for (std::string line; std::getline(lines, line);) all.push_back(line);
    }
  }

  template <class Value>
  void value(const char* name, Value& value) {
    static_assert(std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>);
    archive_.item(name, value);
    sum_.add(&value, sizeof value);
  }
  /// In a damaged file a bool could have any value.
  void value(const char* name, bool& value) {
    std::uint8_t flag = value ? 1 : 0;
    this->value(name, flag);
    value = flag != 0;
  }
  template <class Scalar>
  void value(const char* name, std::vector<Scalar>& values) {
    std::uint64_t count = values.size();
    value("count", count);
    if (isLoading()) values.clear();
    for (std::uint64_t begin = 0; begin < count; begin += kPart) {
      const std::uint64_t size = std::min(kPart, count - begin);
      if (isLoading()) values.resize(begin + size);
      archive_.numbers(name, values.data() + begin, size);
    }
    if (count > 0) sum_.add(values.data(), count * sizeof(Scalar));
  }

  /// A column of values that consist of plain numbers.
  template <class Element>
  void column(const char* name, std::vector<Element>& column) {
    numbers<typename ScalarOf<Element>::Type>(name, column);
  }
  template <class Scalar, class Element>
  void numbers(const char* name, std::vector<Element>& column) {
    // NOLINTNEXTLINE(bugprone-sizeof-expression): also correct for a column of plain numbers
    constexpr std::size_t each = sizeof(Element) / sizeof(Scalar);
    static_assert(std::is_trivially_copyable_v<Element> &&
                  sizeof(Element) == each * sizeof(Scalar));
    std::vector<Scalar> flat(column.size() * each);
    if (!column.empty()) std::memcpy(flat.data(), column.data(), flat.size() * sizeof(Scalar));
    value(name, flat);
    if (flat.size() % each != 0) refuse(std::string(name) + " has a wrong length");
    column.resize(flat.size() / each);
    if (!column.empty())
      std::memcpy(static_cast<void*>(column.data()), flat.data(), flat.size() * sizeof(Scalar));
  }

  /// One member of structures with several types of members: a pointer to it, or a function that
  /// returns a reference. The elements of a vector of bool cannot be referenced: flags are bytes.
  template <class Element, class Read>
  void member(const char* name, std::vector<Element>& rows, Read read) {
    using Member = std::remove_cvref_t<std::invoke_result_t<Read, Element&>>;
    using Value = std::conditional_t<std::is_same_v<Member, bool>, std::uint8_t, Member>;
    std::vector<Value> flat(rows.size());
    for (std::size_t i = 0; i < flat.size(); ++i)
      flat[i] = static_cast<Value>(std::invoke(read, rows[i]));
    value(name, flat);
    // The first member determines the number of rows.
    if (rows.empty()) rows.resize(flat.size());
    if (rows.size() != flat.size()) refuse(std::string(name) + " has a wrong length");
    for (std::size_t i = 0; i < flat.size(); ++i)
      if constexpr (std::is_same_v<Member, bool>)
        std::invoke(read, rows[i]) = flat[i] != 0;
      else
        std::invoke(read, rows[i]) = flat[i];
  }

  /// The columns of a table (core/columns.hpp).
  template <class Columns>
  void table(const Columns& columns) {
    columns([&]<class Element>(const Column& of, std::vector<Element>& array) {
      column(of.name, array);
    });
  }

  /// Of existing rows: curves that consist of points, or lists of points.
  template <class C, class Read>
  void curves(const char* countsName, const char* pointsName, std::vector<C>& rows, Read read) {
    using Curve = std::remove_cvref_t<decltype(read(rows.front()))>;
    constexpr bool isCurve = requires(Curve curve) { curve.points(); };
    const auto pointsOf = [&](C& c) -> decltype(auto) {
      if constexpr (isCurve)
        return read(c).points();
      else
        return read(c);
    };
    using Point = std::remove_cvref_t<decltype(pointsOf(rows.front()).front())>;
    std::vector<std::uint32_t> counts;
    std::vector<Point> points;
    for (C& c : rows) {
      const std::vector<Point>& own = pointsOf(c);
      counts.push_back(static_cast<std::uint32_t>(own.size()));
      points.insert(points.end(), own.begin(), own.end());
    }
    value(countsName, counts), numbers<double>(pointsName, points);
    if (isLoading()) {
      std::size_t at = 0;
      if (counts.size() != rows.size()) refuse(std::string(countsName) + " has a wrong length");
      for (std::size_t i = 0; i < rows.size(); ++i) {
        if (counts[i] > points.size() - at) refuse(std::string(pointsName) + " has a wrong length");
        const auto begin = points.begin() + static_cast<std::ptrdiff_t>(at);
        std::vector<Point> own(begin, begin + counts[i]);
        if constexpr (isCurve)
          if (!Curve::isValid(own)) refuse(std::string(pointsName) + " is invalid");
        read(rows[i]) = Curve(std::move(own));
        at += counts[i];
      }
    }
  }

  void table(const char* name, TimeTable& table) {
    std::vector<double> times = table.times(), values = table.values();
    value(name, times), value(name, values);
    if (isLoading()) {
      if (!times.empty() || !values.empty())
        if (!TimeTable::isValid(times, values)) refuse(std::string(name) + " is invalid");
      table = TimeTable(std::move(times), std::move(values));
    }
  }

 private:
  AnyArchive& archive_;
  Checksum sum_;
};

// --- Saves and loads the complete state of a world in YADE's archives, as columns of plain
// numbers. The run continues with the same bits from binary files and from XML, which contains all
// digits of a number. Damaged data are refused: a checksum covers all values, and every index is
// checked before use. How a column is stored: column_archive.hpp.

/// `entryBodies`: YADE's body id of each entry; `forces` (N, by node): of contact in the last step.
/// Throws InputError for data that are damaged or of another version, RunError if they cannot be
/// written.
void archiveWorld(AnyArchive& archive, World& world, std::vector<int>& entryBodies,
                  std::vector<Vec2>& forces);

}  // namespace yadefrag
