#include "crowd/navigation/nav_mesh_file.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/geometry/polygon.h"
#include "crowd/elements/number_file.h"

namespace throng::crowd {

namespace {

struct Edge {
  int begin = 0;  // vertices
  int end = 0;
  int first = 0;  // polygons
  int second = 0;
  int line = 0;
};

struct ObstacleEdge {
  int begin = 0;  // vertices
  int end = 0;
  int polygon = 0;
  int next = 0;  // obstacle edge
};

/// Reads one file in its order.
class Reader {
 public:
  explicit Reader(const TextFile& source) : file_(source) {}

  NavMeshFile read() {
    read_vertices();
    read_edges();
    while (!file_.at_end()) read_group();
    if (polygons_.empty()) file_.fail("no polygons", "at least one group of polygons");
    check_references();
    std::vector<std::vector<Eigen::Vector2f>> outlines = make_outlines();
    return {NavMesh(std::move(polygons_)), std::move(groups_), std::move(outlines)};
  }

 private:
  int last_vertex() const { return static_cast<int>(vertices_.size()) - 1; }
  const Eigen::Vector2f& vertex(int index) const {
    return vertices_[static_cast<std::size_t>(index)];
  }

  void read_vertices() {
    const int count = file_.count("the number of vertices", 3, 2);
    for (int i = 0; i < count; ++i) {
      const float x = file_.real("a vertex' x in m");
      vertices_.emplace_back(x, file_.real("a vertex' y in m"));
    }
  }

  void read_edges() {
    constexpr int kMany = 100'000'000;
    const int edges = file_.count("the number of edges between polygons", 0, 4);
    for (int i = 0; i < edges; ++i) {
      Edge edge;
      edge.begin = file_.integer("an edge's first vertex", 0, last_vertex());
      edge.end = file_.integer("an edge's second vertex", 0, last_vertex());
      edge.first = file_.integer("the polygon on one side of an edge", 0, kMany);
      edge.second = file_.integer("the polygon on the other side of an edge", 0, kMany);
      if (edge.first == edge.second) {
        file_.fail(fmt::format("polygon {} on both sides of an edge", edge.first), "two polygons");
      }
      edges_.push_back(edge);
    }
    const int obstacles = file_.count("the number of obstacles' edges", 0, 4);
    for (int i = 0; i < obstacles; ++i) {
      ObstacleEdge edge;
      edge.begin = file_.integer("an obstacle edge's first vertex", 0, last_vertex());
      edge.end = file_.integer("an obstacle edge's second vertex", 0, last_vertex());
      edge.polygon = file_.integer("the polygon beside an obstacle's edge", 0, kMany);
      edge.next = file_.integer("the next edge of an obstacle", 0, obstacles - 1);
      obstacles_.push_back(edge);
    }
  }

  void read_group() {
    groups_.push_back(file_.line("the name of a group of polygons"));
    const int count = file_.count("the number of polygons in a group", 0, 11);
    for (int i = 0; i < count; ++i) read_polygon();
  }

  void read_polygon() {
    NavPolygon polygon;
    polygon.group = static_cast<int>(groups_.size()) - 1;
    polygon.center.x() = file_.real("a polygon's center");
    polygon.center.y() = file_.real("a polygon's center");
    const int corners = file_.count("the number of a polygon's corners", 3, 1);
    double area = 0;
    for (int i = 0; i < corners; ++i) {
      polygon.corners.push_back(vertex(file_.integer("a polygon's corner", 0, last_vertex())));
      if (i >= 2) {
        area += geometry::cross(polygon.corners[i - 1] - polygon.corners[0],
                                polygon.corners[i] - polygon.corners[0]);
      }
    }
    if (area < 0) std::reverse(polygon.corners.begin(), polygon.corners.end());
    check_convex(polygon);
    for (int i = 0; i < 3; ++i) polygon.plane[i] = file_.real("a coefficient of a polygon's plane");
    const int number = static_cast<int>(polygons_.size());
    const int edges = file_.count("the number of a polygon's edges", 0, 1);
    for (int i = 0; i < edges; ++i) {
      const int edge =
          file_.integer("an edge of a polygon", 0, static_cast<int>(edges_.size()) - 1);
      polygon.portals.push_back(portal(edges_[static_cast<std::size_t>(edge)], number, polygon));
    }
    const int obstacles = file_.count("the number of a polygon's obstacle edges", 0, 1);
    for (int i = 0; i < obstacles; ++i) {
      file_.integer("an obstacle's edge near a polygon", 0,
                    static_cast<int>(obstacles_.size()) - 1);
    }
    polygons_.push_back(std::move(polygon));
  }

