// Path planning on a navigation mesh.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "crowd/navigation/nav_mesh.h"

namespace throng::crowd {

/// A portal of a path, without the ends that are too close to its corners for the agent.
struct Gate {
  int polygon = 0;  ///< behind it
  Eigen::Vector2f left;
  Eigen::Vector2f right;
  Eigen::Vector2f crossing;  ///< where the path passes it
  Eigen::Vector2f left_corner;
  Eigen::Vector2f right_corner;
};

/// How A* measures the length of a path from portal to portal.
enum class Lengths {
  shortest,  ///< between points of the portals, chosen by several rules: the best result counts
  centers    ///< between the polygons' centers, as Menge does; it may miss the shortest path
};

/// Finds paths. The polygons to pass are searched for with A* over the portals (Hart, Nilsson and
/// Raphael 1968); the path through them is pulled tight with a funnel (Lee and Preparata 1984).
/// One for each thread: it keeps its memory, so that a search allocates nothing after the first.
class PathFinder {
 public:
  /// The mesh must outlive this.
  explicit PathFinder(const NavMesh& mesh, Lengths lengths = Lengths::shortest);

  /// Finds a path for a disc of this radius from one place of the mesh to another. Portals that are
  /// too narrow for it count only if there is no other way. Returns false if there is none at all.
  bool find(const NavMesh::Location& from, const NavMesh::Location& to, float radius);

  /// The shortest path through portals that are known: finds where it passes and bends.
  void find_through(std::span<const Gate> gates, const Eigen::Vector2f& start,
                    const Eigen::Vector2f& end);

  /// The path found last: the portals passed; the points where it bends, then its end.
  std::span<const Gate> gates() const { return gates_; }
  std::span<const Eigen::Vector2f> bends() const { return bends_; }
  float length_m() const { return length_m_; }

 private:
  /// A search's record of a portal.
  struct Node {
    unsigned search = 0;  // the last that reached it
    bool done = false;
    int before = -1;  // the portal passed before
    float cost = 0;   // m so far
    Eigen::Vector2f point = Eigen::Vector2f::Zero();
  };
  /// A portal for discs of one radius.
  struct Passage {
    float radius = -1;  // none yet
    bool too_narrow = false;
    Gate gate;
  };
  struct Open {
    /// m from start to end by way of this portal, and of several with the same estimate the one
    /// that was reached first: compared at once.
    std::uint64_t key = 0;
    int portal = 0;

    // For a heap.
    bool operator<(const Open& other) const { return key > other.key; }
  };

  /// The point where a path is assumed to pass a portal until it is planned.
  enum class Pass { near_line, near_start, middle, center_behind };
  struct Search {
    Eigen::Vector2f start;
    Eigen::Vector2f end;
    float radius = 0;
    Pass pass = Pass::near_line;
    bool narrow = false;  // portals that are too narrow, too
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
  std::vector<int> first_portal_;  // by polygon: the number of its first portal
  std::vector<int> owner_;         // by portal: the polygon that it leads out of
  std::vector<Node> nodes_;        // by portal
  std::vector<Passage> passages_;  // by portal
  std::vector<Open> open_;         // a heap
  unsigned search_ = 0;
  std::uint32_t reached_ = 0;  // portals, in this search

  std::vector<Gate> gates_;
  std::vector<Gate> best_gates_;
  std::vector<Eigen::Vector2f> bends_;
  std::size_t crossed_ = 0;  // gates whose crossing is known
  Eigen::Vector2f apex_ = Eigen::Vector2f::Zero();
  float length_m_ = 0;
};

}  // namespace throng::crowd
