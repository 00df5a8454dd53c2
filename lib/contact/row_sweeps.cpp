#include "contact/row_sweeps.hpp"

#include <algorithm>
#include <cmath>

#include "core/tolerances.hpp"
#include "mesh/mobility.hpp"

namespace yadefrag {

double RowSweeps::solve(std::span<ContactRow> rows, const Nodes& nodes, double dt, double drag,
                        double tolerance) {
  begin(rows, nodes, dt, drag);
  double change = 0;
  for (int sweep = 0; sweep < tolerance::kRowSweeps; ++sweep) {
    change = 0;
    for (std::size_t r = 0; r < rows.size(); ++r)
      change = std::max(change, relax(rows[r], responses_[r]));
    if (!(change > tolerance)) break;
  }
  for (ContactRow& row : rows) row.left = 0;
  return change;
}

void RowSweeps::begin(std::span<const ContactRow> rows, const Nodes& nodes, double dt,
                      double drag) {
  displacement_.resize(nodes.size());
  responses_.resize(rows.size());
  for (const ContactRow& row : rows)
    for (int k = 0; k < row.count; ++k)
      displacement_[row.node[static_cast<std::size_t>(k)].value] = {};
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const ContactRow& row = rows[r];
    Response& response = responses_[r];
    response = {};
    response.along = row.tangent();
    for (std::size_t k = 0; k < static_cast<std::size_t>(row.count); ++k) {
      const Vec2 mobile = dt * dt * row.weight[k] * mobility(nodes, row.node[k], drag);
      response.perNormal[k] = {mobile.x * row.normal.x, mobile.y * row.normal.y};
      response.perTangent[k] = {mobile.x * response.along.x, mobile.y * response.along.y};
      response.normal += row.weight[k] * dot(response.perNormal[k], row.normal);
      response.tangent += row.weight[k] * dot(response.perTangent[k], response.along);
    }
    push(row, response.perNormal, row.normalForce);
    push(row, response.perTangent, row.tangentForce);
  }
}

void RowSweeps::push(const ContactRow& row, const std::array<Vec2, 5>& perForce, double force) {
  for (std::size_t k = 0; k < static_cast<std::size_t>(row.count); ++k)
    displacement_[row.node[k].value] += force * perForce[k];
}

/// Sets one row's forces so that its own gap and slip vanish, as far as the bounds allow; returns
/// by how much it moved (m). A row whose nodes are all held has nothing to say.
double RowSweeps::relax(ContactRow& row, const Response& response) {
  if (!(response.normal > 0)) return 0;
  const double gap = row.gap - row.allowed + dot(relative(row, displacement_), row.normal);
  const double normal = std::max(0., row.normalForce - gap / response.normal);
  const double pushed = normal - row.normalForce;
  row.normalForce = normal;
  if (pushed != 0) push(row, response.perNormal, pushed);
  double moved = std::abs(pushed) * response.normal;
  if (row.friction > 0 && response.tangent > 0) {
    const double slip = row.slip + dot(relative(row, displacement_), response.along);
    const double most = row.friction * normal;
    const double tangent = std::clamp(row.tangentForce - slip / response.tangent, -most, most);
    const double pulled = tangent - row.tangentForce;
    row.tangentForce = tangent;
    if (pulled != 0) push(row, response.perTangent, pulled);
    moved = std::max(moved, std::abs(pulled) * response.tangent);
  }
  return moved;
}

}  // namespace yadefrag
