#include "contact/contact_groups.hpp"

#include <algorithm>

#include "core/disjoint_sets.hpp"

namespace yadefrag {

namespace {

void listLinks(std::span<const ContactRow> rows, const Nodes& nodes, std::vector<RowNode>& links) {
  links.clear();
  for (std::uint32_t r = 0; r < rows.size(); ++r) {
    for (int k = 0; k < rows[r].count; ++k) {
      const auto at = static_cast<std::size_t>(k);
      const NodeId node = rows[r].node[at];
      if (nodes.held[node.value] == kHeldXY) continue;
      links.push_back({node, r, rows[r].weight[at]});
    }
    const ContactRow::RigidPart& rigid = rows[r].rigid;
    if (rigid.mass != ContactRow::kNoMass)
      links.push_back({NodeId(nodes.size() + rigid.mass), r, rigid.weight, rigid.lever});
  }
  std::stable_sort(links.begin(), links.end(),
                   [](const RowNode& a, const RowNode& b) { return a.node < b.node; });
}

bool beginsNode(std::span<const RowNode> links, std::size_t i) {
  return i == 0 || links[i - 1].node != links[i].node;
}

}  // namespace

void findContactGroups(std::span<const ContactRow> rows, const Nodes& nodes,
                       ContactGroups& groups) {
  listLinks(rows, nodes, groups.links);
  const std::span<const RowNode> links(groups.links);
  DisjointSets sets(rows.size());
  for (std::size_t i = 1; i < links.size(); ++i)
    if (!beginsNode(links, i)) sets.join(links[i - 1].row, links[i].row);

  std::vector<std::uint32_t> groupOfRow;
  const std::uint32_t count = sets.number(groupOfRow);
  fillRows(
      groups.rows, count, rows.size(), [&](std::size_t r) { return groupOfRow[r]; },
      [](std::size_t r) { return static_cast<std::uint32_t>(r); });

  std::vector<std::uint32_t> starts;
  for (std::size_t i = 0; i < links.size(); ++i)
    if (beginsNode(links, i)) starts.push_back(static_cast<std::uint32_t>(i));
  fillRows(
      groups.spans, count, starts.size(),
      [&](std::size_t i) { return groupOfRow[links[starts[i]].row]; },
      [&](std::size_t i) { return starts[i]; });
}

}  // namespace yadefrag
