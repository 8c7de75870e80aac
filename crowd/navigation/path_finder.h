// Path planning on navigation meshes.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "crowd/navigation/nav_mesh.h"

namespace throng::crowd {

/// A portal on a path, shortened by the radius of the agent at its corners.
struct Gate {
  int polygon = 0;  ///< index of the polygon behind it
  Eigen::Vector2f left;
  Eigen::Vector2f right;
  Eigen::Vector2f crossing;  ///< point at which the path crosses it
  Eigen::Vector2f left_corner;
  Eigen::Vector2f right_corner;
};

/// Measure of the length of a path from portal to portal in A*.
enum class Lengths {
  shortest,  ///< between points of the portals that several rules choose; the best result is used
  centers    ///< between the centers of polygons, as in Menge; may miss the shortest path
};

/// Finds paths: A* over the portals (Hart, Nilsson and Raphael 1968) for the polygons, then the
/// funnel algorithm (Lee and Preparata 1984) for the shortest path through them. One object per
/// thread; it reuses its memory.
class PathFinder {
 public:
  /// The mesh must outlive this object.
  explicit PathFinder(const NavMesh& mesh, Lengths lengths = Lengths::shortest);

  /// Finds a path for a disc of this radius. Portals that are too narrow are used only if there is
  /// no other path. Returns false if there is none.
  bool find(const NavMesh::Location& from, const NavMesh::Location& to, float radius);

  /// Finds the shortest path through given portals.
  void find_through(std::span<const Gate> gates, const Eigen::Vector2f& start,
                    const Eigen::Vector2f& end);

  /// The path found last: its portals; its bends and its end.
  std::span<const Gate> gates() const { return gates_; }
  std::span<const Eigen::Vector2f> bends() const { return bends_; }
  float length_m() const { return length_m_; }

 private:
  /// State of a portal in a search.
  struct Node {
    unsigned search = 0;  // number of the last search that reached it
    bool done = false;
    int before = -1;  // the previous portal; -1: the start
    float cost = 0;   // length so far, m
    Eigen::Vector2f point = Eigen::Vector2f::Zero();
  };
  /// A portal for discs of one radius.
  struct Passage {
    float radius = -1;  // not computed yet
    bool too_narrow = false;
    Gate gate;
  };
  struct Open {
    /// Estimated length from start to end through this portal (m), and order of discovery for equal
    /// estimates, combined for one comparison.
    std::uint64_t key = 0;
    int portal = 0;

    // Order for a heap.
    bool operator<(const Open& other) const { return key > other.key; }
  };

  /// Point at which a path is assumed to cross a portal until it is planned.
  enum class Pass { near_line, near_start, middle, center_behind };
  struct Search {
    Eigen::Vector2f start;
    Eigen::Vector2f end;
    float radius = 0;
    Pass pass = Pass::near_line;
    bool narrow = false;  // whether portals that are too narrow are used
  };

  bool find_by(Pass pass, const NavMesh::Location& from, const NavMesh::Location& to, float radius);
  bool search(const Search& how, int from, int to);
  void expand(const Search& how, int polygon, int before);
  Eigen::Vector2f passing_point(const Search& how, const Gate& gate,
                                const Eigen::Vector2f& start) const;
  const Passage& passage(int number, float radius);
  void collect_gates(int last, float radius);
  void pull_tight(const Eigen::Vector2f& start, const Eigen::Vector2f& end);
  void bend_at(std::size_t gate, const Eigen::Vector2f& point);

  const NavMesh* mesh_;
  Lengths lengths_;
  std::vector<int> first_portal_;  // by polygon: index of its first portal
  std::vector<int> owner_;         // by portal: the polygon that it belongs to
  std::vector<Node> nodes_;        // by portal
  std::vector<Passage> passages_;  // by portal
  std::vector<Open> open_;         // heap
  unsigned search_ = 0;
  std::uint32_t reached_ = 0;  // number of portals reached in this search

  std::vector<Gate> gates_;
  std::vector<Gate> best_gates_;
  std::vector<Eigen::Vector2f> bends_;
  std::size_t crossed_ = 0;  // number of gates whose crossing is known
  Eigen::Vector2f apex_ = Eigen::Vector2f::Zero();
  float length_m_ = 0;
};

}  // namespace throng::crowd
