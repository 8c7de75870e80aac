#include "crowd/navigation/path_finder.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "base/geometry/polygon.h"
#include "crowd/spatial/obstacles.h"

namespace throng::crowd {

namespace {

/// Floats that are not negative are in the order of their bits.
std::uint64_t queue_key(float estimate_m, std::uint32_t rank) {
  constexpr unsigned kRankBits = 32;
  return (std::uint64_t{std::bit_cast<std::uint32_t>(estimate_m)} << kRankBits) | rank;
}

/// The portal for a disc: its ends moved inwards by the radius, at most to its middle.
Gate make_gate(const Portal& portal, float radius) {
  const Eigen::Vector2f across = portal.right - portal.left;
  const float width = across.norm();
  const Eigen::Vector2f inset = width > 0 ? Eigen::Vector2f(std::min(radius / width, 0.5F) * across)
                                          : Eigen::Vector2f::Zero();
  return {portal.to,   portal.left + inset, portal.right - inset,
          portal.left, portal.left,         portal.right};
}

/// The point where the straight line from a to b passes a gate, or the gate's end nearest to the
/// line.
Eigen::Vector2f pass(const Gate& gate, const Eigen::Vector2f& a, const Eigen::Vector2f& b) {
  if (a == gate.left || a == gate.right) return a;
  const float left = geometry::cross(b - a, gate.left - a);
  const float right = geometry::cross(b - a, gate.right - a);
  if (left <= 0) return gate.left;
  if (right >= 0) return gate.right;
  // Rounds alike seen in a mirror, so that a symmetric scene stays symmetric.
  return (left * gate.right - right * gate.left) / (left - right);
}

/// Twice the area of a triangle, positive when c is to the right of a -> b.
float right_turn(const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c) {
  return geometry::cross(c - a, b - a);
}

}  // namespace

PathFinder::PathFinder(const NavMesh& mesh, Lengths lengths) : mesh_(&mesh), lengths_(lengths) {
  for (std::size_t polygon = 0; polygon < mesh.polygons().size(); ++polygon) {
    first_portal_.push_back(static_cast<int>(owner_.size()));
    owner_.insert(owner_.end(), mesh.polygons()[polygon].portals.size(), static_cast<int>(polygon));
  }
  nodes_.resize(owner_.size());
  passages_.resize(owner_.size());
  open_.reserve(owner_.size());
  gates_.reserve(mesh.polygons().size());
  best_gates_.reserve(mesh.polygons().size());
  bends_.reserve(mesh.polygons().size() + 1);
}

bool PathFinder::find(const NavMesh::Location& from, const NavMesh::Location& to, float radius) {
  gates_.clear();
  if (from.polygon < 0 || to.polygon < 0) return false;
  if ((*mesh_)[from.polygon].island != (*mesh_)[to.polygon].island) return false;
  if (from.polygon == to.polygon) {
    pull_tight(from.point, to.point);
    return true;
  }
  if (lengths_ == Lengths::centers) return find_by(Pass::center_behind, from, to, radius);
  // None of them is always right, but they seldom fail together.
  float best_m = std::numeric_limits<float>::infinity();
  for (const Pass pass : {Pass::near_line, Pass::near_start, Pass::middle}) {
    if (!find_by(pass, from, to, radius) || length_m_ >= best_m) continue;
    best_m = length_m_;
    best_gates_.swap(gates_);
  }
  if (best_m == std::numeric_limits<float>::infinity()) return false;
  gates_.swap(best_gates_);
  pull_tight(from.point, to.point);
  return true;
}

void PathFinder::find_through(std::span<const Gate> gates, const Eigen::Vector2f& start,
                              const Eigen::Vector2f& end) {
  gates_.assign(gates.begin(), gates.end());
  pull_tight(start, end);
}

bool PathFinder::find_by(Pass pass, const NavMesh::Location& from, const NavMesh::Location& to,
                         float radius) {
  Search how{from.point, to.point, radius, pass, false};
  if (pass == Pass::center_behind) {
    how.start = (*mesh_)[from.polygon].center;
    how.end = (*mesh_)[to.polygon].center;
  }
  gates_.clear();
  if (!search(how, from.polygon, to.polygon)) {
    how.narrow = true;
    if (!search(how, from.polygon, to.polygon)) return false;
  }
  pull_tight(from.point, to.point);
  return true;
}

// Most searches in a row are for the same radius.
const PathFinder::Passage& PathFinder::passage(int number, float radius) {
  Passage& passage = passages_[static_cast<std::size_t>(number)];
  if (passage.radius != radius) {
    const int polygon = owner_[static_cast<std::size_t>(number)];
    const int first = first_portal_[static_cast<std::size_t>(polygon)];
    const Portal& portal = (*mesh_)[polygon].portals[static_cast<std::size_t>(number - first)];
    passage = {radius, (portal.right - portal.left).squaredNorm() < 4 * radius * radius,
               make_gate(portal, radius)};
  }
  return passage;
}

bool PathFinder::search(const Search& how, int from, int to) {
  ++search_;
  reached_ = 0;
  open_.clear();
  expand(how, from, -1);
  while (!open_.empty()) {
    std::pop_heap(open_.begin(), open_.end());
    const int number = open_.back().portal;
    open_.pop_back();
    Node& node = nodes_[static_cast<std::size_t>(number)];
    if (node.done) continue;
    node.done = true;
    const int polygon = passage(number, how.radius).gate.polygon;
    if (polygon == to) {
      collect_gates(number, how.radius);
      return true;
    }
    expand(how, polygon, number);
  }
  return false;
}

Eigen::Vector2f PathFinder::passing_point(const Search& how, const Gate& gate,
                                          const Eigen::Vector2f& start) const {
  switch (how.pass) {
    case Pass::near_line:
      return pass(gate, start, how.end);
    case Pass::near_start:
      return geometry::nearest_on_segment(gate.left, gate.right, start);
    case Pass::middle:
      return 0.5F * (gate.left + gate.right);
    case Pass::center_behind:
      break;
  }
  return (*mesh_)[gate.polygon].center;
}

/// Reaches for the portals of a polygon that was entered through portal `before`.
void PathFinder::expand(const Search& how, int polygon, int before) {
  const bool first = before < 0;
  const Node from = first ? Node{} : nodes_[static_cast<std::size_t>(before)];
  const Eigen::Vector2f& start = first ? how.start : from.point;
  const int back = first ? -1 : owner_[static_cast<std::size_t>(before)];
  const auto here = static_cast<std::size_t>(polygon);
  const int end =
      here + 1 < first_portal_.size() ? first_portal_[here + 1] : static_cast<int>(owner_.size());
  for (int reached = first_portal_[here]; reached < end; ++reached) {
    Node& node = nodes_[static_cast<std::size_t>(reached)];
    const bool known = node.search == search_;
    if (known && node.done) continue;
    const Passage& next = passage(reached, how.radius);
    if (next.gate.polygon == back || (next.too_narrow && !how.narrow)) continue;
    const Eigen::Vector2f point = passing_point(how, next.gate, start);
    const float cost = from.cost + (point - start).norm();
    if (known && cost >= node.cost) continue;
    node = {search_, false, before, cost, point};
    open_.push_back({queue_key(cost + (how.end - point).norm(), reached_++), reached});
    std::push_heap(open_.begin(), open_.end());
  }
}

void PathFinder::collect_gates(int last, float radius) {
  for (int number = last; number >= 0; number = nodes_[static_cast<std::size_t>(number)].before) {
    gates_.push_back(passage(number, radius).gate);
  }
  std::reverse(gates_.begin(), gates_.end());
}

/// The way goes straight from the last bend to `point`, which lies in or behind the gates before
/// `gate`.
void PathFinder::bend_at(std::size_t gate, const Eigen::Vector2f& point) {
  for (; crossed_ < gate; ++crossed_) {
    gates_[crossed_].crossing = pass(gates_[crossed_], apex_, point);
  }
  length_m_ += (point - apex_).norm();
  apex_ = point;
  if (bends_.empty() || bends_.back() != point) bends_.push_back(point);
}

/// The funnel from the apex through the gates so far has a left and a right side; it narrows gate
/// by gate, and where it would turn inside out the way bends around the other side's corner.
void PathFinder::pull_tight(const Eigen::Vector2f& start, const Eigen::Vector2f& end) {
  bends_.clear();
  crossed_ = 0;
  length_m_ = 0;
  apex_ = start;
  Eigen::Vector2f left = start;
  Eigen::Vector2f right = start;
  std::size_t left_gate = 0;
  std::size_t right_gate = 0;
  for (std::size_t i = 0; i <= gates_.size(); ++i) {
    const Eigen::Vector2f& next_left = i < gates_.size() ? gates_[i].left : end;
    const Eigen::Vector2f& next_right = i < gates_.size() ? gates_[i].right : end;
    if (right_turn(apex_, right, next_right) <= 0) {
      if (right == apex_ || right_turn(apex_, left, next_right) > 0) {
        right = next_right;
        right_gate = i;
      } else {
        i = left_gate;
        bend_at(i, left);
        right = left;
        right_gate = i;
        continue;
      }
    }
    if (right_turn(apex_, left, next_left) >= 0) {
      if (left == apex_ || right_turn(apex_, right, next_left) < 0) {
        left = next_left;
        left_gate = i;
      } else {
        i = right_gate;
        bend_at(i, right);
        left = right;
        left_gate = i;
        continue;
      }
    }
  }
  bend_at(gates_.size(), end);
}

}  // namespace throng::crowd
