#include "crowd/navigation/travel_field.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <limits>

namespace throng::crowd {

namespace {

constexpr float kFar = std::numeric_limits<float>::infinity();
constexpr unsigned kPointBits = 32;

/// A cost, which is not negative, and the point that it is for as one number, in the order of cost
/// and then of the point: one comparison instead of two.
std::uint64_t open_entry(float cost, int point) {
  return (std::uint64_t{std::bit_cast<std::uint32_t>(cost)} << kPointBits) |
         static_cast<std::uint32_t>(point);
}

std::pair<float, int> read_entry(std::uint64_t entry) {
  return {std::bit_cast<float>(static_cast<std::uint32_t>(entry >> kPointBits)),
          static_cast<int>(static_cast<std::uint32_t>(entry))};
}

}  // namespace

PortalTable::PortalTable(const NavMesh& mesh)
    : out_of_(mesh.polygons().size()), into_(mesh.polygons().size()) {
  for (std::size_t polygon = 0; polygon < mesh.polygons().size(); ++polygon) {
    for (const Portal& portal : mesh.polygons()[polygon].portals) {
      const int number = static_cast<int>(entries_.size());
      constexpr float kSpacingM = 4;
      constexpr int kMaxPoints = 9;
      const float width = (portal.right - portal.left).norm();
      const int points = std::clamp(2 + static_cast<int>(width / kSpacingM), 2, kMaxPoints);
      entries_.push_back(
          {static_cast<int>(polygon), portal, static_cast<int>(points_.size()), points});
      for (int i = 0; i < points; ++i) {
        const float share = static_cast<float>(i) / static_cast<float>(points - 1);
        points_.push_back({number, portal.left + share * (portal.right - portal.left)});
      }
      out_of_[polygon].push_back(number);
      into_[static_cast<std::size_t>(portal.to)].push_back(number);
    }
  }
}

TravelField::Buffers::Buffers(const PortalTable& portals) {
  constexpr std::size_t kEntriesPerPoint = 8;  // shorter paths replace some that wait
  gates.reserve(portals.entries().size());
  firsts.reserve(portals.entries().size());
  open.reserve(kEntriesPerPoint * portals.points().size());
}

TravelField::TravelField(const PortalTable& portals)
    : portals_(&portals), nodes_(portals.points().size()) {}

void TravelField::lead_to(const NavMesh::Location& goal, const Congestion& congestion,
                          Buffers& buffers) {
  goal_ = goal;
  renew(congestion, buffers);
}

void TravelField::reach(int node, float cost, int next, Buffers& buffers) {
  Node& reached = nodes_[static_cast<std::size_t>(node)];
  if (cost >= reached.cost) return;
  reached = {cost, next};
  buffers.open.push_back(open_entry(cost, node));
  std::push_heap(buffers.open.begin(), buffers.open.end(), std::greater<>());
}

void TravelField::renew(const Congestion& congestion, Buffers& buffers) {
  std::vector<std::uint64_t>& open = buffers.open;
  has_delays_ = !congestion.is_nil();
  std::fill(nodes_.begin(), nodes_.end(), Node{kFar, -1});
  open.clear();
  constexpr float kPortalM = 1e-3F;  // so that no path winds around the common end of portals
  const std::vector<PortalTable::Point>& points = portals_->points();
  const auto reach_from = [&](int polygon, int next, const Eigen::Vector2f& place, float cost) {
    for (const int portal : portals_->into(polygon)) {
      const PortalTable::Entry& entry = portals_->entries()[static_cast<std::size_t>(portal)];
      for (int node = entry.first_point; node < entry.first_point + entry.points; ++node) {
        // Most points are closer to the goal.
        if (nodes_[static_cast<std::size_t>(node)].cost <= cost) continue;
        const Eigen::Vector2f& before = points[static_cast<std::size_t>(node)].place;
        const float least = cost + kPortalM + (place - before).norm();
        if (least < nodes_[static_cast<std::size_t>(node)].cost) {
          reach(node, least + congestion.delay_m(before, place), next, buffers);
        }
      }
    }
  };
  reach_from(goal_.polygon, -1, goal_.point, 0);
  while (!open.empty()) {
    std::pop_heap(open.begin(), open.end(), std::greater<>());
    const auto [cost, node] = read_entry(open.back());
    open.pop_back();
    if (cost > nodes_[static_cast<std::size_t>(node)].cost) continue;
    const PortalTable::Point& here = points[static_cast<std::size_t>(node)];
    reach_from(portals_->entries()[static_cast<std::size_t>(here.portal)].from, node, here.place,
               cost);
  }
}

void TravelField::collect(int node, std::vector<Gate>& gates) const {
  gates.clear();
  for (; node >= 0; node = nodes_[static_cast<std::size_t>(node)].next) {
    const int number = portals_->points()[static_cast<std::size_t>(node)].portal;
    const Portal& portal = portals_->entries()[static_cast<std::size_t>(number)].portal;
    gates.push_back({portal.to, portal.left, portal.right, portal.left, portal.left, portal.right});
  }
}

float TravelField::find(const NavMesh::Location& from, const Eigen::Vector2f& to,
                        const Congestion& congestion, PathFinder& path, Buffers& buffers) const {
  std::vector<Gate>& gates = buffers.gates;
  std::vector<std::pair<float, int>>& firsts = buffers.firsts;
  gates.clear();
  firsts.clear();
  if (from.polygon == goal_.polygon) {
    path.find_through(gates, from.point, to);
    return path_cost_m(from.point, path.bends(), congestion);
  }
  // The best few portals out of here; which of them is best shows when the path is pulled tight.
  constexpr std::size_t kTries = 3;
  for (const int portal : portals_->out_of(from.polygon)) {
    std::pair<float, int> best(kFar, -1);
    const PortalTable::Entry& entry = portals_->entries()[static_cast<std::size_t>(portal)];
    for (int node = entry.first_point; node < entry.first_point + entry.points; ++node) {
      const Eigen::Vector2f& place = portals_->points()[static_cast<std::size_t>(node)].place;
      const float cost = nodes_[static_cast<std::size_t>(node)].cost + (place - from.point).norm() +
                         congestion.delay_m(from.point, place);
      best = std::min(best, {cost, node});
    }
    if (best.first < kFar) firsts.push_back(best);
  }
  std::sort(firsts.begin(), firsts.end());
  firsts.resize(std::min(firsts.size(), kTries));
  float best = kFar;
  int best_node = -1;
  for (const auto& [estimate, node] : firsts) {
    collect(node, gates);
    path.find_through(gates, from.point, to);
    const float cost = path_cost_m(from.point, path.bends(), congestion);
    if (cost >= best) continue;
    best = cost;
    best_node = node;
  }
  if (best_node < 0) return kFar;
  collect(best_node, gates);
  path.find_through(gates, from.point, to);
  return best;
}

float path_cost_m(const Eigen::Vector2f& from, std::span<const Eigen::Vector2f> bends,
                  const Congestion& congestion) {
  float cost = 0;
  Eigen::Vector2f at = from;
  for (const Eigen::Vector2f& bend : bends) {
    cost += (bend - at).norm() + congestion.delay_m(at, bend);
    at = bend;
  }
  return cost;
}

}  // namespace throng::crowd
