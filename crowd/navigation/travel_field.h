// Travel times to a goal from everywhere on a mesh, shared by all who walk there.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "crowd/navigation/congestion.h"
#include "crowd/navigation/path_finder.h"

namespace throng::crowd {

/// The portals of a mesh by number, with those that lead into each polygon.
class PortalTable {
 public:
  explicit PortalTable(const NavMesh& mesh);

  /// A portal out of a polygon, with points on it.
  struct Entry {
    int from = 0;  ///< index of the polygon that it leads out of
    Portal portal;
    int first_point = 0;  ///< index of its first point
    int points = 2;
  };
  struct Point {
    int portal = 0;
    Eigen::Vector2f place;
  };

  const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<Point>& points() const { return points_; }
  std::span<const int> out_of(int polygon) const {
    return out_of_[static_cast<std::size_t>(polygon)];
  }
  std::span<const int> into(int polygon) const { return into_[static_cast<std::size_t>(polygon)]; }

 private:
  std::vector<Entry> entries_;
  std::vector<Point> points_;
  std::vector<std::vector<int>> out_of_;
  std::vector<std::vector<int>> into_;
};

/// How far it is to a polygon from points on each portal, at most 4 m apart (9 on wide portals),
/// by Dijkstra's algorithm from there. Const member functions may be called from several threads.
class TravelField {
 public:
  /// Reusable buffers for one mesh; one object per thread.
  struct Buffers {
    explicit Buffers(const PortalTable& portals);
    std::vector<Gate> gates;
    std::vector<std::pair<float, int>> firsts;
    std::vector<std::uint64_t> open;  ///< heap of costs with their points
  };

  /// The table must outlive this object.
  explicit TravelField(const PortalTable& portals);

  /// Makes this the field of a goal in a polygon. Must be called first.
  void lead_to(const NavMesh::Location& goal, const Congestion& congestion, Buffers& buffers);

  /// Computes the field again, with what queues cost.
  void renew(const Congestion& congestion, Buffers& buffers);
  /// Whether queues counted when it was computed.
  bool has_delays() const { return has_delays_; }

  /// Finds the quickest path from a place on the mesh to a point of the goal's polygon: `path`
  /// then has its bends. Returns its cost: length and delays (m), infinite if there is none.
  float find(const NavMesh::Location& from, const Eigen::Vector2f& to, const Congestion& congestion,
             PathFinder& path, Buffers& buffers) const;

 private:
  struct Node {
    float cost = 0;  // m
    int next = -1;   // on the way to the goal; -1: in its polygon
  };

  void reach(int node, float cost, int next, Buffers& buffers);
  void collect(int node, std::vector<Gate>& gates) const;

  const PortalTable* portals_;
  NavMesh::Location goal_;
  bool has_delays_ = false;
  std::vector<Node> nodes_;  // by point
};

/// The length of a path through these places and its delays, m.
float path_cost_m(const Eigen::Vector2f& from, std::span<const Eigen::Vector2f> bends,
                  const Congestion& congestion);

}  // namespace throng::crowd
