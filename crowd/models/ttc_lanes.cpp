#include "crowd/models/ttc_lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "base/compute/simd.h"
#include "crowd/models/disc_lanes.h"
#include "crowd/models/oncoming.h"
#include "crowd/models/ttc_motion.h"

namespace throng::crowd {

namespace {

constexpr float kSamePosition = 1e-3F;  // m: nearer than that two have no direction
/// Two who are nearer than this times the step may touch within it.
constexpr float kApproachMps = 1.5F;
/// How fast one steps back at most, per person and m^2 of those who do not walk the same way.
constexpr float kStepBack = 4;     // m^3/s
constexpr float kDense = 0.6F;     // 1/m^2: nobody keeps a distance to oncoming people
constexpr float kMinFree = 0.45F;  // of the kernel of the density is never taken for walls
/// Density of oncoming people (1/m^2) at which that of people who walk the same way counts less.
constexpr float kReliefDensity = 0.03F;

template <int kWidth>
using FloatOf = typename Vectors<kWidth>::Float;

template <typename Float>
Float clamped(Float v, float low, float high) {
  return smaller(greater(v, Float{} + low), Float{} + high);
}

}  // namespace

TtcBatch::TtcBatch(std::size_t neighbors, std::size_t walls)
    : agents_(neighbors),
      rows_(neighbors),
      walls_(walls),
      busy_rows_(neighbors),
      busy_walls_(walls) {
  for (std::vector<Segment>& segments : segments_) segments.reserve(walls);
}

void TtcBatch::add(const View& view) {
  const std::size_t lane = agents_.add(view.slot, view.neighbors);
  if (rows_.size() < agents_.rows()) {
    rows_.resize(agents_.rows());
    busy_rows_.resize(agents_.rows());
  }
  segments_[lane].clear();
  wall_count_[lane] = 0;
  reach_sq_[lane] = view.reach_sq_m2;
  free_mps_[lane] = view.free_mps;
  max_mps_[lane] = view.max_mps;
  max_share_[lane] = view.max_share;
  enclosure_[lane] = view.enclosure;
  care_[lane] = view.care;
  perceived_[lane] = view.perceived_per_m2;
}

void TtcBatch::add_wall(const Eigen::Vector2f& begin, const Eigen::Vector2f& end,
                        const Eigen::Vector2f& nearest, bool pushes) {
  const std::size_t lane = agents_.size() - 1;
  segments_[lane].push_back({begin, end - begin});
  if (!pushes) return;
  const auto row = static_cast<std::size_t>(wall_count_[lane]);
  if (row >= walls_.size()) {
    walls_.resize(row + 1);
    busy_walls_.resize(row + 1);
  }
  walls_[row].x[lane] = nearest.x();
  walls_[row].y[lane] = nearest.y();
  wall_count_[lane] += 1;
}

struct TtcKernel {
  /// Agents, one per lane, and the densities around them.
  template <int kWidth>
  struct Self {
    DiscLanes<FloatOf<kWidth>> disc;
    FloatOf<kWidth> direction_x;
    FloatOf<kWidth> direction_y;
    FloatOf<kWidth> count;                    // number of neighbors
    std::array<std::int32_t, kWidth> kept{};  // number of those that may act on it in the step
    FloatOf<kWidth> same;                     // density of people who walk the same way, 1/m^2
    FloatOf<kWidth> others;                   // density of those who do not
    FloatOf<kWidth> oncoming;                 // density of oncoming people ahead
    FloatOf<kWidth> opposed;                  // density of oncoming people around
    FloatOf<kWidth> clearance;                // kept to oncoming people, m
    FloatOf<kWidth> left;                     // by how much it is more crowded on the left, 1/m^2
  };

  /// Busy agents of a batch, who are integrated together once all lanes are taken.
  template <int kWidth>
  struct Queue {
    typename TtcMotion<kWidth>::Movers movers{};
    std::array<std::size_t, kWidth> lanes{};  // of the batch
    std::size_t count = 0;
  };

