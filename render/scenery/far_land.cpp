#include "render/scenery/far_land.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/geometry/polygon.h"
#include "render/frame/frame.h"
#include "render/ground/ground_layers.h"
#include "render/props/prop_cells.h"
#include "render/scenery/far_objects.h"
#include "render/scenery/land_pattern.h"

namespace throng::render {

namespace {

using Eigen::AlignedBox2d;
using Eigen::Vector2d;
using Eigen::Vector2i;

/// Random numbers of one object on the land, by its kind and cell.
Random draw_random(std::uint64_t kind, const Vector2i& cell, int number = 0) {
  constexpr std::int64_t kOffset = 1 << 20;  // indices are not negative
  const auto x = static_cast<std::uint64_t>(kOffset + cell.x());
  const auto y = static_cast<std::uint64_t>(kOffset + cell.y());
  return Random(kind + 0xFA210, Stream::environment,
                (x << 40U | y << 16U) + static_cast<std::uint64_t>(number));
}

class LandBuilder {
 public:
  LandBuilder(const world::Scenario& scenario, const std::vector<AlignedBox2d>& taken)
      : ground_(scenario.ground.min, scenario.ground.max),
        taken_(taken),
        built_share_(built_share(scenario)),
        is_town_(built_share_ > 0.5) {
    for (std::size_t i = 0; i < scenario.areas.size(); ++i) {
      for (auto& street : streets_beyond(scenario, i)) streets_.push_back(std::move(street));
    }
    const Vector2d reach = Vector2d::Constant(kMaxLandM);
    for (const AlignedBox2d::CornerType corner :
         {AlignedBox2d::BottomLeft, AlignedBox2d::BottomRight, AlignedBox2d::TopLeft,
          AlignedBox2d::TopRight}) {
      land_.extend(land_from_ground(
          AlignedBox2d(ground_.min() - reach, ground_.max() + reach).corner(corner)));
    }
  }

  void build() {
    for_cells(kPlotM, [&](const Vector2i& plot) { add_plot(plot); });
    const int first = static_cast<int>(std::floor(land_.min().y() / kFieldM));
    const int last = static_cast<int>(std::floor(land_.max().y() / kFieldM));
    for (int row = first; row <= last; ++row) {
      Field field = field_at({land_.min().x(), (row + 0.5) * kFieldM});
      while (field.begin_m < land_.max().x()) {
        add_borders(field);
        add_wood(field);
        field = field_at({field.begin_m + 1.5 * field.length_m, (row + 0.5) * kFieldM});
      }
    }
  }

  std::vector<PropMesh> take() {
    std::vector<PropMesh> meshes;
    cells_.take(meshes);
    return meshes;
  }

 private:
  template <typename Add>
  void for_cells(const Vector2d& size, const Add& add) const {
    const Vector2i low = land_.min().cwiseQuotient(size).array().floor().cast<int>();
    const Vector2i high = land_.max().cwiseQuotient(size).array().floor().cast<int>();
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) add(Vector2i(x, y));
    }
  }

  double beyond_m(const Vector2d& point) const { return ground_.exteriorDistance(point); }

  /// Whether something with this radius may stand at a point.
  bool is_free(const Vector2d& point, double radius_m) const {
    constexpr double kVergeM = 2.5;
    const double off = beyond_m(point);
    if (off < kMinLandM + radius_m || off > kMaxLandM - radius_m) return false;
    const auto is_near = [&](const auto& street) {
      return geometry::distance_to(street, point) < radius_m + kVergeM;
    };
    if (std::any_of(streets_.begin(), streets_.end(), is_near)) return false;
    return std::none_of(taken_.begin(), taken_.end(), [&](const AlignedBox2d& box) {
      return box.exteriorDistance(point) < radius_m + kVergeM;
    });
  }

  FarDetail detail_at(const Vector2d& point) const {
    constexpr double kNearM = 90;
    constexpr double kMiddleM = 200;
    const double off = beyond_m(point);
    return off < kNearM ? FarDetail::near : off < kMiddleM ? FarDetail::middle : FarDetail::far;
  }

  void add_plot(const Vector2i& plot) {
    const Vector2d at = (plot.cast<double>() + Vector2d(0.5, 0.46)).cwiseProduct(kPlotM);
    if (!is_built(field_at(at), built_share_)) return;
    const Vector2d middle = ground_from_land(at);
    if (beyond_m(middle) > kMaxLandM) return;
    Random random = draw_random(1, plot);
    if (has_house(plot) && keeps(middle, is_town_ ? 140 : 200, random)) add_house(middle, random);
    const std::uint32_t trees = random.below(4);
    for (std::uint32_t i = 0; i < trees; ++i) {
      const Vector2d in_plot(random.uniform(0.08, 0.92), random.uniform() < 0.5
                                                             ? random.uniform(0.02, 0.16)
                                                             : random.uniform(0.72, 0.84));
      add_tree(ground_from_land((plot.cast<double>() + in_plot).cwiseProduct(kPlotM)), 0.75,
               random);
    }
  }

