// The time-to-collision law with a fundamental diagram: people see collisions coming and avoid them
// early, and in a crowd that walks their way they are as slow as measured.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/geometry/polygon.h"
#include "crowd/models/half_planes.h"
#include "crowd/models/local_model.h"
#include "crowd/models/orca_lines.h"
#include "crowd/models/single_file.h"
#include "crowd/models/ttc_lanes.h"
#include "crowd/models/turned_shoulders.h"

namespace throng::embedded {
extern const std::string_view kTtcPosterior;
}  // namespace throng::embedded

namespace throng::crowd {

namespace {

enum Constant : std::size_t {
  strength,
  horizon,
  relaxation,
  reach,
  half_density,
  steepness,
  jam_share,
  jam_decline,
  perception,
  foresight,
  alongside,
  caution,
  caution_density,
  keep_right,
  spread,
  max_spread,
  clearance,
  headway,
  door_headway,
  turned_breadth,
  relief
};

constexpr float kWallReachM = 0.5F;     // walls farther away from the body do not push
constexpr float kWallHorizonS = 0.15F;  // how long moves stay free of walls
constexpr PassingRoom kRoom;
/// In doors people follow closely and pass the one ahead at once; passages this far ahead are
/// corridors.
constexpr PassingRoom kDoorRoom{0.5F, 0.9F};
constexpr PassingRoom kNarrow{0.9F, 1.5F};  // ground behind the walls of such doors is not taken
constexpr float kDoorM = 1.4F;
constexpr float kCorridorM = 2.0F;
constexpr float kCreep = 0.05F;  // of the free speed, in single file without a gap

/// People who stand before a wall that is straight on their way (a column) pass along it.
constexpr float kStandingMps = 0.1F;
constexpr float kMaxPassingDensity = 0.5F;  // 1/m^2 of people who walk the same way: no queue
constexpr float kTouchM = 0.05F;            // from the body to the wall
constexpr float kHeadOn = 0.9F;       // cosine between the wished direction and the wall's normal
constexpr float kPatienceS = 0.5F;    // of standing before one passes along
constexpr float kMaxPassingS = 5;     // then one stands: the wall is no column
constexpr float kGivenUpS = 10;       // counts down to kMaxPassingS while one walks
constexpr float kForgetting = 0.25F;  // how fast time counts down while one walks
constexpr float kPassingCosine = 0.17F;  // of 80 degrees, from the wished direction to the side
constexpr float kPassingSine = 0.985F;

TtcConstants read_constants(const std::vector<float>& c) {
  return {c[strength],   c[horizon],   c[relaxation],      c[reach],      c[half_density],
          c[steepness],  c[jam_share], c[jam_decline],     c[perception], c[foresight],
          c[alongside],  c[caution],   c[caution_density], c[keep_right], c[spread],
          c[max_spread], c[clearance], c[relief]};
}

/// Buffers of one thread; made by its first batch, since copies of vectors lose reserved memory.
struct Workspace {
  bool made = false;
  TtcBatch batch{0, 0};
  HalfPlanes planes;
  HalfPlanes scratch;
  std::vector<Obstacles::Near> close_walls;  // that limit velocities, of all lanes
  std::array<std::size_t, LaneBatch::kAgents + 1> first_close{};
};

Workspace make_workspace(const Crowd& crowd) {
  constexpr std::size_t kMany = 256;  // walls near one agent
  const std::size_t walls = std::min(kMany, crowd.obstacles.segments().size());
  const std::vector<float>& neighbors = crowd.agents[Property::max_neighbors];
  Workspace workspace;
  workspace.made = true;
  workspace.batch = TtcBatch(neighbors.empty() ? 0
                                               : static_cast<std::size_t>(*std::max_element(
                                                     neighbors.begin(), neighbors.end())),
                             walls);
  workspace.planes.reserve(walls);
  workspace.scratch.reserve(walls);
  workspace.close_walls.reserve(LaneBatch::kAgents * walls);
  return workspace;
}

class TimeToCollision : public Model {
 public:
  explicit TimeToCollision(const Crowd& crowd)
      : constants_(read_constants(crowd.model_constants)),
        headway_s_(crowd.model_constants[headway]),
        door_headway_s_(crowd.model_constants[door_headway]),
        neighborhood_(crowd),
        solve_(TtcBatch::pick(crowd.instruction_set)),
        workspaces_(Workspace{}),
        at_wall_s_(crowd.agents.count(), 0.0F),
        passes_wall_(crowd.agents.count(), 0),
        perceived_(crowd.agents.count(), 0.0F),
        shoulders_(crowd.agents.count(), crowd.model_constants[turned_breadth]) {}

