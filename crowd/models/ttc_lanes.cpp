#include "crowd/models/ttc_lanes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/compute/simd.h"
#include "crowd/models/disc_lanes.h"
#include "crowd/models/oncoming.h"

namespace throng::crowd {

namespace {

/// Forces between discs are integrated with this step, whatever the simulation's step is.
constexpr float kStepS = 0.02F;
/// Collisions farther ahead in time are not seen; nearer ones count as if they were this near.
constexpr float kMaxHorizonS = 8;
constexpr float kMinTimeS = 0.02F;
constexpr float kMinRelativeSpeedSq = 1e-4F;  // m^2/s^2: relative velocities below never collide
constexpr float kBehind = 0.3F;               // weight of others who are not in view
constexpr float kView = -0.2F;                // cosine of the edge of the view
constexpr float kMaxForce = 15;               // m/s^2
constexpr float kSamePosition = 1e-3F;        // m: nearer than that two have no direction
constexpr float kContact = 100;               // 1/s^2: force per depth of an overlap
constexpr float kWall = 10;                   // m/s^2 at a wall
constexpr float kWallRangeM = 0.03F;          // over which that falls to 1/e
constexpr float kShuffleMps = 0.1F;  // forces make nobody faster than this or than they want to be
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
    : agents_(neighbors), rows_(neighbors), walls_(walls) {
  for (std::vector<Segment>& segments : segments_) segments.reserve(walls);
}

void TtcBatch::add(const View& view) {
  const std::size_t lane = agents_.add(view.slot, view.neighbors);
  if (rows_.size() < agents_.rows()) rows_.resize(agents_.rows());
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
  if (row >= walls_.size()) walls_.resize(row + 1);
  walls_[row].x[lane] = nearest.x();
  walls_[row].y[lane] = nearest.y();
  wall_count_[lane] += 1;
  wall_rows_ = std::max(wall_rows_, row + 1);
}

struct TtcKernel {
  /// Agents, one per lane, and the densities around them.
  template <int kWidth>
  struct Self {
    DiscLanes<FloatOf<kWidth>> disc;
    FloatOf<kWidth> direction_x;
    FloatOf<kWidth> direction_y;
    FloatOf<kWidth> count;      // number of neighbors
    FloatOf<kWidth> same;       // density of people who walk the same way, 1/m^2
    FloatOf<kWidth> others;     // density of those who do not
    FloatOf<kWidth> oncoming;   // density of oncoming people ahead
    FloatOf<kWidth> opposed;    // density of oncoming people around
    FloatOf<kWidth> clearance;  // kept to oncoming people, m
    FloatOf<kWidth> left;       // by how much it is more crowded on the left, 1/m^2
  };

  template <int kWidth>
  static void run(const TtcBatch::Setting& setting, TtcBatch& batch) {
    batch.agents_.fill();
    for (std::size_t first = 0; first < batch.agents_.size(); first += kWidth) {
      lanes<kWidth>(setting, first, batch);
    }
  }

