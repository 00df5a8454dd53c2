#pragma once
// Contact groups: actives that share a node which can move are solved together (paper §2, end).

#include <span>
#include <vector>

#include "contact/contact_row.hpp"
#include "core/csr.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// One node in one row; sorted by node, so that rows that share it follow each other.
struct RowNode {
  NodeId node;
  std::uint32_t row;
  double weight;
};

/// The system of all rows before it is cut into groups.
struct ContactGroups {
  std::vector<RowNode> links;  ///< of nodes that can move
  Csr<std::uint32_t> rows;     ///< by group, rows ascending; groups by their first row
  Csr<std::uint32_t> spans;    ///< by group: where in `links` each of its nodes begins
};

/// A row whose nodes are all held makes a group of its own without links.
void findContactGroups(std::span<const ContactRow> rows, const Nodes& nodes, ContactGroups& groups);

}  // namespace yadefrag