  std::span<const float> breadths() const override { return shoulders_.breadths(); }

  void step(const Crowd& crowd, const Grid& grid,
            std::span<Eigen::Vector2f> new_velocity) override {
    neighborhood_.prepare(crowd, grid);
    workspaces_.prepare();
    sort_intents(crowd, grid);
    parallel_ranges(grid.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      Workspace& work = workspaces_.local();
      if (!work.made) work = make_workspace(crowd);
      for (std::size_t slot = begin; slot < end; slot += LaneBatch::kAgents) {
        step_batch(crowd, grid, slot, std::min(slot + LaneBatch::kAgents, end), work, new_velocity);
      }
    });
  }

 private:
  static constexpr std::size_t kGrain = 64;  // agents per task

  /// Sorts what neighbors see of each other into the grid's order.
  void sort_intents(const Crowd& crowd, const Grid& grid) {
    constexpr std::size_t kIntentGrain = 4096;
    if (intents_.size() < grid.size()) intents_.resize(grid.size());
    parallel_ranges(grid.size(), kIntentGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t slot = begin; slot < end; ++slot) {
        const std::size_t id = grid.id(slot);
        intents_[slot] = {passing_direction(crowd, id),
                          crowd.agents.preferred_speed[id] > 0 ? 1.0F : 0.0F};
      }
    });
  }

  void step_batch(const Crowd& crowd, const Grid& grid, std::size_t begin, std::size_t end,
                  Workspace& work, std::span<Eigen::Vector2f> new_velocity) {
    work.batch.clear();
    work.close_walls.clear();
    for (std::size_t slot = begin; slot < end; ++slot) {
      const AgentView around =
          neighborhood_.look(crowd, grid, slot, wall_range_m(crowd, grid, slot));
      work.first_close[slot - begin] = work.close_walls.size();
      add(crowd, grid, around, work);
    }
    work.first_close[end - begin] = work.close_walls.size();
    solve_({grid, intents_, constants_, static_cast<float>(crowd.dt_s)}, work.batch);
    for (std::size_t slot = begin; slot < end; ++slot) {
      const std::size_t lane = slot - begin;
      const std::size_t id = grid.id(slot);
      perceived_[id] = work.batch.perceived_per_m2(lane);
      const float progress = crowd.agents.velocity[id].dot(crowd.agents.preferred_direction[id]);
      shoulders_.update(id, progress, work.batch.wished_mps(lane), static_cast<float>(crowd.dt_s));
      new_velocity[id] =
          possible_velocity(crowd, id, kept_off_walls(crowd, grid, slot, lane, work));
      count_time_at_wall(crowd, grid, slot, new_velocity[id],
                         std::span(work.close_walls)
                             .subspan(work.first_close[lane],
                                      work.first_close[lane + 1] - work.first_close[lane]));
    }
  }

  /// The wished direction, turned to the side of those who pass along a wall.
  Eigen::Vector2f passing_direction(const Crowd& crowd, std::size_t id) const {
    const Eigen::Vector2f& wished = crowd.agents.preferred_direction[id];
    if (passes_wall_[id] == 0) return wished;
    constexpr std::uint64_t kSide = ~std::uint64_t{0};  // no step of the crowd's noise
    const float side =
        Random(crowd.seed, Stream::crowd_model, kSide - id).uniform() < 0.5 ? -1.0F : 1.0F;
    return kPassingCosine * wished + side * kPassingSine * Eigen::Vector2f(-wished.y(), wished.x());
  }

  /// Whether the agent touches a wall that is straight on its way.
  static bool is_before_wall(const Crowd& crowd, const Grid& grid, std::size_t slot,
                             std::span<const Obstacles::Near> walls) {
    const std::size_t id = grid.id(slot);
    const float touch_m = grid.radius(slot) + kTouchM;
    return std::any_of(walls.begin(), walls.end(), [&](const Obstacles::Near& near) {
      if (near.distance_sq > touch_m * touch_m) return false;
      const Segment& wall = crowd.obstacles.segments()[near.segment];
      const Eigen::Vector2f to_wall =
          geometry::nearest_on_segment(wall.begin, wall.end, grid.position(slot)) -
          grid.position(slot);
      return to_wall.dot(crowd.agents.preferred_direction[id]) > kHeadOn * to_wall.norm();
    });
  }

  /// Counts how long an agent has stood before a wall that is straight on its way.
  void count_time_at_wall(const Crowd& crowd, const Grid& grid, std::size_t slot,
                          const Eigen::Vector2f& velocity, std::span<const Obstacles::Near> walls) {
    const std::size_t id = grid.id(slot);
    float& time_s = at_wall_s_[id];
    const auto dt_s = static_cast<float>(crowd.dt_s);
    const bool may_be = crowd.agents.preferred_speed[id] > 0 &&
                        perceived_[id] < kMaxPassingDensity &&
                        (passes_wall_[id] != 0 || velocity.norm() <= kStandingMps);
    if (!may_be || !is_before_wall(crowd, grid, slot, walls)) {
      time_s = std::max(0.0F, time_s - kForgetting * dt_s);
      passes_wall_[id] = 0;
      return;
    }
    if (time_s < kMaxPassingS) {
      time_s += dt_s;
      if (time_s >= kMaxPassingS) time_s = kGivenUpS;
    }
    passes_wall_[id] = time_s >= kPatienceS && time_s < kMaxPassingS ? 1 : 0;
  }

  void add(const Crowd& crowd, const Grid& grid, const AgentView& around, Workspace& work) {
    const Agents& agents = crowd.agents;
    const std::size_t id = around.agent;
    constexpr float kMinReachSq = 0.01F;  // m^2: people at one position have no density
    const float reach_sq = std::max(kMinReachSq, known_reach_sq(crowd, around, constants_.reach_m));
    const float free_mps = agents[Property::pref_speed][id];
    const Passage passage = passage_around(crowd, grid, around, free_mps);
    work.batch.add({.slot = around.slot,
                    .neighbors = around.neighbors,
                    .reach_sq_m2 = reach_sq,
                    .free_mps = free_mps,
                    .max_mps = agents.preferred_speed[id],
                    .max_share = passage.max_share,
                    .enclosure = passage.enclosure,
                    .care = 1 - shoulders_.turned(id),
                    .perceived_per_m2 = perceived_[id]});
    if (around.walls.empty()) return;
    const Eigen::Vector2f& position = grid.position(around.slot);
    const float radius = grid.radius(around.slot);
    const float close_m = avoided_wall_range_m(radius, agents[Property::max_speed][id]);
    const float pushing_m = radius + kWallReachM;
    const std::vector<Segment>& segments = crowd.obstacles.segments();
    for (const Obstacles::Near& near : around.walls) {
      const Segment& wall = segments[near.segment];
      if (near.distance_sq < close_m * close_m) work.close_walls.push_back(near);
      const Eigen::Vector2f nearest =
          geometry::nearest_on_segment(wall.begin, wall.end, position) - position;
      const bool pushes =
          near.distance_sq < pushing_m * pushing_m && !is_shared_corner(segments, wall, position);
      work.batch.add_wall(wall.begin - position, wall.end - position, nearest, pushes);
    }
  }

  static float avoided_wall_range_m(float radius, float max_speed) {
    return radius + 2 * kWallHorizonS * std::max(max_speed, 1.0F);
  }

  float wall_range_m(const Crowd& crowd, const Grid& grid, std::size_t slot) const {
    const float radius = grid.radius(slot);
    const float max_speed = crowd.agents[Property::max_speed][grid.id(slot)];
    return std::max({radius + kWallReachM, kRoom.two_m, constants_.reach_m,
                     avoided_wall_range_m(radius, max_speed),
                     wall_reach_m(radius, kWallHorizonS, grid.velocity(slot).norm())});
  }

  /// The nearest velocity that leads into no wall.
  static Eigen::Vector2f kept_off_walls(const Crowd& crowd, const Grid& grid, std::size_t slot,
                                        std::size_t lane, Workspace& work) {
    const Eigen::Vector2f velocity = work.batch.velocity(lane);
    const std::size_t begin = work.first_close[lane];
    const std::size_t end = work.first_close[lane + 1];
    if (begin == end) return velocity;
    work.planes.clear();
    const Disc self{grid.position(slot), grid.velocity(slot), grid.radius(slot)};
    avoid_walls(self, crowd.obstacles.segments(),
                std::span(work.close_walls).subspan(begin, end - begin), kWallHorizonS,
                work.planes);
    return best_velocity(work.planes, work.planes.size(), velocity,
                         crowd.agents[Property::max_speed][grid.id(slot)], work.scratch);
  }

  /// Effects of the walls beside an agent.
  struct Passage {
    float max_share = 1;  ///< of the free speed, where there is room for one only
    float enclosure = 1;  ///< how much the ground behind the walls counts as taken
  };

  /// In single file, speed is at most the gap to the agent ahead divided by the headway (Seyfried
  /// et al. 2005, J. Stat. Mech. P10002). Doors are not corridors: people see the open ground
  /// behind.
  Passage passage_around(const Crowd& crowd, const Grid& grid, const AgentView& around,
                         float free_mps) const {
    if (around.walls.empty()) return {};
    const float width_m = passage_width_m(crowd, grid, around, kNarrow.two_m);
    const float ahead_m = passage_ahead_m(crowd, grid, around, constants_.reach_m);
    const float corridor = std::clamp((ahead_m - kDoorM) / (kCorridorM - kDoorM), 0.0F, 1.0F);
    Passage passage;
    passage.enclosure = 1 - kNarrow.singleness(width_m) * (1 - corridor);
    const float headway_s = corridor * headway_s_ * kRoom.singleness(width_m) +
                            (1 - corridor) * door_headway_s_ * kDoorRoom.singleness(width_m);
    if (headway_s > 0 && free_mps > 0) {
      const float gap_m = gap_ahead_m(crowd, grid, around, constants_.foresight_s);
      passage.max_share = std::clamp(gap_m / (headway_s * free_mps), kCreep, 1.0F);
    }
    return passage;
  }

  TtcConstants constants_;
  float headway_s_;
  float door_headway_s_;
  Neighborhood neighborhood_;
  TtcBatch::Solve* solve_;
  std::vector<Intent> intents_;  // by slot of the grid
  PerThread<Workspace> workspaces_;
  std::vector<float> at_wall_s_;  // by agent: standing before a wall, then passing along it
  std::vector<std::uint8_t> passes_wall_;  // by agent
  std::vector<float> perceived_;  // density of people who walk the same way, by agent, 1/m^2
  TurnedShoulders shoulders_;
};

