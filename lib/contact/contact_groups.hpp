#pragma once
// Contact groups: actives with a common free node are solved together (paper §2, end).

#include <span>
#include <vector>

#include "contact/contact_row.hpp"
#include "core/csr.hpp"
#include "mesh/model.hpp"

namespace yadefrag {

/// One node, or one rigid body with a number after those of the nodes, in one row; sorted by node,
/// so that rows with a common node are adjacent.
struct RowNode {
  NodeId node;
  std::uint32_t row;
  double weight;
  Vec2 lever = {};  ///< m, of a rigid body
};

/// The links between rows and nodes, and the groups of rows.
struct ContactGroups {
  std::vector<RowNode> links;  ///< of free nodes and of rigid bodies
  Csr<std::uint32_t> rows;     ///< by group, rows ascending; groups by their first row
  Csr<std::uint32_t> spans;    ///< by group: index in `links` at which each of its nodes begins
};

/// A row whose nodes are all held is a group of its own, without links.
void findContactGroups(std::span<const ContactRow> rows, const Nodes& nodes, ContactGroups& groups);

}  // namespace yadefrag