  template <int kWidth>
  static void run(const TtcBatch::Setting& setting, TtcBatch& batch) {
    batch.agents_.fill();
    const typename TtcMotion<kWidth>::Steps steps(setting.dt_s, setting.constants.relaxation_s);
    Queue<kWidth> queue;
    for (std::size_t first = 0; first < batch.agents_.size(); first += kWidth) {
      auto movers = lanes<kWidth>(setting, first, batch);
      const auto busy = TtcMotion<kWidth>::begin(
          setting.constants, steps, {batch.rows_.data(), batch.walls_.data(), first}, movers);
      store(movers.moved_x / setting.dt_s, &batch.velocity_x_[first]);
      store(movers.moved_y / setting.dt_s, &batch.velocity_y_[first]);
      for (unsigned which = movemask(busy); which != 0; which &= which - 1) {
        enqueue<kWidth>(movers, first, static_cast<std::size_t>(std::countr_zero(which)), batch,
                        queue);
        if (queue.count == kWidth) finish<kWidth>(setting, steps, batch, queue);
      }
    }
    finish<kWidth>(setting, steps, batch, queue);
  }

  template <int kWidth>
  static void enqueue(const typename TtcMotion<kWidth>::Movers& movers, std::size_t first,
                      std::size_t lane, TtcBatch& batch, Queue<kWidth>& queue) {
    const std::size_t from = first + lane;
    const std::size_t to = queue.count++;
    queue.lanes[to] = from;
    TtcMotion<kWidth>::copy_lane(movers, lane, queue.movers, to);
    for (std::size_t i = 0; i < static_cast<std::size_t>(movers.others[lane]); ++i) {
      copy_row(batch.rows_[i], from, batch.busy_rows_[i], to);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(movers.walls[lane]); ++i) {
      batch.busy_walls_[i].x[to] = batch.walls_[i].x[from];
      batch.busy_walls_[i].y[to] = batch.walls_[i].y[from];
    }
  }

  static void copy_row(const TtcBatch::Row& row, std::size_t from, TtcBatch::Row& copy,
                       std::size_t to) {
    copy.x[to] = row.x[from];
    copy.y[to] = row.y[from];
    copy.vx[to] = row.vx[from];
    copy.vy[to] = row.vy[from];
    copy.touch[to] = row.touch[from];
    copy.against[to] = row.against[from];
    copy.weight[to] = row.weight[from];
  }

  template <int kWidth>
  static void finish(const TtcBatch::Setting& setting,
                     const typename TtcMotion<kWidth>::Steps& steps, TtcBatch& batch,
                     Queue<kWidth>& queue) {
    if (queue.count == 0) return;
    for (std::size_t lane = queue.count; lane < kWidth; ++lane) {
      queue.movers.others[lane] = queue.movers.walls[lane] = 0;
    }
    TtcMotion<kWidth>::finish(setting.constants, steps,
                              {batch.busy_rows_.data(), batch.busy_walls_.data(), 0}, queue.movers);
    for (std::size_t lane = 0; lane < queue.count; ++lane) {
      batch.velocity_x_[queue.lanes[lane]] = queue.movers.moved_x[lane] / setting.dt_s;
      batch.velocity_y_[queue.lanes[lane]] = queue.movers.moved_y[lane] / setting.dt_s;
    }
    queue.count = 0;
  }

