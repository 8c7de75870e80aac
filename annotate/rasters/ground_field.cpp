#include "annotate/rasters/ground_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "annotate/rasters/density.h"
#include "base/error.h"
#include "base/geometry/point_grid.h"

namespace throng::annotate {

using Eigen::Vector2d;

namespace {

constexpr std::size_t kMaxCells = 1U << 17U;
constexpr double kKernelReach = 3;  // times kFieldKernelM

// Finds x where a line of constant y enters and leaves rings, in order: pairs of these are inside.
void find_edges(const std::vector<metrics::Ring>& rings, double y, std::vector<double>& edges) {
  edges.clear();
  for (const metrics::Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector2d& a = ring[i];
      const Vector2d& b = ring[(i + 1) % ring.size()];
      if ((a.y() > y) == (b.y() > y)) continue;
      edges.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
  }
  std::sort(edges.begin(), edges.end());
}

struct RowRange {
  int first = 0;
  int last = -1;
};

// The exact areas of a polygon in the cells of a grid, whose cells are squares of side 1. By
// Green's theorem, the area in cell (row, column) is the integral of clamp(x - column, 0, 1) dy
// along the polygon's edges in the row.
class CoveredPatch {
 public:
  /// Begins a polygon with these bounds.
  void reset(const Eigen::AlignedBox2d& bounds) {
    first_ = bounds.min().array().floor().cast<int>();
    size_ = Eigen::Vector2i(bounds.max().array().floor().cast<int>()) - first_ +
            Eigen::Vector2i::Ones();
    partial_.assign(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()), 0);
    left_.assign(partial_.size(), 0);
  }

  void add_edge(const Vector2d& a, const Vector2d& b) {
    cuts_ = {0, 1};
    for (const int axis : {0, 1}) {
      const auto [low, high] = std::minmax(a[axis], b[axis]);
      for (double border = std::floor(low) + 1; border < high; ++border) {
        cuts_.push_back((border - a[axis]) / (b[axis] - a[axis]));
      }
    }
    std::sort(cuts_.begin(), cuts_.end());
    for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
      const Vector2d middle = a + (b - a) * (cuts_[i] + cuts_[i + 1]) / 2;
      const double dy = (b.y() - a.y()) * (cuts_[i + 1] - cuts_[i]);
      const double column = std::floor(middle.x());
      const std::size_t cell =
          at(static_cast<int>(std::floor(middle.y())), static_cast<int>(column));
      partial_[cell] += (middle.x() - column) * dy;
      left_[cell] += dy;
    }
  }

  /// Calls body(row, column, area) for each cell with a part of the polygon.
  template <typename Body>
  void visit(const Body& body) const {
    for (int row = first_.y(); row < first_.y() + size_.y(); ++row) {
      double whole = 0;  // of cells left of the edges
      for (int column = first_.x() + size_.x() - 1; column >= first_.x(); --column) {
        const double area = partial_[at(row, column)] + whole;
        whole += left_[at(row, column)];
        if (area > 0) body(row, column, area);
      }
    }
  }

 private:
  std::size_t at(int row, int column) const {
    const int y = std::clamp(row - first_.y(), 0, size_.y() - 1);
    const int x = std::clamp(column - first_.x(), 0, size_.x() - 1);
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_.x()) +
           static_cast<std::size_t>(x);
  }

  Eigen::Vector2i first_ = Eigen::Vector2i::Zero();
  Eigen::Vector2i size_ = Eigen::Vector2i::Zero();
  std::vector<double> partial_;  // in the cells with the edges
  std::vector<double> left_;     // in all cells left of these
  std::vector<double> cuts_;
};

}  // namespace

