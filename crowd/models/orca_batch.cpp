#include "crowd/models/orca_batch.h"

#include <algorithm>

#include "crowd/models/disc_lanes.h"
namespace throng::crowd {

OrcaBatch::OrcaBatch(std::size_t neighbors, std::size_t walls) : agents_(neighbors) {
  make_room(neighbors + walls);
}

void OrcaBatch::make_room(std::size_t planes) {
  if (planes_.size() >= planes) return;
  planes_.resize(planes);
  scratch_.resize(planes);
}

void OrcaBatch::clear() {
  agents_.clear();
  wall_rows_ = 0;
}

void OrcaBatch::add(const Agent& agent, const HalfPlanes& walls,
                    std::span<const Grid::Neighbor> neighbors) {
  const std::size_t lane = agents_.add(agent.slot, neighbors);
  wall_rows_ = std::max(wall_rows_, walls.size());
  make_room(wall_rows_ + agents_.rows());
  set_wish(lane, agent.horizon_s, agent.preferred);
  max_speed_[lane] = agent.max_speed;
  walls_[lane] = static_cast<float>(walls.size());
  for (std::size_t i = 0; i < walls.size(); ++i) {
    Row& row = planes_[i];
    row.point_x[lane] = walls.point_x[i];
    row.point_y[lane] = walls.point_y[i];
    row.direction_x[lane] = walls.direction_x[i];
    row.direction_y[lane] = walls.direction_y[i];
  }
}

struct OrcaKernel {
  template <int kWidth>
  using Float = typename Vectors<kWidth>::Float;

  template <int kWidth>
  static void run(const Grid& grid, float dt_s, OrcaBatch& batch) {
    batch.make_room(1);
    fill(batch);
    for (std::size_t first = 0; first < batch.agents_.size(); first += kWidth) {
      lanes<kWidth>(grid, dt_s, first, batch);
    }
  }

  static void fill(OrcaBatch& batch) {
    batch.agents_.fill();
    for (std::size_t lane = batch.agents_.size(); lane < OrcaBatch::kAgents; ++lane) {
      batch.walls_[lane] = batch.preferred_x_[lane] = batch.preferred_y_[lane] = 0;
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
    const WritablePlaneRows planes = rows<kWidth>(batch.planes_, first);
    const WritablePlaneRows scratch = rows<kWidth>(batch.scratch_, first);
    forget_absent<kWidth>(planes, first, batch);
    const LaneBatch& agents = batch.agents_;
    const auto self = discs_in<kWidth>(grid, &agents.slots()[first]);
    const Float<kWidth> cutoff = load<kWidth>(&batch.cutoff_[first]);
    const Float<kWidth> count = load<kWidth>(&agents.neighbors()[first]);
    for (std::size_t i = 0; i < agents.rows(); ++i) {
      const auto there = count > static_cast<float>(i);
      const auto others = agents.row<kWidth>(i, first);
      auto other = discs_in<kWidth>(grid, others.data());
      if (any(there & (other.x == self.x) & (other.y == self.y))) {
        part<kWidth>(grid, self, &agents.slots()[first], others.data(), other);
      }
      const auto plane =
          avoid_disc_lanes<Float<kWidth>>(self, other, cutoff, broadcast<kWidth>(1 / dt_s));
      const Float<kWidth> none{};
      planes.set<Float<kWidth>>(
          batch.wall_rows_ + i,
          {there ? plane.point_x : none, there ? plane.point_y : none,
           there ? plane.direction_x : none, there ? plane.direction_y : none});
    }
    const auto v = PlaneSolver<Float<kWidth>>::solve(
        planes, batch.wall_rows_ + agents.rows(), load<kWidth>(&batch.walls_[first]),
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