  /// The motion that a group of agents begins with, by all that they see.
  template <int kWidth>
  static typename TtcMotion<kWidth>::Movers lanes(const TtcBatch::Setting& setting,
                                                  std::size_t first, TtcBatch& batch) {
    using Float = FloatOf<kWidth>;
    const TtcConstants& c = setting.constants;
    Self<kWidth> self = look<kWidth>(setting, first, batch);
    const Float perceived = load<kWidth>(&batch.perceived_[first]);
    const Float now =
        perceived + std::min(1.0F, setting.dt_s / c.perception_s) * (self.same - perceived);
    store(now, &batch.perceived_[first]);
    const Float free_mps = load<kWidth>(&batch.free_mps_[first]);
    Float share = smaller(speed_share<kWidth>(c, now), load<kWidth>(&batch.max_share_[first]));
    // Nobody hurries where people come towards them.
    share =
        smaller(share, 1 - c.caution * (1 - exponential(-self.opposed / c.caution_density_per_m2)));
    const Float speed = smaller(load<kWidth>(&batch.max_mps_[first]), share * free_mps);
    store(speed, &batch.wished_mps_[first]);
    // People spread to the less crowded side, and keep right of those who come towards them.
    const Float aside =
        clamped<Float>(c.spread_m2 * self.left / 2, -c.max_spread / 2, c.max_spread / 2);
    const Float t = smaller(c.keep_right_m2 * self.oncoming / 2 + aside, Float{} + kMaxHalfTurn);
    Float wish_x = self.direction_x;
    Float wish_y = self.direction_y;
    turn_right(t, wish_x, wish_y);
    return {.before_vx = self.disc.vx,
            .before_vy = self.disc.vy,
            .radius = self.disc.radius,
            .direction_x = self.direction_x,
            .direction_y = self.direction_y,
            .wish_x = speed * wish_x,
            .wish_y = speed * wish_y,
            .speed = speed,
            .max_back = kStepBack * self.others,
            .clearance = self.clearance,
            .care = load<kWidth>(&batch.care_[first]),
            .vx = self.disc.vx,
            .vy = self.disc.vy,
            .moved_x = Float{},
            .moved_y = Float{},
            .others = load<kWidth>(self.kept.data()),
            .walls = load<kWidth>(&batch.wall_count_[first])};
  }

  /// The share of the free speed at a density of people who walk in the same direction: a logistic
  /// curve, and what is left in a jam.
  template <int kWidth>
  static FloatOf<kWidth> speed_share(const TtcConstants& c, FloatOf<kWidth> density) {
    using Float = FloatOf<kWidth>;
    const float alone = 1 + exponential(-c.steepness_m2 * c.half_density_per_m2);
    const Float fall =
        alone / (1 + exponential(c.steepness_m2 * (density - c.half_density_per_m2)));
    const Float jam = c.jam_share * exponential(-density / c.jam_decline_per_m2);
    return greater(fall, jam);
  }

  /// A neighbor of each agent.
  template <int kWidth>
  struct Other {
    DiscLanes<FloatOf<kWidth>> disc;
    FloatOf<kWidth> x;  // offset from the agent, m
    FloatOf<kWidth> y;
    FloatOf<kWidth> distance_sq;  // m^2
    FloatOf<kWidth> cosine;       // between the directions of both
    FloatOf<kWidth> walks;        // 1: wants to go; 0: stands
    typename Vectors<kWidth>::Int there;
  };

  /// Sums over the neighbors, weighted by the kernel of the density.
  template <int kWidth>
  struct Sums {
    FloatOf<kWidth> near{};  // without the direction
    FloatOf<kWidth> all{};
    FloatOf<kWidth> same{};
    FloatOf<kWidth> left{};
    FloatOf<kWidth> oncoming{};
    FloatOf<kWidth> opposed{};
  };

  /// Computes densities, and fills the rows of the batch.
  template <int kWidth>
  static Self<kWidth> look(const TtcBatch::Setting& setting, std::size_t first, TtcBatch& batch) {
    using Float = FloatOf<kWidth>;
    const LaneBatch& agents = batch.agents_;
    Self<kWidth> self;
    self.disc = discs_in<kWidth>(setting.grid, &agents.slots()[first]);
    Float walks;
    intents_in<kWidth>(setting, &agents.slots()[first], self.direction_x, self.direction_y, walks);
    self.count = load<kWidth>(&agents.neighbors()[first]);
    const Float free_mps = load<kWidth>(&batch.free_mps_[first]);
    const Float reach_sq = load<kWidth>(&batch.reach_sq_[first]);
    Sums<kWidth> sums;
    for (std::size_t i = 0; i < agents.rows(); ++i) {
      const Other<kWidth> other = look_at<kWidth>(setting, first, i, self, agents);
      const auto acts = may_act<kWidth>(setting, self, other, free_mps);
      if (any(acts)) keep<kWidth>(setting.constants, first, other, acts, batch, self);
      count<kWidth>(setting.constants, self, other, reach_sq, sums);
    }
    find_densities<kWidth>(setting.constants, first, reach_sq, sums, batch, self);
    return self;
  }

