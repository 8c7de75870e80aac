#include "skinning/bake/carving.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/geometry/angle.h"
#include "skinning/bake/outline.h"

namespace throng::skinning {

namespace {

constexpr float kCellM = 0.012F;
constexpr float kJustM = 1e-4F;  // inside or outside
constexpr int kMarginCells = 4;  // cells around everything

// Silhouettes from opposite sides are the same, so half a turn is enough for level views.
std::vector<Outline> extract_outlines(std::span<const PosedSurface> surfaces) {
  struct Round {
    double elevation_deg;
    double turn_deg;
    int views;
  };
  constexpr std::array<Round, 4> kRounds = {
      {{0, 180, 16}, {25, 360, 16}, {50, 360, 12}, {75, 360, 6}}};
  std::vector<Outline> outlines;
  for (const Round& round : kRounds) {
    for (int i = 0; i < round.views; ++i) {
      // Spread so that neighbors come late: most of the volume around is carved by the first few.
      const int view = (5 * i) % round.views;
      outlines.emplace_back(surfaces, kDegree * round.turn_deg * view / round.views,
                            kDegree * round.elevation_deg);
    }
  }
  return outlines;
}

}  // namespace

Carving::Carving(std::span<const PosedSurface> all) {
  std::vector<PosedSurface> surfaces;
  Eigen::AlignedBox3f bounds;
  for (const PosedSurface& posed : all) {
    if (posed.surface->painted) continue;
    surfaces.push_back(posed);
    for (const std::uint32_t index : posed.surface->indices) bounds.extend(posed.points[index]);
  }
  low_ = bounds.min().array() - kMarginCells * kCellM;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float extent = bounds.sizes()[static_cast<Eigen::Index>(axis)];
    size_[axis] = static_cast<int>(std::ceil(extent / kCellM)) + 2 * kMarginCells;
  }
  const std::vector<Outline> outlines = extract_outlines(surfaces);
  distance_m_.resize(static_cast<std::size_t>(size_[0]) * size_[1] * size_[2]);
  Cell cell{};
  for (cell[2] = 0; cell[2] < size_[2]; ++cell[2]) {
    for (cell[1] = 0; cell[1] < size_[1]; ++cell[1]) {
      for (cell[0] = 0; cell[0] < size_[0]; ++cell[0]) {
        const Eigen::Vector3f offset(static_cast<float>(cell[0]), static_cast<float>(cell[1]),
                                     static_cast<float>(cell[2]));
        const Eigen::Vector3f point = low_ + kCellM * offset;
        float max_distance_m = -1;
        for (const Outline& outline : outlines) {
          max_distance_m = std::max(max_distance_m, outline.distance_m(point));
          if (max_distance_m >= kFarM) break;
        }
        distance_m_[place(cell)] = max_distance_m;
      }
    }
  }
  drop_specks();
  close_pinches();
  drop_specks();  // what was closed may be a bubble now
}

// Strands of hair leave crumbs in the air, and there may be bubbles: both would take triangles that
// nobody sees.
void Carving::drop_specks() {
  constexpr std::size_t kMinPieceCells = 300;  // cells: half a liter
  const std::array<std::size_t, 3> step = {place({1, 0, 0}), place({0, 1, 0}), place({0, 0, 1})};
  std::vector<char> known(distance_m_.size(), 0);
  std::vector<std::size_t> piece;
  const auto flood = [&](std::size_t from) {
    const bool side = distance_m_[from] < 0;
    piece.assign(1, from);
    known[from] = 1;
    for (std::size_t next = 0; next < piece.size(); ++next) {
      for (const std::size_t stride : step) {
        for (const std::size_t to : {piece[next] + stride, piece[next] - stride}) {
          if (to >= known.size() || known[to] != 0 || (distance_m_[to] < 0) != side) continue;
          known[to] = 1;
          piece.push_back(to);
        }
      }
    }
  };
  flood(0);  // what is around everything
  for (std::size_t at = 0; at < known.size(); ++at) {
    if (known[at] != 0) continue;
    const bool side = distance_m_[at] < 0;
    flood(at);
    if (side && piece.size() >= kMinPieceCells) continue;
    for (const std::size_t cell : piece) distance_m_[cell] = side ? kJustM : -kJustM;
  }
}

// Parts of the hull that touch along an edge or in a corner of the grid only would make a
// non-manifold surface, which cannot be simplified: fills the voxels between until there is no such
// place (well-composed sets, Latecki, Eckhardt and Rosenfeld 1995).
void Carving::close_pinches() {
  const std::array<std::size_t, 3> step = {place({1, 0, 0}), place({0, 1, 0}), place({0, 0, 1})};
  const auto inside = [&](std::size_t at) { return distance_m_[at] < 0; };
  bool changed = true;
  const auto fill = [&](std::size_t at) {
    if (inside(at)) return;
    distance_m_[at] = -kJustM;
    changed = true;
  };
  const auto close_square = [&](std::size_t at, std::size_t u, std::size_t v) {
    const bool pinched = inside(at) == inside(at + u + v) && inside(at + u) == inside(at + v) &&
                         inside(at) != inside(at + u);
    if (!pinched) return;
    for (const std::size_t corner : {at, at + u, at + v, at + u + v}) fill(corner);
  };
  // Two opposite corners of a cube alone on their side.
  const auto close_cube = [&](std::size_t at) {
    const std::size_t all = step[0] + step[1] + step[2];
    for (const std::size_t first : {std::size_t{0}, step[0], step[1], step[2]}) {
      const bool side = inside(at + first);
      if (side != inside(at + all - first)) continue;
      int same = 0;
      for (std::size_t corner = 0; corner < 8; ++corner) {
        const std::size_t offset =
            (corner & 1) * step[0] + (corner >> 1 & 1) * step[1] + (corner >> 2 & 1) * step[2];
        same += inside(at + offset) == side ? 1 : 0;
      }
      if (same != 2) continue;
      for (const std::size_t axis : step) {
        fill(at + axis);
        fill(at + all - axis);
      }
      fill(at);
      fill(at + all);
    }
  };
  while (changed) {
    changed = false;
    Cell cell{};
    for (cell[2] = 0; cell[2] + 1 < size_[2]; ++cell[2]) {
      for (cell[1] = 0; cell[1] + 1 < size_[1]; ++cell[1]) {
        for (cell[0] = 0; cell[0] + 1 < size_[0]; ++cell[0]) {
          const std::size_t at = place(cell);
          close_square(at, step[0], step[1]);
          close_square(at, step[1], step[2]);
          close_square(at, step[2], step[0]);
          close_cube(at);
        }
      }
    }
  }
}

