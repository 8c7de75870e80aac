// Cuts triangles into smaller ones where light varies. Whether an edge is cut depends on the edge
// alone, so that triangles which share it stay joined without gaps.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "render/ground/scenery_mesh.h"
#include "render/props/prop_mesh.h"

namespace throng::render {

/// The vertex in the middle of an edge.
SceneryVertex middle_vertex(const SceneryVertex& a, const SceneryVertex& b);
PropVertex middle_vertex(const PropVertex& a, const PropVertex& b);

/// Returns the triangles of `indices`, cut until `is_long(a, b)` holds for no edge; new vertices
/// are appended.
template <typename Vertex, typename IsLong>
std::vector<std::uint32_t> refined(std::span<const std::uint32_t> indices,
                                   std::vector<Vertex>& vertices, const IsLong& is_long) {
  using Edge = std::pair<std::uint32_t, std::uint32_t>;
  constexpr int kMaxDepth = 12;
  struct Triangle {
    std::uint32_t a, b, c;
    int depth;
  };
  std::map<Edge, std::uint32_t> middles;
  // The middle of an edge that is long, else its first end.
  const auto cut = [&](std::uint32_t a, std::uint32_t b, int cuts_before) {
    if (cuts_before >= kMaxDepth || !is_long(vertices[a], vertices[b])) return a;
    const auto [found, is_new] =
        middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(vertices.size()));
    if (is_new) vertices.push_back(middle_vertex(vertices[a], vertices[b]));
    return found->second;
  };
  std::vector<std::uint32_t> out;
  std::vector<Triangle> left;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    left.push_back({indices[i], indices[i + 1], indices[i + 2], 0});
    while (!left.empty()) {
      const Triangle triangle = left.back();
      const auto [a, b, c] = std::array{triangle.a, triangle.b, triangle.c};
      const int depth = triangle.depth;
      left.pop_back();
      const std::uint32_t ab = cut(a, b, depth);
      const std::uint32_t bc = cut(b, c, depth);
      const std::uint32_t ca = cut(c, a, depth);
      const auto push = [&](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        left.push_back({x, y, z, depth + 1});
      };
      const int cuts = (ab != a ? 1 : 0) + (bc != b ? 1 : 0) + (ca != c ? 1 : 0);
      if (cuts == 0) {
        out.insert(out.end(), {a, b, c});
      } else if (cuts == 3) {
        push(ab, bc, ca);
        push(a, ab, ca);
        push(ab, b, bc);
        push(ca, bc, c);
      } else if (ab != a) {
        // With a second cut the corner beyond it becomes a triangle of its own.
        if (bc != b) {
          push(ab, b, bc);
          push(a, ab, bc);
          push(a, bc, c);
        } else if (ca != c) {
          push(a, ab, ca);
          push(ab, b, ca);
          push(b, c, ca);
        } else {
          push(a, ab, c);
          push(ab, b, c);
        }
      } else if (bc != b) {
        if (ca != c) {
          push(bc, c, ca);
          push(a, b, bc);
          push(a, bc, ca);
        } else {
          push(a, b, bc);
          push(a, bc, c);
        }
      } else {
        push(a, b, ca);
        push(b, c, ca);
      }
    }
  }
  return out;
}

}  // namespace throng::render