  template <int kWidth>
  static Other<kWidth> look_at(const TtcBatch::Setting& setting, std::size_t first, std::size_t i,
                               const Self<kWidth>& self, const LaneBatch& agents) {
    const auto slots = agents.row<kWidth>(i, first);
    Other<kWidth> other;
    other.disc = discs_in<kWidth>(setting.grid, slots.data());
    FloatOf<kWidth> direction_x;
    FloatOf<kWidth> direction_y;
    intents_in<kWidth>(setting, slots.data(), direction_x, direction_y, other.walks);
    other.there = self.count > static_cast<float>(i);
    other.x = other.disc.x - self.disc.x;
    other.y = other.disc.y - self.disc.y;
    other.distance_sq = other.x * other.x + other.y * other.y;
    other.cosine = self.direction_x * direction_x + self.direction_y * direction_y;
    const auto together = other.there & (other.distance_sq < kSamePosition * kSamePosition);
    if (any(together)) {
      part<kWidth>(setting, &agents.slots()[first], slots.data(), together, other.x, other.y);
    }
    return other;
  }

  /// Whether there can be a force between the two within the step: they are close, or on courses
  /// on which they meet as they walk now, or as the agent would like to.
  template <int kWidth>
  static typename Vectors<kWidth>::Int may_act(const TtcBatch::Setting& setting,
                                               const Self<kWidth>& self, const Other<kWidth>& other,
                                               FloatOf<kWidth> free_mps) {
    using Float = FloatOf<kWidth>;
    const Float touch = self.disc.radius + other.disc.radius;
    const Float close = touch + kApproachMps * setting.dt_s;
    const Float apart = touch + setting.constants.clearance_m;
    const Float gap_sq = other.distance_sq - apart * apart;
    const auto meet = [&](Float vx, Float vy) {
      const Float rx = vx - other.disc.vx;
      const Float ry = vy - other.disc.vy;
      const Float closing = other.x * rx + other.y * ry;
      return (closing > 0) & (closing * closing > (rx * rx + ry * ry) * gap_sq);
    };
    return other.there & ((other.distance_sq < close * close) | meet(self.disc.vx, self.disc.vy) |
                          meet(free_mps * self.direction_x, free_mps * self.direction_y));
  }

  /// Stores the neighbors of those lanes that they may act on, each in its lane's next row.
  template <int kWidth>
  static void keep(const TtcConstants& c, std::size_t first, const Other<kWidth>& other,
                   typename Vectors<kWidth>::Int acts, TtcBatch& batch, Self<kWidth>& self) {
    using Float = FloatOf<kWidth>;
    const Float alongside = clamped<Float>(2 * other.cosine - 1, 0, 1);
    TtcBatch::Row all;
    store(other.x, &all.x[0]);
    store(other.y, &all.y[0]);
    store(other.disc.vx, &all.vx[0]);
    store(other.disc.vy, &all.vy[0]);
    store(self.disc.radius + other.disc.radius, &all.touch[0]);
    store((1 - other.cosine) / 2, &all.against[0]);
    store(1 - (1 - c.alongside_share) * alongside, &all.weight[0]);
    for (unsigned which = movemask(acts); which != 0; which &= which - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(which));
      TtcBatch::Row& kept = batch.rows_[static_cast<std::size_t>(self.kept[lane]++)];
      const std::size_t to = first + lane;
      kept.x[to] = all.x[lane];
      kept.y[to] = all.y[lane];
      kept.vx[to] = all.vx[lane];
      kept.vy[to] = all.vy[lane];
      kept.touch[to] = all.touch[lane];
      kept.against[to] = all.against[lane];
      kept.weight[to] = all.weight[lane];
    }
  }

