#include "crowd/orca_batch.h"

#include <algorithm>

#include "crowd/disc_lanes.h"

namespace throng::crowd {

OrcaBatch::OrcaBatch(std::size_t neighbors, std::size_t walls) { make_room(neighbors, walls); }

void OrcaBatch::make_room(std::size_t neighbors, std::size_t walls) {
  if (others_.size() < neighbors) others_.resize(neighbors);
  if (planes_.size() < neighbors + walls) {
    planes_.resize(neighbors + walls);
    scratch_.resize(neighbors + walls);
  }
}

void OrcaBatch::clear() { size_ = wall_rows_ = neighbor_rows_ = 0; }

void OrcaBatch::add(const Agent& agent, const HalfPlanes& walls,
                    std::span<const Grid::Neighbor> neighbors) {
  make_room(std::max(neighbor_rows_, neighbors.size()), std::max(wall_rows_, walls.size()));
  const std::size_t lane = size_++;
  slots_[lane] = static_cast<std::uint32_t>(agent.slot);
  cutoff_[lane] = 1 / agent.horizon_s;
  preferred_x_[lane] = agent.preferred.x();
  preferred_y_[lane] = agent.preferred.y();
  max_speed_[lane] = agent.max_speed;
  walls_[lane] = static_cast<float>(walls.size());
  neighbors_[lane] = static_cast<float>(neighbors.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    Row& row = planes_[i];
    row.point_x[lane] = walls.point_x[i];
    row.point_y[lane] = walls.point_y[i];
    row.direction_x[lane] = walls.direction_x[i];
    row.direction_y[lane] = walls.direction_y[i];
  }
  for (std::size_t i = 0; i < neighbors.size(); ++i) others_[i][lane] = neighbors[i].slot;
  wall_rows_ = std::max(wall_rows_, walls.size());
  neighbor_rows_ = std::max(neighbor_rows_, neighbors.size());
}

struct OrcaKernel {
  template <int kWidth>
  using Float = typename Vectors<kWidth>::Float;

  template <int kWidth>
  static void run(const Grid& grid, float dt_s, OrcaBatch& batch) {
    fill(batch);
    for (std::size_t first = 0; first < batch.size_; first += kWidth) {
      lanes<kWidth>(grid, dt_s, first, batch);
    }
  }

  /// Lanes without an agent do what the first one does.
  static void fill(OrcaBatch& batch) {
    for (std::size_t lane = batch.size_; lane < OrcaBatch::kAgents; ++lane) {
      batch.slots_[lane] = batch.slots_[0];
      batch.walls_[lane] = batch.neighbors_[lane] = 0;
      batch.preferred_x_[lane] = batch.preferred_y_[lane] = 0;
      batch.cutoff_[lane] = batch.max_speed_[lane] = 1;
    }
  }

  template <int kWidth>
  static WritablePlaneRows rows(std::vector<OrcaBatch::Row>& rows, std::size_t first) {
    OrcaBatch::Row& row = rows.front();
    return {&row.point_x[first], &row.point_y[first], &row.direction_x[first],
            &row.direction_y[first], sizeof(OrcaBatch::Row) / sizeof(float)};
  }

  template <int kWidth>
  static void lanes(const Grid& grid, float dt_s, std::size_t first, OrcaBatch& batch) {
    if (batch.planes_.empty()) batch.make_room(1, 0);
    const WritablePlaneRows planes = rows<kWidth>(batch.planes_, first);
    const WritablePlaneRows scratch = rows<kWidth>(batch.scratch_, first);
    forget_absent<kWidth>(planes, first, batch);
    const auto self = discs<kWidth>(grid, &batch.slots_[first]);
    const Float<kWidth> cutoff = load<kWidth>(&batch.cutoff_[first]);
    const Float<kWidth> count = load<kWidth>(&batch.neighbors_[first]);
    for (std::size_t i = 0; i < batch.neighbor_rows_; ++i) {
      const auto there = count > static_cast<float>(i);
      auto others = batch.others_[i];
      for (std::size_t lane = first; lane < first + kWidth; ++lane) {
        if (!(batch.neighbors_[lane] > static_cast<float>(i))) others[lane] = batch.slots_[lane];
      }
      auto other = discs<kWidth>(grid, &others[first]);
      if (any(there & (other.x == self.x) & (other.y == self.y))) {
        part<kWidth>(grid, self, &batch.slots_[first], &others[first], other);
      }
      const auto plane =
          avoid_disc_lanes<Float<kWidth>>(self, other, cutoff, every<kWidth>(1 / dt_s));
      const Float<kWidth> none{};
      planes.set<Float<kWidth>>(
          batch.wall_rows_ + i,
          {there ? plane.point_x : none, there ? plane.point_y : none,
           there ? plane.direction_x : none, there ? plane.direction_y : none});
    }
    const auto v = PlaneSolver<Float<kWidth>>::solve(
        planes, batch.wall_rows_ + batch.neighbor_rows_, load<kWidth>(&batch.walls_[first]),
        {load<kWidth>(&batch.preferred_x_[first]), load<kWidth>(&batch.preferred_y_[first])},
        load<kWidth>(&batch.max_speed_[first]), scratch);
    store(v.x, &batch.velocity_x_[first]);
    store(v.y, &batch.velocity_y_[first]);
  }

  /// Rows of walls that an agent does not have bound nothing.
  template <int kWidth>
  static void forget_absent(const WritablePlaneRows& planes, std::size_t first,
                            const OrcaBatch& batch) {
    const Float<kWidth> count = load<kWidth>(&batch.walls_[first]);
    const Float<kWidth> none{};
    for (std::size_t i = 0; i < batch.wall_rows_; ++i) {
      const auto there = count > static_cast<float>(i);
      const auto plane = planes.at<Float<kWidth>>(i);
      planes.set<Float<kWidth>>(
          i, {there ? plane.point_x : none, there ? plane.point_y : none,
              there ? plane.direction_x : none, there ? plane.direction_y : none});
    }
  }

  template <int kWidth>
  static DiscLanes<Float<kWidth>> discs(const Grid& grid, const std::uint32_t* slots) {
    DiscLanes<Float<kWidth>> discs;
    std::array<Float4, kWidth> bodies;
    for (std::size_t i = 0; i < kWidth; ++i) {
      bodies[i] = load<4>(grid.body(slots[i]).position.data());
      discs.radius[i] = grid.radius(slots[i]);
    }
    transpose(bodies, discs.x, discs.y, discs.vx, discs.vy);
    return discs;
  }

  /// Two in one place part along x, the one with the higher id to the right.
  template <int kWidth>
  static void part(const Grid& grid, const DiscLanes<Float<kWidth>>& self,
                   const std::uint32_t* slots, const std::uint32_t* others,
                   DiscLanes<Float<kWidth>>& other) {
    for (std::size_t i = 0; i < kWidth; ++i) {
      if (other.x[i] != self.x[i] || other.y[i] != self.y[i]) continue;
      other.x[i] += grid.id(others[i]) > grid.id(slots[i]) ? kOrcaNudge : -kOrcaNudge;
    }
  }
};

OrcaBatch::Kernel* OrcaBatch::kernel(InstructionSet set) {
  return Versions<OrcaKernel, Kernel>::pick(set);
}

}  // namespace throng::crowd