  template <int kWidth>
  static void lanes(const TtcBatch::Setting& setting, std::size_t first, TtcBatch& batch) {
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
    integrate<kWidth>(setting, first, self, speed, batch);
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

  /// Fills the rows of the batch and computes densities.
  template <int kWidth>
  static Self<kWidth> look(const TtcBatch::Setting& setting, std::size_t first, TtcBatch& batch) {
    using Float = FloatOf<kWidth>;
    const LaneBatch& agents = batch.agents_;
    Self<kWidth> self;
    self.disc = discs_in<kWidth>(setting.grid, &agents.slots()[first]);
    Float walks;
    intents_in<kWidth>(setting, &agents.slots()[first], self.direction_x, self.direction_y, walks);
    self.count = load<kWidth>(&agents.neighbors()[first]);
    const Float reach_sq = load<kWidth>(&batch.reach_sq_[first]);
    Sums<kWidth> sums;
    for (std::size_t i = 0; i < agents.rows(); ++i) {
      const Other<kWidth> other = look_at<kWidth>(setting, first, i, self, agents);
      fill_row<kWidth>(setting.constants, first, self, other, batch.rows_[i]);
      count<kWidth>(setting.constants, self, other, reach_sq, sums);
    }
    find_densities<kWidth>(setting.constants, first, reach_sq, sums, batch, self);
    return self;
  }

  template <int kWidth>
  static Other<kWidth> look_at(const TtcBatch::Setting& setting, std::size_t first, std::size_t i,
                               const Self<kWidth>& self, const LaneBatch& agents) {
    const LaneBatch::Slots slots = agents.row(i);
    Other<kWidth> other;
    other.disc = discs_in<kWidth>(setting.grid, &slots[first]);
    FloatOf<kWidth> direction_x;
    FloatOf<kWidth> direction_y;
    intents_in<kWidth>(setting, &slots[first], direction_x, direction_y, other.walks);
    other.there = self.count > static_cast<float>(i);
    other.x = other.disc.x - self.disc.x;
    other.y = other.disc.y - self.disc.y;
    other.distance_sq = other.x * other.x + other.y * other.y;
    other.cosine = self.direction_x * direction_x + self.direction_y * direction_y;
    const auto together = other.there & (other.distance_sq < kSamePosition * kSamePosition);
    if (any(together)) {
      part<kWidth>(setting, &agents.slots()[first], &slots[first], together, other.x, other.y);
    }
    return other;
  }

  template <int kWidth>
  static void fill_row(const TtcConstants& c, std::size_t first, const Self<kWidth>& self,
                       const Other<kWidth>& other, TtcBatch::Row& row) {
    using Float = FloatOf<kWidth>;
    const Float alongside = clamped<Float>(2 * other.cosine - 1, 0, 1);
    store(other.x, &row.x[first]);
    store(other.y, &row.y[first]);
    store(other.disc.vx, &row.vx[first]);
    store(other.disc.vy, &row.vy[first]);
    store(self.disc.radius + other.disc.radius, &row.touch[first]);
    store((1 - other.cosine) / 2, &row.against[first]);
    store(1 - (1 - c.alongside_share) * alongside, &row.weight[first]);
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
    const Float against = greater((kOncoming - other.cosine) / (kOncoming + 1), Float{});
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

  /// The mean velocity of a step in which the others go on as they do, but answer what this agent
  /// does.
  template <int kWidth>
  static void integrate(const TtcBatch::Setting& setting, std::size_t first,
                        const Self<kWidth>& self, FloatOf<kWidth> speed, TtcBatch& batch) {
    using Float = FloatOf<kWidth>;
    const TtcConstants& c = setting.constants;
    // People spread to the less crowded side, and keep right of those who come towards them.
    const Float aside =
        clamped<Float>(c.spread_m2 * self.left / 2, -c.max_spread / 2, c.max_spread / 2);
    const Float t = smaller(c.keep_right_m2 * self.oncoming / 2 + aside, Float{} + kMaxHalfTurn);
    Float wish_x = self.direction_x;
    Float wish_y = self.direction_y;
    turn_right(t, wish_x, wish_y);
    wish_x *= speed;
    wish_y *= speed;
    const Float max_back = kStepBack * self.others;
    const int steps = std::max(1, static_cast<int>(std::lround(setting.dt_s / kStepS)));
    const float step_s = setting.dt_s / static_cast<float>(steps);
    Float vx = self.disc.vx;
    Float vy = self.disc.vy;
    Float moved_x{};
    Float moved_y{};
    for (int step = 0; step < steps; ++step) {
      const float time_s = step_s * static_cast<float>(step);
      Float force_x{};
      Float force_y{};
      forces<kWidth>(setting, first, self, {vx, vy, moved_x, moved_y, time_s}, batch, force_x,
                     force_y);
      const Float size = square_root<kWidth>(force_x * force_x + force_y * force_y);
      const Float cut = size > kMaxForce ? kMaxForce / size : Float{} + 1;
      const Float before = square_root<kWidth>(vx * vx + vy * vy);
      const Float limit = greater(greater(speed, Float{} + kShuffleMps), before);
      vx += step_s * ((wish_x - vx) / c.relaxation_s + cut * force_x);
      vy += step_s * ((wish_y - vy) / c.relaxation_s + cut * force_y);
      const Float now = square_root<kWidth>(vx * vx + vy * vy);
      const Float slower = now > limit ? limit / now : Float{} + 1;
      vx *= slower;
      vy *= slower;
      const Float backward = -(vx * self.direction_x + vy * self.direction_y);
      const Float excess = greater(backward - max_back, Float{});
      vx += excess * self.direction_x;
      vy += excess * self.direction_y;
      moved_x += step_s * vx;
      moved_y += step_s * vy;
    }
    store(moved_x / setting.dt_s, &batch.velocity_x_[first]);
    store(moved_y / setting.dt_s, &batch.velocity_y_[first]);
  }

  /// The state of a step that is being integrated.
  template <typename Float>
  struct Motion {
    Float vx;
    Float vy;
    Float moved_x;
    Float moved_y;
    float time_s;
  };

  template <int kWidth>
  static void forces(const TtcBatch::Setting& setting, std::size_t first, const Self<kWidth>& self,
                     const Motion<FloatOf<kWidth>>& motion, const TtcBatch& batch,
                     FloatOf<kWidth>& force_x, FloatOf<kWidth>& force_y) {
    using Float = FloatOf<kWidth>;
    const TtcConstants& c = setting.constants;
    // Both give way by as much: without that they would do twice what is needed, and swing.
    const Float own_x = motion.moved_x - motion.time_s * self.disc.vx;
    const Float own_y = motion.moved_y - motion.time_s * self.disc.vy;
    const Float change_x = motion.vx - self.disc.vx;
    const Float change_y = motion.vy - self.disc.vy;
    const Float care = load<kWidth>(&batch.care_[first]);
    for (std::size_t i = 0; i < batch.agents_.rows(); ++i) {
      const auto there = self.count > static_cast<float>(i);
      const TtcBatch::Row& row = batch.rows_[i];
      const Float other_vx = load<kWidth>(&row.vx[first]);
      const Float other_vy = load<kWidth>(&row.vy[first]);
      const Float touch = load<kWidth>(&row.touch[first]);
      const Float apart_x = motion.moved_x - load<kWidth>(&row.x[first]) - motion.time_s * other_vx;
      const Float apart_y = motion.moved_y - load<kWidth>(&row.y[first]) - motion.time_s * other_vy;
      const Float apart_sq = greater(apart_x * apart_x + apart_y * apart_y, Float{} + 1e-8F);
      const Float answer = 1 + (own_x * apart_x + own_y * apart_y) / apart_sq;
      const Float x = answer * apart_x;
      const Float y = answer * apart_y;
      const Float distance_sq = greater(x * x + y * y, Float{} + 1e-8F);
      const Float distance = square_root<kWidth>(distance_sq);
      const Float away_x = x / distance;
      const Float away_y = y / distance;
      const Float together = away_x * change_x + away_y * change_y;
      const Float rx = motion.vx - other_vx + together * away_x;
      const Float ry = motion.vy - other_vy + together * away_y;
      const Float overlap = greater(touch - distance, Float{});
      Float push = kContact * overlap;
      // Discs that touch already avoid coming nearer.
      constexpr float kNotYet = 0.98F;
      const Float kept = touch + self.clearance * load<kWidth>(&row.against[first]);
      const Float radius = smaller(kept, kNotYet * distance);
      const Float a = rx * rx + ry * ry;
      const Float b = -(x * rx + y * ry);
      const Float discriminant = b * b - a * (distance_sq - radius * radius);
      const auto meets = there & (a > kMinRelativeSpeedSq) & (b > 0) & (discriminant > 0);
      push = there ? push : Float{};
      force_x += push * away_x;
      force_y += push * away_y;
      if (!any(meets)) continue;
      const Float root = square_root<kWidth>(greater(discriminant, Float{}));
      const Float some = meets ? a : Float{} + 1;
      const Float time = greater((b - root) / some, Float{} + kMinTimeS);
      const auto soon = meets & (time < kMaxHorizonS);
      if (!any(soon)) continue;
      const Float slope = c.strength_m2 * exponential(-time / c.horizon_s) / (time * time) *
                          (2 / time + 1 / c.horizon_s);
      // Discs that would just graze each other have a gradient without limit.
      constexpr float kGrazing = 0.1F;
      const Float smooth = greater(root, kGrazing * square_root<kWidth>(some));
      const auto unseen = self.direction_x * away_x + self.direction_y * away_y > -kView;
      const Float weight =
          care * load<kWidth>(&row.weight[first]) * (unseen ? Float{} + kBehind : Float{} + 1);
      const Float scale = soon ? weight * slope / some : Float{};
      force_x += scale * ((b * rx + a * x) / smooth - rx);
      force_y += scale * ((b * ry + a * y) / smooth - ry);
    }
    const Float walls = load<kWidth>(&batch.wall_count_[first]);
    for (std::size_t i = 0; i < batch.wall_rows_; ++i) {
      const Float x = motion.moved_x - load<kWidth>(&batch.walls_[i].x[first]);
      const Float y = motion.moved_y - load<kWidth>(&batch.walls_[i].y[first]);
      const Float distance = greater(square_root<kWidth>(x * x + y * y), Float{} + 1e-4F);
      const Float push =
          kWall * exponential((self.disc.radius - distance) / kWallRangeM) / distance;
      const auto there = walls > static_cast<float>(i);
      force_x += there ? push * x : Float{};
      force_y += there ? push * y : Float{};
    }
  }
};

TtcBatch::Solve* TtcBatch::pick(InstructionSet set) {
  return Versions<TtcKernel, void(const Setting&, TtcBatch&)>::pick(set);
}

}  // namespace throng::crowd