  template <int kWidth>
  static void count(const TtcConstants& c, const Self<kWidth>& self, const Other<kWidth>& other,
                    FloatOf<kWidth> reach_sq, Sums<kWidth>& sums) {
    using Float = FloatOf<kWidth>;
    const Float tiny = Float{} + 1e-12F;
    // The expected place of the other; those who come towards the agent are gone by then.
    const Float with = (1 + other.cosine) / 2;
    const Float foresight = c.foresight_s * with;
    const Float soon_x = other.x + foresight * (other.disc.vx - self.disc.vx);
    const Float soon_y = other.y + foresight * (other.disc.vy - self.disc.vy);
    const Float soon_sq = soon_x * soon_x + soon_y * soon_y;
    const Float near = other.there & (soon_sq < reach_sq) ? reach_sq - soon_sq : Float{};
    const Float inverse = 1 / square_root<kWidth>(greater(soon_sq, tiny));
    const Float along = (self.direction_x * soon_x + self.direction_y * soon_y) * inverse;
    const Float aside = (self.direction_x * soon_y - self.direction_y * soon_x) * inverse;
    const Float lobe = greater((1 + along) / 2, Float{});
    const Float weight = near * lobe * lobe;
    // People who stand do not walk the same way.
    const Float counts = weight * with * other.walks;
    sums.near += near;
    sums.all += weight;
    sums.same += counts;
    sums.left += counts * aside;
    const Float against = greater((1 / (kOncoming + 1)) * (kOncoming - other.cosine), Float{});
    const Float around =
        other.there & (other.distance_sq < reach_sq) ? reach_sq - other.distance_sq : Float{};
    sums.opposed += around * against * other.walks;
    const Float ahead = greater((self.direction_x * other.x + self.direction_y * other.y) /
                                    square_root<kWidth>(greater(other.distance_sq, tiny)),
                                Float{});
    sums.oncoming += around * against * ahead;
  }

  template <int kWidth>
  static void find_densities(const TtcConstants& c, std::size_t first, FloatOf<kWidth> reach_sq,
                             const Sums<kWidth>& sums, const TtcBatch& batch, Self<kWidth>& self) {
    using Float = FloatOf<kWidth>;
    constexpr float kPi = std::numbers::pi_v<float>;
    const Float square = reach_sq * reach_sq;
    // The kernel (1 - d²/R²) ((1 + cos) / 2)² has the mean 3/8 of its isotropic part.
    const Float open_unit = (16 / (3 * kPi)) / square;
    Float free_left{};
    const Float unit = open_unit / free_shares<kWidth>(first, self, reach_sq, batch, free_left);
    self.same = sums.same * unit;
    self.left = sums.left * open_unit - self.same * free_left;
    self.others = greater(sums.all * unit - self.same, Float{});
    // Nobody keeps a distance in a dense crowd.
    const Float around = sums.near * (2 / kPi) / square;
    self.clearance = c.clearance_m * greater(1 - around / kDense, Float{});
    self.oncoming = sums.oncoming * 2 / square;
    self.opposed = sums.opposed * (2 / kPi) / square;
    // Among oncoming people gaps open and close: flow does not fall with density, as it does where
    // everybody walks the same way (Zhang et al. 2012, J. Stat. Mech. P02002).
    self.same *= 1 - c.relief * (1 - exponential(-self.opposed / kReliefDensity));
  }

  template <int kWidth>
  static void intents_in(const TtcBatch::Setting& setting, const std::uint32_t* slots,
                         FloatOf<kWidth>& x, FloatOf<kWidth>& y, FloatOf<kWidth>& walks) {
    std::array<Float4, kWidth> intents;
    for (std::size_t i = 0; i < kWidth; ++i) {
      intents[i] = load<4>(setting.intents[slots[i]].direction.data());
    }
    FloatOf<kWidth> unused;
    transpose(intents, x, y, walks, unused);
  }

  /// Two in one place part along x, the one with the higher id to the right.
  template <int kWidth>
  static void part(const TtcBatch::Setting& setting, const std::uint32_t* self,
                   const std::uint32_t* other, typename Vectors<kWidth>::Int together,
                   FloatOf<kWidth>& x, FloatOf<kWidth>& y) {
    for (int i = 0; i < kWidth; ++i) {
      if (together[i] == 0) continue;
      x[i] = setting.grid.id(self[i]) > setting.grid.id(other[i]) ? -kSamePosition : kSamePosition;
      y[i] = 0;
    }
  }

