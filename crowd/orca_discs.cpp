// Half-planes that keep discs clear of discs. One disc and many are the same computation, lane by
// lane; what would be a branch is computed on both sides.
#include <array>
#include <cmath>

#include "base/simd.h"
#include "crowd/orca_lines.h"

namespace throng::crowd {

namespace {

/// What one disc sees of others.
template <typename Float>
struct Others {
  Float x;  ///< positions, m
  Float y;
  Float vx;  ///< velocities, m/s
  Float vy;
  Float radius;
};

template <typename Float>
struct Planes {
  Float point_x;
  Float point_y;
  Float direction_x;
  Float direction_y;
};

struct Rates {
  float cutoff = 0;   ///< 1 / horizon, 1/s
  float contact = 0;  ///< 1 / time step
};

/// `root` is the square root of a Float.
template <typename Float, typename Root>
Planes<Float> avoid(const Disc& self, const Others<Float>& others, const Rates& rates,
                    const Root& root) {
  const Float zero{};
  const Float apart_x = others.x - self.position.x();
  const Float apart_y = others.y - self.position.y();
  const Float relative_x = self.velocity.x() - others.vx;
  const Float relative_y = self.velocity.y() - others.vy;
  const Float distance_sq = apart_x * apart_x + apart_y * apart_y;
  const Float radius = others.radius + self.radius;
  const Float radius_sq = radius * radius;
  const auto overlapping = distance_sq <= radius_sq;
  const Float rate = overlapping ? zero + rates.contact : zero + rates.cutoff;

  // Of the velocity obstacle, a disc at the horizon and the cone behind it, which is nearer?
  const Float w_x = relative_x - rate * apart_x;
  const Float w_y = relative_y - rate * apart_y;
  const Float w_sq = w_x * w_x + w_y * w_y;
  const Float ahead = w_x * apart_x + w_y * apart_y;
  const auto round = overlapping | ((ahead < 0) & (ahead * ahead > radius_sq * w_sq));
  // One root and one division serve both.
  const Float leg_sq = distance_sq > radius_sq ? distance_sq - radius_sq : zero;
  const Float length = root(round ? w_sq : leg_sq);
  const Float inverse = 1 / (round ? length : distance_sq);

  // The disc: out along w, or along x when w is 0.
  const auto any = length > 0;
  const Float outward_x = any ? w_x * inverse : zero + 1;
  const Float outward_y = any ? w_y * inverse : zero;
  const Float out = radius * rate - length;
  // The cone: the left or the right tangent, away from the other side.
  const auto left = apart_x * w_y - apart_y * w_x > 0;
  const Float along = (left ? length : -length) * inverse;
  const Float across = radius * inverse;
  const Float leg_x = along * apart_x - across * apart_y;
  const Float leg_y = along * apart_y + across * apart_x;
  const Float projected = relative_x * leg_x + relative_y * leg_y;

  Planes<Float> planes;
  planes.direction_x = round ? outward_y : leg_x;
  planes.direction_y = round ? -outward_x : leg_y;
  const Float change_x = round ? out * outward_x : projected * leg_x - relative_x;
  const Float change_y = round ? out * outward_y : projected * leg_y - relative_y;
  planes.point_x = self.velocity.x() + 0.5F * change_x;
  planes.point_y = self.velocity.y() + 0.5F * change_y;
  return planes;
}

Disc disc_of(const Grid& grid, std::size_t slot) {
  return {grid.position(slot), grid.velocity(slot), grid.radius(slot)};
}

constexpr float kNudge = 1e-3F;  // m

struct AvoidDiscsKernel {
  template <int kWidth>
  static void run(const Grid& grid, std::size_t self, std::span<const Grid::Neighbor> others,
                  float horizon_s, float dt_s, HalfPlanes& planes) {
    const std::size_t first = planes.size();
    planes.resize(first + others.size());
    const Disc me = disc_of(grid, self);
    const Rates rates{1 / horizon_s, 1 / dt_s};
    for (std::size_t at = 0; at < others.size(); at += kWidth) {
      auto seen = gather<kWidth>(grid, others.subspan(at));
      if (others[at].distance_sq == 0) nudge<kWidth>(grid, self, others.subspan(at), seen);
      const auto made = avoid(me, seen, rates, square_root<kWidth>);
      store(made.point_x, &planes.point_x[first + at]);
      store(made.point_y, &planes.point_y[first + at]);
      store(made.direction_x, &planes.direction_x[first + at]);
      store(made.direction_y, &planes.direction_y[first + at]);
    }
  }

  /// The first kWidth of them; when there are fewer, the last one again.
  template <int kWidth>
  static Others<typename Vectors<kWidth>::Float> gather(const Grid& grid,
                                                        std::span<const Grid::Neighbor> others) {
    Others<typename Vectors<kWidth>::Float> seen;
    std::array<Float4, kWidth> bodies;
    for (int i = 0; i < kWidth; ++i) {
      const std::size_t slot =
          others[std::min(static_cast<std::size_t>(i), others.size() - 1)].slot;
      bodies[static_cast<std::size_t>(i)] = load<4>(grid.body(slot).position.data());
      seen.radius[i] = grid.radius(slot);
    }
    transpose(bodies, seen.x, seen.y, seen.vx, seen.vy);
    return seen;
  }

  template <int kWidth>
  static void nudge(const Grid& grid, std::size_t self, std::span<const Grid::Neighbor> others,
                    Others<typename Vectors<kWidth>::Float>& seen) {
    for (int i = 0; i < kWidth && static_cast<std::size_t>(i) < others.size(); ++i) {
      const Grid::Neighbor& other = others[static_cast<std::size_t>(i)];
      if (other.distance_sq != 0) return;
      seen.x[i] += grid.id(other.slot) > grid.id(self) ? kNudge : -kNudge;
    }
  }
};

}  // namespace

HalfPlane avoid_disc(const Disc& self, const Disc& other, float horizon_s, float dt_s) {
  const Others<float> others{other.position.x(), other.position.y(), other.velocity.x(),
                             other.velocity.y(), other.radius};
  const auto root = [](float value) { return std::sqrt(value); };
  const Planes<float> made = avoid(self, others, {1 / horizon_s, 1 / dt_s}, root);
  return {{made.point_x, made.point_y}, {made.direction_x, made.direction_y}};
}

AvoidDiscs* avoid_discs(InstructionSet set) {
  return Versions<AvoidDiscsKernel, AvoidDiscs>::pick(set);
}

}  // namespace throng::crowd