std::size_t Carving::place(const Cell& cell) const {
  return (static_cast<std::size_t>(cell[2]) * size_[1] + cell[1]) * size_[0] + cell[0];
}

float Carving::distance_m(const Eigen::Vector3f& point) const {
  const Eigen::Vector3f at = (point - low_) / kCellM;
  Cell cell{};
  Eigen::Vector3f share;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    cell[axis] = static_cast<int>(std::floor(at[i]));
    if (cell[axis] < 0 || cell[axis] + 1 >= size_[axis]) return kFarM;
    share[i] = at[i] - static_cast<float>(cell[axis]);
  }
  float sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    float weight = 1;
    Cell of = cell;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool upper = (corner >> axis & 1) != 0;
      const float part = share[static_cast<Eigen::Index>(axis)];
      weight *= upper ? part : 1 - part;
      of[axis] += upper ? 1 : 0;
    }
    sum += weight * distance_m_[place(of)];
  }
  return sum;
}

namespace {

// The mean of where a cube's edges cross the surface, in cells from its lowest corner; nothing when
// none does.
struct Crossing {
  bool any = false;
  Eigen::Vector3f at = Eigen::Vector3f::Zero();
};

Crossing edge_crossing(const std::array<float, 8>& value) {
  Crossing crossing;
  float count = 0;
  for (int corner = 0; corner < 8; ++corner) {
    for (int axis = 0; axis < 3; ++axis) {
      const int bit = 1 << axis;
      if ((corner & bit) != 0) continue;
      const float a = value[static_cast<std::size_t>(corner)];
      const float b = value[static_cast<std::size_t>(corner | bit)];
      if ((a < 0) == (b < 0)) continue;
      Eigen::Vector3f at(static_cast<float>(corner & 1), static_cast<float>(corner >> 1 & 1),
                         static_cast<float>(corner >> 2 & 1));
      at[axis] = a / (a - b);
      crossing.at += at;
      count += 1;
    }
  }
  crossing.any = count > 0;
  if (crossing.any) crossing.at /= count;
  return crossing;
}

}  // namespace

ClosedSurface Carving::surface() const {
  ClosedSurface result;
  constexpr std::uint32_t kNone = 0xFFFFFFFF;
  std::vector<std::uint32_t> vertex_of(distance_m_.size(), kNone);
  const std::array<std::size_t, 3> step = {place({1, 0, 0}), place({0, 1, 0}), place({0, 0, 1})};
  Cell cell{};
  for (cell[2] = 0; cell[2] + 1 < size_[2]; ++cell[2]) {
    for (cell[1] = 0; cell[1] + 1 < size_[1]; ++cell[1]) {
      for (cell[0] = 0; cell[0] + 1 < size_[0]; ++cell[0]) {
        std::array<float, 8> value{};
        for (std::size_t corner = 0; corner < 8; ++corner) {
          value[corner] = distance_m_[place(cell) + (corner & 1) * step[0] +
                                      (corner >> 1 & 1) * step[1] + (corner >> 2 & 1) * step[2]];
        }
        const Crossing crossing = edge_crossing(value);
        if (!crossing.any) continue;
        vertex_of[place(cell)] = static_cast<std::uint32_t>(result.points.size());
        const Eigen::Vector3f corner(static_cast<float>(cell[0]), static_cast<float>(cell[1]),
                                     static_cast<float>(cell[2]));
        result.points.push_back(low_ + kCellM * (corner + crossing.at));
      }
    }
  }
  // Every edge of the grid that crosses the surface lies in the middle of four cubes.
  for (cell[2] = 1; cell[2] + 1 < size_[2]; ++cell[2]) {
    for (cell[1] = 1; cell[1] + 1 < size_[1]; ++cell[1]) {
      for (cell[0] = 1; cell[0] + 1 < size_[0]; ++cell[0]) {
        const std::size_t here = place(cell);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const bool inside = distance_m_[here] < 0;
          if (inside == (distance_m_[here + step[axis]] < 0)) continue;
          const std::size_t u = step[(axis + 1) % 3];
          const std::size_t v = step[(axis + 2) % 3];
          std::array<std::uint32_t, 4> quad = {vertex_of[here - u - v], vertex_of[here - v],
                                               vertex_of[here], vertex_of[here - u]};
          if (!inside) std::swap(quad[1], quad[3]);
          for (const std::size_t corner : {0, 1, 2, 0, 2, 3}) {
            result.indices.push_back(quad[corner]);
          }
        }
      }
    }
  }
  return result;
}

}  // namespace throng::skinning