std::unique_ptr<Model> make_ttc(const Crowd& crowd) {
  return std::make_unique<TimeToCollision>(crowd);
}

}  // namespace

ModelEntry ttc_model() {
  return {
      "ttc",
      "TimeToCollision",
      "time-to-collision power law (Karamouzas, Skinner and Guy 2014) with a fundamental "
      "diagram of people who walk "
      "the same way: lanes and crossings flow, doors and dense crowds have the flows of "
      "experiments",
      {},
      {{"strength", 2.42F, 0, 100, "of the avoidance of collisions, in m^2"},
       {"horizon", 4.03F, 0.01F, 100, "time to a collision over which avoidance fades, in s"},
       {"relaxation", 0.121F, 0.01F, 10, "in which the preferred velocity is taken, in s"},
       {"reach", 3.22F, 0.1F, 100, "how far away others count as density, in m"},
       {"half_density", 1.475F, 0.1F, 100,
        "at which people walk at half of their free speed, per m^2"},
       {"steepness", 1.9F, 0.1F, 100, "of the fall of speed with density, in m^2"},
       {"jam_share", 0.603F, 0, 1,
        "times exp(-density / jam_decline): share of the free speed that is left in a jam"},
       {"jam_decline", 2.4F, 0.1F, 100, "density over which that falls to 1/e, per m^2"},
       {"perception", 0.41F, 0.01F, 100, "over which density is averaged, in s"},
       {"foresight", 0.357F, 0, 10, "how far ahead people know where others will be, in s"},
       {"alongside", 0.777F, 0, 1, "share of the avoidance of those who walk the same way"},
       {"caution", 0.102F, 0, 1, "share of the free speed that is lost among oncoming people"},
       {"caution_density", 0.0292F, 1e-3F, 100, "density over which that comes about, per m^2"},
       {"keep_right", 1.0F, 0, 100,
        "how far one turns right from those who come towards one, in rad m^2"},
       {"spread", 1.1F, 0, 100, "how far one turns to the side that is less crowded, in rad m^2"},
       {"max_spread", 0.473F, 0, 1, "how far one turns to that side at most, in rad"},
       {"clearance", 0.0935F, 0, 2,
        "distance that people who come towards each other keep when they pass, in m"},
       {"headway", 1.19F, 0.01F, 100, "time to the one ahead in single file, in s"},
       {"door_headway", 1.03F, 0, 100, "the same in doors where there is room for one only, in s"},
       {"turned_breadth", 0.618F, 0.4F, 1,
        "share of the radius of people who turn their shoulders since they get no further"},
       {"relief", 1.0F, 0, 1,
        "share of the density of people who walk the same way that does not count among oncoming "
        "people"}},
      make_ttc,
      {},
      true,
      embedded::kTtcPosterior,
      {{"half_density", 0.65F}, {"foresight", 0.2F}, {"door_headway", 2.0F}}};
}

}  // namespace throng::crowd
