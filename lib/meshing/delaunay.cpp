#include "meshing/mesh_stages.hpp"

#include <fmt/core.h>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <string>

#include "core/errors.hpp"

namespace yadefrag {
namespace {

constexpr std::uint32_t kNone = LinkedTriangles::kNone;
constexpr std::uint32_t kUnseen = kNone - 1;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using InfoBase = CGAL::Triangulation_face_base_with_info_2<std::uint32_t, Kernel>;
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel, InfoBase>;
using Storage = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Tag = CGAL::No_constraint_intersection_requiring_constructions_tag;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Storage, Tag>;
using Face = Triangulation::Face_handle;
using Vertex = Triangulation::Vertex_handle;

class Builder {
 public:
  explicit Builder(const DividedBoundary& boundary) : boundary_(boundary) {}

  LinkedTriangles build(std::span<const Vec2> inside) {
    insertBoundary();
    for (const std::uint32_t i : orderAlongCurve(inside)) insertInside(inside[i]);
    checkEdges();
    numberInside();
    return collect();
  }

 private:
  void insertBoundary() {
    vertices_.resize(boundary_.nodes.size());
    Face hint;
    for (const std::uint32_t i : orderAlongCurve(boundary_.nodes)) {
      const Vec2 p = boundary_.nodes[i];
      vertices_[i] = triangulation_.insert({p.x, p.y}, hint);
      vertices_[i]->info() = i;
      hint = vertices_[i]->face();
    }
    if (triangulation_.number_of_vertices() != vertices_.size()) refuse(0);
    after_.resize(boundary_.first.back());
    boundary_.forEachEdge([&](std::uint32_t a, std::uint32_t b) {
      after_[a] = b;
      constrain(a, b);
    });
    for (const auto& [a, b, joint] : boundary_.joints) constrain(a, b);
  }

  void constrain(std::uint32_t a, std::uint32_t b) {
    try {
      triangulation_.insert_constraint(vertices_[a], vertices_[b]);
    } catch (const Triangulation::Intersection_of_constraints_exception&) {
      refuse(a);
    }
  }

  void insertInside(Vec2 p) {
    const Kernel::Point_2 point(p.x, p.y);
    Triangulation::Locate_type type;
    int index = 0;
    const Face face = triangulation_.locate(point, type, index, hint_);
    const bool free = type == Triangulation::FACE ||
                      (type == Triangulation::EDGE && !face->is_constrained(index));
    if (!free) return;
    const Vertex vertex = triangulation_.insert(point, type, face, index);
    vertex->info() = kUnseen;
    hint_ = vertex->face();
  }

  void checkEdges() const {
    const auto check = [&](std::uint32_t a, std::uint32_t b) {
      Face face;
      int index = 0;
      if (!triangulation_.is_edge(vertices_[a], vertices_[b], face, index) ||
          !face->is_constrained(index))
        refuse(a);
    };
    boundary_.forEachEdge(check);
    for (const auto& [a, b, joint] : boundary_.joints) check(a, b);
  }

  [[noreturn]] void refuse(std::uint32_t node) const {
    throw InputError(fmt::format(
        "Polygon: near ({:g}, {:g}) two edges are so near each other that dividing them makes them "
        "meet; move them apart or make the size larger than the edges.",
        boundary_.given[node].x, boundary_.given[node].y));
  }

  /// Numbers the faces inside, which are reached from the left of the boundary without crossing it;
  /// all others get kNone.
  void numberInside() {
    for (const Face face : triangulation_.all_face_handles()) face->info() = kNone;
    boundary_.forEachEdge([&](std::uint32_t a, std::uint32_t b) {
      Face face;
      int index = 0;
      triangulation_.is_edge(vertices_[a], vertices_[b], face, index);
      // CGAL returns the face to the right or to the left of a → b: take the left one.
      if (face->vertex(Triangulation::ccw(index)) != vertices_[a]) face = face->neighbor(index);
      visit(face);
    });
    std::size_t done = 0;
    while (done < faces_.size()) {
      const Face face = faces_[done++];
      for (int k = 0; k < 3; ++k)
        if (!isBoundary(face, k)) visit(face->neighbor(k));
    }
  }

  /// Constrained sides that are not on the boundary are on joints.
  [[nodiscard]] bool isBoundary(Face face, int k) const {
    if (!face->is_constrained(k)) return false;
    const std::uint32_t a = face->vertex(Triangulation::ccw(k))->info();
    const std::uint32_t b = face->vertex(Triangulation::cw(k))->info();
    return (a < after_.size() && after_[a] == b) || (b < after_.size() && after_[b] == a);
  }

  void visit(Face face) {
    if (face->info() != kNone) return;
    face->info() = static_cast<std::uint32_t>(faces_.size());
    faces_.push_back(face);
  }

  LinkedTriangles collect() const {
    LinkedTriangles mesh;
    mesh.nodes = boundary_.nodes;
    mesh.numBoundary = static_cast<std::uint32_t>(mesh.nodes.size());
    for (const Face face : faces_) {
      LinkedTriangles::Three nodes, neighbours;
      for (int k = 0; k < 3; ++k) {
        std::uint32_t& number = face->vertex(k)->info();
        if (number == kUnseen) {
          number = static_cast<std::uint32_t>(mesh.nodes.size());
          mesh.nodes.push_back({face->vertex(k)->point().x(), face->vertex(k)->point().y()});
        }
        nodes[k] = number;
        neighbours[k] = face->is_constrained(k) ? kNone : face->neighbor(k)->info();
      }
      mesh.triangles.push_back(nodes);
      mesh.neighbours.push_back(neighbours);
    }
    return mesh;
  }

  const DividedBoundary& boundary_;
  Triangulation triangulation_;
  std::vector<Vertex> vertices_;      // vertices of the boundary nodes
  std::vector<std::uint32_t> after_;  // the next node of its loop
  std::vector<Face> faces_;           // faces inside the boundary
  Face hint_;
};

}  // namespace

LinkedTriangles triangulateNodes(const DividedBoundary& boundary, std::span<const Vec2> inside) {
  return Builder(boundary).build(inside);
}

}  // namespace yadefrag
