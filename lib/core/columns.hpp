#pragma once
// Tables: arrays of the same length that belong together, such as all values by node. A struct
// lists its arrays once:
//
//   template <class Self>
//   static auto columnsOf(Self& self) {
//     return [&self](auto visit) {
//       visit(Column{"position"}, self.position);
//       visit(Column{"load", kOptional}, self.load);
//     };
//   }
//
// and all that concerns whole rows goes through that list: the functions below, saved states. A
// new array needs a member and a line there.

#include <cstddef>
#include <span>

namespace yadefrag {

/// An optional array is empty as long as it is not used.
enum Presence : bool { kAlways = false, kOptional = true };

struct Column {
  const char* name;  ///< in saved states
  Presence presence = kAlways;

  template <class Array>
  [[nodiscard]] bool isUsed(const Array& array) const {
    return presence == kAlways || !array.empty();
  }
};

/// New rows are zero.
template <class Columns>
void resizeRows(const Columns& columns, std::size_t count) {
  columns([&](const Column& column, auto& array) {
    if (column.isUsed(array)) array.resize(count);
  });
}

template <class Columns>
void reserveRows(const Columns& columns, std::size_t count) {
  columns([&](const Column& column, auto& array) {
    if (column.isUsed(array)) array.reserve(count);
  });
}

/// Appends a copy of a row.
template <class Columns>
void appendCopy(const Columns& columns, std::size_t row) {
  columns([&]<class Array>(const Column& column, Array& array) {
    if (column.isUsed(array)) array.push_back(typename Array::value_type(array[row]));
  });
}

/// Keeps the rows for which `stays(row)` is true, in order. It is called once for each row, before
/// that row moves.
template <class Columns, class Stays>
void keepRows(const Columns& columns, std::size_t count, Stays stays) {
  std::size_t kept = 0;
  for (std::size_t row = 0; row < count; ++row) {
    if (!stays(row)) continue;
    if (kept != row)
      columns([&](const Column& column, auto& array) {
        if (column.isUsed(array)) array[kept] = array[row];
      });
    ++kept;
  }
  resizeRows(columns, kept);
}

/// Puts an array into this order: `order[i]` is the former number of element i.
template <class Array, class IdType>
void arrange(Array& array, std::span<const IdType> order) {
  const Array former = array;
  for (std::size_t i = 0; i < order.size(); ++i) array[i] = former[order[i].value];
}

/// Puts all columns that are used into this order.
template <class Columns, class IdType>
void arrangeRows(const Columns& columns, std::span<const IdType> order) {
  columns([&](const Column& column, auto& array) {
    if (column.isUsed(array)) arrange(array, order);
  });
}

template <class Columns>
[[nodiscard]] bool haveLength(const Columns& columns, std::size_t count) {
  bool fits = true;
  columns([&](const Column& column, const auto& array) {
    fits = fits && (!column.isUsed(array) || array.size() == count);
  });
  return fits;
}

}  // namespace yadefrag
