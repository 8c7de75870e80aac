#include <array>

#include "crowd/models/disc_lanes.h"
#include "crowd/models/orca_lines.h"

namespace throng::crowd {

namespace {

struct AvoidDiscsKernel {
  template <int kWidth>
  using Float = typename Vectors<kWidth>::Float;

  template <int kWidth>
  static void run(const Grid& grid, std::size_t self, std::span<const Grid::Neighbor> others,
                  float horizon_s, float dt_s, HalfPlanes& planes) {
    const std::size_t first = planes.size();
    planes.resize(first + others.size());
    const Grid::Body& body = grid.body(self);
    const DiscLanes<Float<kWidth>> me{
        broadcast<kWidth>(body.position.x()), broadcast<kWidth>(body.position.y()),
        broadcast<kWidth>(body.velocity.x()), broadcast<kWidth>(body.velocity.y()),
        broadcast<kWidth>(grid.radius(self))};
    for (std::size_t at = 0; at < others.size(); at += kWidth) {
      auto seen = gather<kWidth>(grid, others.subspan(at));
      if (others[at].distance_sq == 0) nudge<kWidth>(grid, self, others.subspan(at), seen);
      const auto made = avoid_disc_lanes<Float<kWidth>>(me, seen, broadcast<kWidth>(1 / horizon_s),
                                                        broadcast<kWidth>(1 / dt_s));
      store(made.point_x, &planes.point_x[first + at]);
      store(made.point_y, &planes.point_y[first + at]);
      store(made.direction_x, &planes.direction_x[first + at]);
      store(made.direction_y, &planes.direction_y[first + at]);
    }
  }

  /// The first kWidth of them; when there are fewer, the last one again.
  template <int kWidth>
  static DiscLanes<Float<kWidth>> gather(const Grid& grid, std::span<const Grid::Neighbor> others) {
    DiscLanes<Float<kWidth>> seen;
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
                    DiscLanes<Float<kWidth>>& seen) {
    for (int i = 0; i < kWidth && static_cast<std::size_t>(i) < others.size(); ++i) {
      const Grid::Neighbor& other = others[static_cast<std::size_t>(i)];
      if (other.distance_sq != 0) return;
      seen.x[i] += grid.id(other.slot) > grid.id(self) ? kOrcaNudge : -kOrcaNudge;
    }
  }
};

}  // namespace

HalfPlane avoid_disc(const Disc& self, const Disc& other, float horizon_s, float dt_s) {
  const auto lanes = [](const Disc& disc) {
    return DiscLanes<float>{disc.position.x(), disc.position.y(), disc.velocity.x(),
                            disc.velocity.y(), disc.radius};
  };
  const auto made = avoid_disc_lanes<float>(lanes(self), lanes(other), 1 / horizon_s, 1 / dt_s);
  return {{made.point_x, made.point_y}, {made.direction_x, made.direction_y}};
}

AvoidDiscs* avoid_discs(InstructionSet set) {
  return Versions<AvoidDiscsKernel, AvoidDiscs>::pick(set);
}

}  // namespace throng::crowd