// Draws into the cells of a grid.
class FieldPainter {
 public:
  explicit FieldPainter(const GroundGrid& grid) : grid_(grid) {}

  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns_) +
           static_cast<std::size_t>(column);
  }

  /// Calls body(index) for all cells with their middle inside of the rings, by the even-odd rule.
  template <typename Body>
  void fill(const std::vector<metrics::Ring>& rings, const Body& body) {
    double low = rings.front().front().y();
    double high = low;
    for (const Vector2d& corner : rings.front()) {
      low = std::min(low, corner.y());
      high = std::max(high, corner.y());
    }
    const RowRange rows = middles(low - grid_.origin_.y(), high - grid_.origin_.y(), grid_.rows_);
    for (int row = rows.first; row <= rows.last; ++row) {
      find_edges(rings, grid_.origin_.y() + (row + 0.5) * grid_.cell_m_, edges_);
      for (std::size_t i = 0; i + 1 < edges_.size(); i += 2) {
        const RowRange columns = middles(edges_[i] - grid_.origin_.x(),
                                         edges_[i + 1] - grid_.origin_.x(), grid_.columns_);
        for (int column = columns.first; column <= columns.last; ++column) body(index(row, column));
      }
    }
  }

  /// Calls body(index, share) for the cells of which the rings cover a share: outlines
  /// counter-clockwise, holes clockwise.
  template <typename Body>
  void cover(const std::vector<metrics::Ring>& rings, const Body& body) {
    Eigen::AlignedBox2d bounds;
    for (const metrics::Ring& ring : rings) {
      for (const Vector2d& corner : ring) bounds.extend(in_cells(corner));
    }
    patch_.reset(bounds);
    for (const metrics::Ring& ring : rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        patch_.add_edge(in_cells(ring[i]), in_cells(ring[(i + 1) % ring.size()]));
      }
    }
    patch_.visit([&](int row, int column, double share) {
      if (row < 0 || row >= grid_.rows_ || column < 0 || column >= grid_.columns_) return;
      body(index(row, column), share);
    });
  }

  /// A person's kernel, summing to 1 over the cells where one can walk; all of it in the person's
  /// own cell where there is none near.
  void add(const Vector2d& place, const Eigen::Vector2f& velocity, std::vector<double>& weight,
           std::vector<double>& x, std::vector<double>& y) {
    const double reach = kKernelReach * kFieldKernelM;
    const Vector2d at = place - grid_.origin_;
    const RowRange rows = middles(at.y() - reach, at.y() + reach, grid_.rows_);
    const RowRange columns = middles(at.x() - reach, at.x() + reach, grid_.columns_);
    share_.clear();
    double sum = 0;
    for (int row = rows.first; row <= rows.last; ++row) {
      for (int column = columns.first; column <= columns.last; ++column) {
        const std::size_t cell = index(row, column);
        if (!grid_.walkable_[cell]) continue;
        const Vector2d middle = grid_.cell_m_ * Vector2d(column + 0.5, row + 0.5);
        const double squared = (middle - at).squaredNorm();
        if (squared > reach * reach) continue;
        share_.emplace_back(cell, std::exp(-squared / (kFieldKernelM * kFieldKernelM)));
        sum += share_.back().second;
      }
    }
    if (share_.empty()) {
      share_.emplace_back(index(own(at.y(), grid_.rows_), own(at.x(), grid_.columns_)), sum = 1);
    }
    for (const auto& [cell, share] : share_) {
      weight[cell] += share / sum;
      x[cell] += share / sum * velocity.x();
      y[cell] += share / sum * velocity.y();
    }
  }

  /// The grid's cutter.
  const metrics::VoronoiCutter& cutter() const { return grid_.cutter_; }

 private:
  Vector2d in_cells(const Vector2d& place) const { return (place - grid_.origin_) / grid_.cell_m_; }

  // The cells whose middles lie between two distances from the origin.
  RowRange middles(double from_m, double until_m, int count) const {
    const double first = std::ceil(from_m / grid_.cell_m_ - 0.5);
    const double last = std::floor(until_m / grid_.cell_m_ - 0.5);
    return {static_cast<int>(std::max(first, 0.0)),
            static_cast<int>(std::min(last, static_cast<double>(count - 1)))};
  }
  int own(double at_m, int count) const {
    return std::clamp(static_cast<int>(at_m / grid_.cell_m_), 0, count - 1);
  }

  const GroundGrid& grid_;
  std::vector<double> edges_;
  CoveredPatch patch_;
  std::vector<std::pair<std::size_t, double>> share_;
};