  /// The shares of the kernel of the density that walls leave free.
  template <int kWidth>
  static FloatOf<kWidth> free_shares(std::size_t first, const Self<kWidth>& self,
                                     FloatOf<kWidth> reach_sq, const TtcBatch& batch,
                                     FloatOf<kWidth>& free_left) {
    FloatOf<kWidth> shares{};
    for (int i = 0; i < kWidth; ++i) {
      const auto& segments = batch.segments_[first + static_cast<std::size_t>(i)];
      shares[i] = 1;
      if (first + static_cast<std::size_t>(i) >= batch.agents_.size() || segments.empty()) continue;
      const FreeGround free = free_ground<kWidth>(segments, self.direction_x[i],
                                                  self.direction_y[i], std::sqrt(reach_sq[i]));
      const float enclosure = batch.enclosure_[first + static_cast<std::size_t>(i)];
      shares[i] = std::max(kMinFree, 1 - enclosure * (1 - free.share));
      free_left[i] = free.left;
    }
    return shares;
  }

  /// The share of the kernel that walls leave free, and its moment to the left.
  struct FreeGround {
    float share = 0;
    float left = 0;
  };

  /// Integrates the kernel along 16 rays, each up to the nearest wall.
  template <int kWidth>
  static FreeGround free_ground(const std::vector<TtcBatch::Segment>& segments, float direction_x,
                                float direction_y, float reach_m) {
    using Float = FloatOf<kWidth>;
    constexpr int kRays = 16;
    std::array<float, kRays> parts{};
    for (int first = 0; first < kRays; first += kWidth) {
      const Float cosine = load<kWidth>(&kRayCosine[static_cast<std::size_t>(first)]);
      const Float sine = load<kWidth>(&kRaySine[static_cast<std::size_t>(first)]);
      const Float dx = cosine * direction_x - sine * direction_y;
      const Float dy = sine * direction_x + cosine * direction_y;
      Float nearest = Float{} + 1;
      for (const TtcBatch::Segment& wall : segments) {
        const Float det = dx * wall.edge.y() - dy * wall.edge.x();
        const Float inverse = 1 / (det * det < 1e-18F ? Float{} + 1e-9F : det);
        const float along = wall.begin.x() * wall.edge.y() - wall.begin.y() * wall.edge.x();
        const Float t = along * inverse / reach_m;
        const Float w = (wall.begin.x() * dy - wall.begin.y() * dx) * inverse;
        nearest = (t >= 0) & (w >= 0) & (w <= 1) & (t < nearest) ? t : nearest;
      }
      const Float square = nearest * nearest;
      store(load<kWidth>(&kRayWeight[static_cast<std::size_t>(first)]) * square * (2 - square),
            &parts[static_cast<std::size_t>(first)]);
    }
    FreeGround free;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      free.share += parts[i];
      free.left += parts[i] * kRaySine[i];
    }
    return free;
  }

  static constexpr std::array<float, 16> kRayCosine = {
      0.98078528F,  0.83146961F,  0.55557023F,  0.19509032F,  -0.19509032F, -0.55557023F,
      -0.83146961F, -0.98078528F, -0.98078528F, -0.83146961F, -0.55557023F, -0.19509032F,
      0.19509032F,  0.55557023F,  0.83146961F,  0.98078528F};
  static constexpr std::array<float, 16> kRaySine = {
      0.19509032F,  0.55557023F,  0.83146961F,  0.98078528F,  0.98078528F,  0.83146961F,
      0.55557023F,  0.19509032F,  -0.19509032F, -0.55557023F, -0.83146961F, -0.98078528F,
      -0.98078528F, -0.83146961F, -0.55557023F, -0.19509032F};
  /// ((1 + cos) / 2)², with a sum of 1.
  static constexpr std::array<float, 16> kRayWeight = [] {
    std::array<float, 16> weights{};
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const float lobe = (1 + kRayCosine[i]) / 2;
      weights[i] = lobe * lobe / 6;
    }
    return weights;
  }();
};

TtcBatch::Solve* TtcBatch::pick(InstructionSet set) {
  return Versions<TtcKernel, void(const Setting&, TtcBatch&)>::pick(set);
}

}  // namespace throng::crowd