  void check_convex(const NavPolygon& polygon) const {
    const std::size_t count = polygon.corners.size();
    for (std::size_t i = 0; i < count; ++i) {
      const Eigen::Vector2f edge = polygon.corners[(i + 1) % count] - polygon.corners[i];
      const Eigen::Vector2f after =
          polygon.corners[(i + 2) % count] - polygon.corners[(i + 1) % count];
      constexpr float kNoise = 1e-3F;  // files have a few digits
      if (geometry::cross(edge, after) < -kNoise * edge.norm() * after.norm()) {
        const Eigen::Vector2f& corner = polygon.corners[(i + 1) % count];
        file_.fail(fmt::format("a polygon with a dent at ({}, {})", corner.x(), corner.y()),
                   "convex polygons");
      }
    }
  }

  Portal portal(const Edge& edge, int polygon, const NavPolygon& from) const {
    if (edge.first != polygon && edge.second != polygon) {
      file_.fail(fmt::format("an edge between polygons {} and {}", edge.first, edge.second),
                 fmt::format("an edge of polygon {}", polygon));
    }
    Portal made;
    made.to = edge.first == polygon ? edge.second : edge.first;
    made.left = vertex(edge.begin);
    made.right = vertex(edge.end);
    if (geometry::cross(made.right - from.center, made.left - from.center) < 0) {
      std::swap(made.left, made.right);
    }
    return made;
  }

  void check_references() const {
    const int count = static_cast<int>(polygons_.size());
    const auto check_polygon = [&](int polygon, std::string_view what) {
      if (polygon < count) return;
      file_.fail(fmt::format("{} that names polygon {}", what, polygon),
                 fmt::format("one of the {} polygons, counted from 0", count));
    };
    for (const Edge& edge : edges_) {
      check_polygon(edge.first, "an edge");
      check_polygon(edge.second, "an edge");
    }
    for (const ObstacleEdge& edge : obstacles_) check_polygon(edge.polygon, "an obstacle's edge");
  }

  /// Follows the obstacles' edges around; where people walk on their left they are turned round.
  std::vector<std::vector<Eigen::Vector2f>> make_outlines() const {
    std::vector<std::vector<Eigen::Vector2f>> outlines;
    std::vector<bool> done(obstacles_.size(), false);
    for (std::size_t first = 0; first < obstacles_.size(); ++first) {
      if (done[first]) continue;
      std::vector<Eigen::Vector2f> outline;
      int walkable_on_the_left = 0;
      std::size_t i = first;
      for (; !done[i]; i = static_cast<std::size_t>(obstacles_[i].next)) {
        done[i] = true;
        const ObstacleEdge& edge = obstacles_[i];
        const Eigen::Vector2f& begin = vertex(edge.begin);
        const Eigen::Vector2f& center = polygons_[static_cast<std::size_t>(edge.polygon)].center;
        outline.push_back(begin);
        walkable_on_the_left +=
            geometry::cross(vertex(edge.end) - begin, center - begin) > 0 ? 1 : -1;
      }
      if (i != first || outline.size() < 3) {
        file_.fail(fmt::format("an obstacle of {} edges that does not close", outline.size()),
                   "obstacles' edges that lead around at least three corners");
      }
      if (walkable_on_the_left > 0) std::reverse(outline.begin(), outline.end());
      outlines.push_back(std::move(outline));
    }
    return outlines;
  }

  NumberFile file_;
  std::vector<Eigen::Vector2f> vertices_;
  std::vector<Edge> edges_;
  std::vector<ObstacleEdge> obstacles_;
  std::vector<std::string> groups_;
  std::vector<NavPolygon> polygons_;
};

}  // namespace

NavMeshFile load_nav_mesh(const TextFile& source) { return Reader(source).read(); }

std::shared_ptr<const NavMeshFile> shared_nav_mesh(const TextFile& source, SharedParts& parts) {
  return parts.get<NavMeshFile>(
      source.key(), [&] { return std::make_shared<NavMeshFile>(load_nav_mesh(source)); });
}

}  // namespace throng::crowd