namespace {

int cells_along(double length_m, double cell_m) {
  return std::max(1, static_cast<int>(std::ceil(length_m / cell_m - 1e-9)));
}

}  // namespace

double ground_cell_m(const world::Rectangle& ground) {
  double cell_m = 0.25;
  const Vector2d size = ground.max - ground.min;
  while (static_cast<std::size_t>(cells_along(size.x(), cell_m)) *
             static_cast<std::size_t>(cells_along(size.y(), cell_m)) >
         kMaxCells) {
    cell_m *= 2;
  }
  return cell_m;
}

GroundGrid::GroundGrid(const world::Scenario& scenario)
    : origin_(scenario.ground.min),
      cell_m_(ground_cell_m(scenario.ground)),
      cutter_(scenario.buildings) {
  const Vector2d size = scenario.ground.max - scenario.ground.min;
  columns_ = cells_along(size.x(), cell_m_);
  rows_ = cells_along(size.y(), cell_m_);
  walkable_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), true);
  FieldPainter painter(*this);
  for (const world::Building& building : scenario.buildings) {
    painter.fill({building.footprint}, [&](std::size_t cell) { walkable_[cell] = false; });
  }
}

GroundField ground_field(const world::Trace& trace, const GroundGrid& grid, double time_s) {
  const world::BetweenSteps around = trace.steps_around(time_s);
  std::vector<Vector2d> places;
  std::vector<Eigen::Vector2f> velocities;
  const Vector2d size = grid.cell_m() * Vector2d(grid.columns(), grid.rows());
  const std::optional<std::size_t> on_stand = trace.header.first_stand_state();
  for (std::size_t agent = 0; agent < trace.agents(); ++agent) {
    if (trace.header.role[agent] != world::AgentRole::person ||
        !trace.present(around.before, agent)) {
      continue;
    }
    if (on_stand && trace.state[trace.at(around.before, agent)] >= *on_stand) continue;
    const Vector2d place = trace.position_at(around, agent).cast<double>();
    const Eigen::Array2d offset = (place - grid.origin()).array();
    if ((offset < 0).any() || (offset >= size.array()).any()) continue;
    places.push_back(place);
    velocities.push_back(trace.velocity_at(around, agent));
  }
  GroundField field;
  field.people = static_cast<std::int64_t>(places.size());
  std::vector<double> voronoi(grid.cells());
  std::vector<double> weight(grid.cells());
  std::vector<double> x(grid.cells());
  std::vector<double> y(grid.cells());
  FieldPainter painter(grid);
  constexpr double kNeighborGridM = 0.8;
  const geometry::PointGrid neighbors(places, kNeighborGridM);
  for (std::size_t i = 0; i < places.size(); ++i) {
    painter.add(places[i], velocities[i], weight, x, y);
    const metrics::VoronoiCell cell = painter.cutter().cell(neighbors, i);
    // Everybody who shares the cell adds their part.
    painter.cover(cell.rings,
                  [&](std::size_t index, double share) { voronoi[index] += share / cell.area_m2; });
  }
  const double cell_m2 = grid.cell_m() * grid.cell_m();
  for (std::size_t i = 0; i < grid.cells(); ++i) {
    const double mean = weight[i] > 0 ? 1 / weight[i] : 0;
    field.density.push_back(static_cast<float>(weight[i] / cell_m2));
    field.velocity_x.push_back(static_cast<float>(x[i] * mean));
    field.velocity_y.push_back(static_cast<float>(y[i] * mean));
    field.voronoi.push_back(static_cast<float>(voronoi[i]));
  }
  return field;
}

std::string npy_bytes(const GroundGrid& grid, const GroundField& field) {
  std::vector<float> values = field.density;
  for (const auto* plane : {&field.velocity_x, &field.velocity_y, &field.voronoi}) {
    values.insert(values.end(), plane->begin(), plane->end());
  }
  return npy_bytes(std::array{4, grid.rows(), grid.columns()}, values);
}

}  // namespace throng::annotate