  /// Thins out what is far, which covers few pixels and of which one sees the front rows.
  bool keeps(const Vector2d& point, double full_m, Random& random) const {
    const double share = full_m / std::max(beyond_m(point), 1.0);
    return random.uniform() < share * share;
  }

  void add_house(const Vector2d& middle, Random& random) {
    FarHouse house;
    house.middle = middle;
    house.yaw_rad = kLandYawRad + random.uniform(-0.06, 0.06);
    house.detail = detail_at(middle);
    if (is_town_ && random.uniform() < 0.6) {
      house.half_size = {random.uniform(9, 12.2), random.uniform(5.5, 7)};
      house.stories = 3 + static_cast<int>(random.below(4));
      house.has_flat_roof = random.uniform() < 0.65;
    } else {
      house.half_size = {random.uniform(5, 7.5), random.uniform(4, 5.2)};
      house.stories = 1 + static_cast<int>(random.below(2));
      if (random.uniform() < 0.3) house.yaw_rad += 0.5 * std::numbers::pi;
    }
    if (!is_free(middle, house.half_size.norm())) return;
    add_far_house(cells_.at(middle), house, random);
  }

  void add_tree(const Vector2d& middle, double size, Random& random) {
    FarTree tree;
    tree.middle = middle;
    tree.height_m = size * random.uniform(7, 16);
    tree.crown_m = tree.height_m * random.uniform(0.24, 0.46);
    tree.detail = detail_at(middle);
    // One that is far stands for its neighbors as well, which are left out.
    tree.crown_m *= std::clamp(beyond_m(middle) / 300, 1.0, 2.5);
    if (!keeps(middle, 125, random) || !is_free(middle, tree.crown_m)) return;
    add_far_tree(cells_.at(middle), tree, random);
  }

  /// Trees and bushes along the field's lower border and its first side.
  void add_borders(const Field& field) {
    constexpr double kApartM = 9;
    const double low_m = field.number.y() * kFieldM;
    const bool lower = has_hedge(field.number.y());
    const int along = lower ? static_cast<int>(field.length_m / kApartM) : 0;
    const int up = static_cast<int>(kFieldM / kApartM);
    for (int i = 0; i < along + up; ++i) {
      Random random = draw_random(2, field.number, i);
      const double off = random.uniform(0.5, 5);
      const double step = (i < along ? i : i - along) + random.uniform(0.2, 0.8);
      const Vector2d at = i < along ? Vector2d(field.begin_m + step * kApartM, low_m + off)
                                    : Vector2d(field.begin_m + off, low_m + step * kApartM);
      // Rows have gaps, and parts of bushes alone.
      const double grown = smooth_noise(0.035 * at + Vector2d::Constant(77));
      if (grown < 0.34) continue;
      add_tree(ground_from_land(at), grown < 0.45 ? 0.35 : 1, random);
    }
  }

  /// A wood in some of the fields.
  void add_wood(const Field& field) {
    constexpr double kApartM = 8;
    constexpr double kWoodShare = 0.12;
    const bool is_wood = cell_hash(field.number + Vector2i::Constant(151)) < kWoodShare;
    if (is_built(field, built_share_) || !is_wood) return;
    const int columns = static_cast<int>(field.length_m / kApartM);
    const int rows = static_cast<int>(kFieldM / kApartM);
    for (int i = 0; i < columns * rows; ++i) {
      Random random = draw_random(3, field.number, i);
      const int row = i / columns;
      const Vector2d cell(i % columns + random.uniform(), row + random.uniform());
      const Vector2d at = Vector2d(field.begin_m, field.number.y() * kFieldM) + kApartM * cell;
      if (smooth_noise(0.02 * at + Vector2d::Constant(13)) < 0.4) continue;
      add_tree(ground_from_land(at), 1.1, random);
    }
  }

  AlignedBox2d ground_;
  const std::vector<AlignedBox2d>& taken_;
  double built_share_;
  bool is_town_;
  std::vector<std::vector<Vector2d>> streets_;
  AlignedBox2d land_;
  static constexpr double kCellM = 150;
  PropCells cells_{kCellM, kIdNothing};
};

}  // namespace

std::vector<PropMesh> far_land(const world::Scenario& scenario,
                               const std::vector<AlignedBox2d>& taken) {
  LandBuilder builder(scenario, taken);
  builder.build();
  return builder.take();
}

}  // namespace throng::render
