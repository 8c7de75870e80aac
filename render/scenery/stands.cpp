#include "render/scenery/stands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/compute/random.h"
#include "base/graphics/drawing/lettering.h"
#include "render/props/prop_cells.h"
#include "world/stand_seats.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStandCellM = 14;
constexpr double kSeatHalfM = 0.22;  // half the width of a seat's shell
constexpr double kSeatBackM = 0.36;  // height of its back above the seat
const Vector3d kStandConcrete(0.235, 0.23, 0.215);
const Vector3d kStandStair(0.3, 0.29, 0.265);
const Vector3d kStandSteel(0.3, 0.31, 0.32);
const Vector3d kStandDark(0.02, 0.02, 0.022);

/// Which seats a stand's text lights up.
class SeatWriting {
 public:
  explicit SeatWriting(const world::Stand& stand) : stand_(stand) {
    if (stand.text.empty() || stand.rows < kMinRows) return;
    const double fits = world::length_m(stand) / world::kSeatSpacingM;
    columns_ = static_cast<std::size_t>(std::max(1.0, fits / kStretch));
    rows_ = static_cast<std::size_t>(stand.rows - 2 * kMarginRows);
    letters_ = drawing::draw_word(stand.text, static_cast<int>(columns_), static_cast<int>(rows_));
  }

  bool is_lit(double along_m, int row) const {
    const int line = row - kMarginRows;
    if (letters_.empty() || line < 0 || line >= static_cast<int>(rows_)) return false;
    // Seen from the field, the text runs against the stand's direction; its first line is highest.
    const double share = 1 - along_m / world::length_m(stand_);
    const auto x =
        std::min(columns_ - 1, static_cast<std::size_t>(share * static_cast<double>(columns_)));
    const std::size_t y = rows_ - 1 - static_cast<std::size_t>(line);
    constexpr std::uint8_t kHalf = 128;
    return letters_[y * columns_ + x] >= kHalf;
  }

 private:
  static constexpr double kStretch = 1.7;  ///< letters are as wide as the slope makes them high
  static constexpr int kMinRows = 12;
  static constexpr int kMarginRows = 3;
  const world::Stand& stand_;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<std::uint8_t> letters_;
};

/// Builds one stand in a frame with x along it, y towards the field and z up.
class StandBuilder {
 public:
  StandBuilder(const world::Stand& stand, std::uint32_t id)
      : stand_(stand),
        writing_(stand),
        length_(world::length_m(stand)),
        depth_(world::depth_m(stand)),
        openings_(world::vomitories(stand)),
        cells_(kStandCellM, id) {
    const Vector2d along = (stand.to - stand.from).normalized();
    frame_ = Eigen::Translation3d(stand.from.x(), stand.from.y(), 0) *
             Eigen::AngleAxisd(std::atan2(along.y(), along.x()), Vector3d::UnitZ());
    const std::vector<world::Paint>& colors = stand.colors;
    const auto color = [](const world::Paint& paint) -> Vector3d {
      return paint.matrix().cast<double>();
    };
    first_ = colors.empty() ? Vector3d(0.035, 0.1, 0.34) : color(colors.front());
    last_ = colors.empty() ? Vector3d(0.62, 0.62, 0.6) : color(colors.back());
    second_ = colors.size() > 2 ? color(colors[1]) : first_;
  }

  std::vector<PropMesh> build() {
    // First: points of light that surfaces share are those of the first.
    add_outside();
    for (int row = 0; row < stand_.rows; ++row) add_row(row);
    for (const world::Aisle& aisle : world::aisles(stand_)) add_stairs(aisle);
    for (const world::Vomitory& opening : openings_) add_opening(opening);
    add_seats();
    add_front_rail();
    if (stand_.roof) add_roof();
    std::vector<PropMesh> meshes;
    cells_.take(meshes);
    return meshes;
  }

 private:
  double floor_m(int row) const { return world::row_height_m(stand_, row); }
  double top_m() const { return floor_m(stand_.rows - 1); }

  PropBuilder& at(double along, double back) {
    PropBuilder& builder = cells_.at(world::point_on(stand_, along, back));
    builder.placing = frame_;
    return builder;
  }

  /// An upright surface from a to b that faces the field at a depth.
  void facing_field(double a, double b, double back, double low, double high, const Vector3d& paint,
                    bool is_near = false, Finish finish = Finish::matt) {
    PropBuilder& builder = at(0.5 * (a + b), back);
    builder.is_near = is_near;
    builder.quad({Vector3d(b, -back, low), Vector3d(a, -back, low), Vector3d(a, -back, high),
                  Vector3d(b, -back, high)},
                 paint, finish);
    builder.is_near = false;
  }

  /// An upright surface that faces away from the field.
  void facing_away(double a, double b, double back, double low, double high, const Vector3d& paint,
                   Finish finish = Finish::matt) {
    at(0.5 * (a + b), back)
        .quad({Vector3d(a, -back, low), Vector3d(b, -back, low), Vector3d(b, -back, high),
               Vector3d(a, -back, high)},
              paint, finish);
  }

  /// A level surface.
  void level(double a, double b, double front, double back, double z, const Vector3d& paint) {
    at(0.5 * (a + b), 0.5 * (front + back))
        .quad({Vector3d(a, -back, z), Vector3d(b, -back, z), Vector3d(b, -front, z),
               Vector3d(a, -front, z)},
              paint, Finish::matt);
  }

  void box(double a, double b, double front, double back, double low, double high,
           const Vector3d& paint, bool is_near = false) {
    PropBuilder& builder = at(0.5 * (a + b), 0.5 * (front + back));
    builder.is_near = is_near;
    builder.box({a, -back, low}, {b, -front, high}, paint);
    builder.is_near = false;
  }

  /// Calls `add` for the pieces of a row, at most a cell long, that no opening takes away.
  template <typename Add>
  void for_pieces(int row, const Add& add) const {
    std::vector<double> ends = {0};
    for (const world::Vomitory& opening : openings_) {
      if (row < opening.first_row || row >= opening.end_row) continue;
      ends.push_back(opening.along_m - 0.5 * world::kVomitoryWidthM);
      ends.push_back(opening.along_m + 0.5 * world::kVomitoryWidthM);
    }
    ends.push_back(length_);
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
      const double pieces = std::max(1.0, std::ceil((ends[i + 1] - ends[i]) / kStandCellM));
      const double step = (ends[i + 1] - ends[i]) / pieces;
      for (double k = 0; k < pieces; ++k) add(ends[i] + k * step, ends[i] + (k + 1) * step);
    }
  }

  void add_row(int row) {
    const double front = row * stand_.row_depth_m;
    const double z = floor_m(row);
    const double below = row > 0 ? floor_m(row - 1) : 0;
    for_pieces(row, [&](double a, double b) {
      // Two strips: light differs between the feet and what is below the seats.
      const double middle = front + 0.55 * stand_.row_depth_m;
      level(a, b, front, middle, z, kStandConcrete);
      level(a, b, middle, front + stand_.row_depth_m, z, 0.92 * kStandConcrete);
      if (row > 0) facing_field(a, b, front, below, z, 0.8 * kStandConcrete);
    });
    // The sides of the stand, row by row.
    for (const double x : {0.0, length_}) {
      const double y0 = -front;
      const double y1 = -front - stand_.row_depth_m;
      std::array<Vector3d, 4> side = {Vector3d(x, y1, 0), Vector3d(x, y0, 0),
                                      Vector3d(x, y0, z + 0.9), Vector3d(x, y1, z + 0.9)};
      if (x == 0) std::swap(side[0], side[1]), std::swap(side[2], side[3]);
      at(x, front).quad(side, 0.95 * kStandConcrete, Finish::matt);
      const double inner = x == 0 ? 0.12 : length_ - 0.12;
      std::array<Vector3d, 4> inside = {Vector3d(inner, y0, z), Vector3d(inner, y1, z),
                                        Vector3d(inner, y1, z + 0.9), Vector3d(inner, y0, z + 0.9)};
      if (x == 0) std::swap(inside[0], inside[1]), std::swap(inside[2], inside[3]);
      at(x, front).quad(inside, 0.9 * kStandConcrete, Finish::matt);
      const double a = std::min(x, inner);
      level(a, a + 0.12, front, front + stand_.row_depth_m, z + 0.9, kStandConcrete);
      facing_field(a, a + 0.12, front, row > 0 ? below + 0.9 : 0, z + 0.9, kStandConcrete);
    }
  }

  /// Half steps between the rows, light edges, and rails in the middle.
  void add_stairs(const world::Aisle& aisle) {
    const double a = aisle.along_m - 0.5 * world::kAisleWidthM;
    const double b = aisle.along_m + 0.5 * world::kAisleWidthM;
    const auto is_open = [&](int row) {
      return std::any_of(openings_.begin(), openings_.end(), [&](const auto& opening) {
        return opening.along_m == aisle.along_m && row >= opening.first_row &&
               row < opening.end_row;
      });
    };
    for (int row = 0; row < stand_.rows; ++row) {
      if (is_open(row)) continue;
      const double front = row * stand_.row_depth_m;
      const double z = floor_m(row);
      const double rise = row + 1 < stand_.rows ? stand_.row_rise_m : 0;
      const double back = front + stand_.row_depth_m;
      const bool has_half_step = rise > 0.2;
      const double step = has_half_step ? back - 0.5 * stand_.row_depth_m : back - 0.02;
      level(a, b, front + 0.02, step - 0.02, z + 0.012, kStandStair);
      if (has_half_step) {
        facing_field(a, b, step, z, z + 0.5 * rise, 0.8 * kStandStair);
        level(a, b, step, back - 0.02, z + 0.5 * rise, kStandStair);
        for (const double x : {a, b})
          add_step_side(x, x > aisle.along_m, step, back, z, 0.5 * rise);
      }
      PropBuilder& builder = at(aisle.along_m, front);
      builder.is_near = true;
      builder.box({a, -front - 0.06, z + 0.013}, {b, -front - 0.005, z + 0.022}, {0.5, 0.42, 0.08});
      if (row % 3 == 1 && row + 1 < stand_.rows) {
        const double x = aisle.along_m;
        for (const double y : {front + 0.1, back + 0.1}) {
          builder.tube({x, -y, z}, 0.02, {x, -y, z + 0.95 + (y > back ? rise : 0)}, 0.02,
                       kStandSteel, Finish::matt, 5);
        }
        builder.tube({x, -front - 0.1, z + 0.95}, 0.02, {x, -back - 0.1, z + 0.95 + rise}, 0.02,
                     kStandSteel, Finish::matt, 5);
      }
      builder.is_near = false;
    }
    if (stand_.front_height_m > 0.3) {  // steps before the first row
      const double steps = std::ceil(stand_.front_height_m / 0.2);
      for (double i = 0; i < steps; ++i) {
        const double top = stand_.front_height_m * (i + 1) / (steps + 1);
        const double reach = world::kFrontStepsM * (1 - i / steps);
        box(a + 0.1, b - 0.1, -reach, 0, 0, top, kStandStair);
      }
    }
  }

  /// The side of a half step.
  void add_step_side(double x, bool is_right, double front, double back, double z, double rise) {
    std::array<Vector3d, 4> side = {Vector3d(x, -back, z), Vector3d(x, -front, z),
                                    Vector3d(x, -front, z + rise), Vector3d(x, -back, z + rise)};
    if (!is_right) side = {side[1], side[0], side[3], side[2]};
    at(x, front).quad(side, 0.8 * kStandStair, Finish::matt);
  }

  /// A dark passage with walls and rails where rows are left out.
  void add_opening(const world::Vomitory& opening) {
    const double a = opening.along_m - 0.5 * world::kVomitoryWidthM;
    const double b = opening.along_m + 0.5 * world::kVomitoryWidthM;
    const double front = opening.first_row * stand_.row_depth_m;
    const double back = opening.end_row * stand_.row_depth_m;
    const double z = floor_m(opening.first_row - 1);
    const double rear = opening.end_row < stand_.rows ? floor_m(opening.end_row) : top_m();
    level(a, b, front, back, z, 0.5 * kStandConcrete);
    facing_field(a, b, back - 0.01, z, rear, kStandDark);
    facing_field(a, b, back - 0.03, rear - 0.35, rear, 1.1 * kStandConcrete);
    PropBuilder& builder = at(opening.along_m, front);
    for (const double x : {a, b}) {
      std::array<Vector3d, 4> wall = {Vector3d(x, -front, z), Vector3d(x, -back, z),
                                      Vector3d(x, -back, rear + 0.9), Vector3d(x, -front, z + 1)};
      builder.quad(wall, 0.85 * kStandConcrete, Finish::matt);
      builder.quad({wall[1], wall[0], wall[3], wall[2]}, 0.85 * kStandConcrete, Finish::matt);
    }
    // Rails around the three upper sides.
    const std::array<Vector3d, 4> corners = {
        Vector3d(a, -front, z + 1.05), Vector3d(a, -back, rear + 1), Vector3d(b, -back, rear + 1),
        Vector3d(b, -front, z + 1.05)};
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      builder.tube(corners.at(i), 0.03, corners.at(i + 1), 0.03, kStandSteel, Finish::matt, 5);
    }
    for (double x = a; x < b + 0.1; x += 0.8) {
      builder.tube({x, -back, rear}, 0.02, {x, -back, rear + 1}, 0.02, kStandSteel, Finish::matt,
                   4);
    }
  }

  Vector3d seat_paint(const world::Seat& seat) const {
    if (writing_.is_lit(seat.along_m, seat.row)) return last_;
    return seat.block % 2 == 1 ? second_ : first_;
  }

  /// A seat's shell, or a strip of them, between a and b: `z` is the height of the seat.
  static void add_shell(PropBuilder& builder, double a, double b, double pelvis, double z,
                        const Vector3d& paint) {
    const double front = pelvis - 0.2;
    const double back = pelvis + 0.2;
    builder.quad({Vector3d(a, -back, z - 0.02), Vector3d(b, -back, z - 0.02),
                  Vector3d(b, -front, z + 0.02), Vector3d(a, -front, z + 0.02)},
                 0.85 * paint, Finish::matt);
    builder.quad(
        {Vector3d(b, -back, z - 0.02), Vector3d(a, -back, z - 0.02),
         Vector3d(a, -back - 0.07, z + kSeatBackM), Vector3d(b, -back - 0.07, z + kSeatBackM)},
        paint, Finish::matt);
  }

  void add_seats() {
    const std::vector<world::Seat> seats = world::seats(stand_);
    for (std::size_t i = 0; i < seats.size();) {
      const Vector3d paint = seat_paint(seats[i]);
      std::size_t end = i;
      while (end < seats.size() && seats[end].row == seats[i].row &&
             seats[end].block == seats[i].block && seat_paint(seats[end]) == paint) {
        add_near_seat(seats[end], end, paint);
        ++end;
      }
      const double pelvis = world::frame_point(stand_, seats[i].position).y();
      const double a = seats[i].along_m - kSeatHalfM;
      const double b = seats[end - 1].along_m + kSeatHalfM;
      PropBuilder& builder = at(0.5 * (a + b), pelvis);
      builder.is_far = true;
      // Gaps between seats are too small to be seen, but not without effect.
      add_shell(builder, a, b, pelvis, seats[i].height_m + world::kSeatHeightM, 0.86 * paint);
      builder.is_far = false;
      i = end;
    }
  }

  void add_near_seat(const world::Seat& seat, std::size_t number, const Vector3d& paint) {
    constexpr double kMissing = 0.01;
    Random random(number, Stream::environment, 0x5EA7);
    if (random.uniform() < kMissing) return;
    const double pelvis = world::frame_point(stand_, seat.position).y();
    const double a = seat.along_m - kSeatHalfM;
    const double b = seat.along_m + kSeatHalfM;
    const double z = seat.height_m + world::kSeatHeightM;
    PropBuilder& builder = at(seat.along_m, pelvis);
    builder.is_near = true;
    const Vector3d tone = random.uniform(0.88, 1.1) * paint;
    add_shell(builder, a, b, pelvis, z, tone);
    const double back = pelvis + 0.2;
    builder.quad({Vector3d(b, -pelvis + 0.2, z - 0.1), Vector3d(a, -pelvis + 0.2, z - 0.1),
                  Vector3d(a, -pelvis + 0.2, z + 0.02), Vector3d(b, -pelvis + 0.2, z + 0.02)},
                 0.7 * tone, Finish::matt);
    builder.quad(
        {Vector3d(a, -back - 0.03, z - 0.12), Vector3d(b, -back - 0.03, z - 0.12),
         Vector3d(b, -back - 0.1, z + kSeatBackM), Vector3d(a, -back - 0.1, z + kSeatBackM)},
        0.75 * tone, Finish::matt);
    builder.is_near = false;
  }

  /// A way in, or a shutter of slats beside a door, with a canopy and a lamp above.
  void add_gate(double a, double b, double top, bool is_open) {
    const double y = depth_ + 0.012;
    if (is_open) {
      facing_away(a, b, y, 0, top, kStandDark);
      for (const double x : {a + 0.35 * (b - a), a + 0.65 * (b - a)}) {
        at(x, y).tube({x, -y - 0.2, 0}, 0.03, {x, -y - 0.2, 1}, 0.03, kStandSteel, Finish::matt, 4);
      }
    } else {
      constexpr int kSlats = 6;
      const double door = b - 1;
      for (int k = 0; k < kSlats; ++k) {
        facing_away(a, door - 0.2, y, top * k / kSlats, top * (k + 1) / kSlats,
                    (k % 2 == 0 ? 0.75 : 0.62) * kStandSteel);
      }
      facing_away(door, b, y, 0, 2.1, 0.8 * first_);
      facing_away(door + 0.3, b - 0.3, y + 0.01, 1.3, 1.8, kStandDark, Finish::lit_glass);
    }
    box(a - 0.2, b + 0.2, depth_, depth_ + 0.5, top + 0.05, top + 0.2, 0.9 * kStandConcrete);
    const double middle = 0.5 * (a + b);
    facing_away(middle - 0.4, middle + 0.4, depth_ + 0.02, top + 0.3, top + 0.5, last_,
                Finish::lit_glass);
  }

  /// A banner that hangs on a column.
  void add_banner(double along, double top, const Vector3d& paint) {
    const double y = depth_ + 0.36;
    facing_away(along - 0.25, along + 0.25, y, std::max(top - 2.8, 2.9), top, paint);
    facing_away(along - 0.25, along + 0.25, y + 0.01, std::max(top - 1.2, 3.2), top - 0.9, last_);
  }

  /// Front wall, and the back with its columns, a band of windows and gates.
  void add_outside() {
    const double bays = std::max(1.0, std::round(length_ / 6));
    const double bay = length_ / bays;
    const double crest = top_m() + 1.1;
    for (double i = 0; i < bays; ++i) {
      const double a = i * bay;
      const double b = a + bay;
      facing_field(a, b, 0, 0, stand_.front_height_m, 1.05 * kStandConcrete);
      // Panels end beside the columns, within which no light is known.
      facing_away(a + 0.22, b - 0.22, depth_, 0, crest, 1.4 * kStandConcrete);
      facing_field(a, b, depth_ - 0.15, top_m(), crest, 0.9 * kStandConcrete);
      level(a, b, depth_ - 0.15, depth_, crest, kStandConcrete);
      box(a - 0.2, a + 0.2, depth_, depth_ + 0.3, 0, crest - 0.6, 1.2 * kStandConcrete);
      // A band in the color of the seats, as high as a person.
      facing_away(a + 0.22, b - 0.22, depth_ + 0.04, crest - 1.5, crest - 0.3, 0.8 * first_);
      constexpr double kGateM = 2.6;
      if (crest > kGateM + 0.8) {
        add_gate(a + 1.2, b - 1.2, kGateM, static_cast<int>(i) % 3 == 1);
        add_banner(a, crest - 0.8, static_cast<int>(i) % 2 == 0 ? first_ : last_);
      }
      for (double z = kGateM + 1; z + 1 < crest; z += 2.6) {
        facing_away(a + 0.6, b - 0.6, depth_ + 0.012, z, z + 0.9, 1.3 * kStandDark,
                    Finish::lit_glass);
      }
    }
  }

  void add_front_rail() {
    const double pieces = std::max(1.0, std::round(length_ / 2));
    const double z = stand_.front_height_m;
    const std::vector<world::Aisle> aisles = world::aisles(stand_);
    for (double i = 0; i < pieces; ++i) {
      const double a = i / pieces * length_;
      const double b = (i + 1) / pieces * length_;
      const bool is_gate = std::any_of(aisles.begin(), aisles.end(), [&](const auto& aisle) {
        return aisle.along_m > a - 0.6 && aisle.along_m < b + 0.6;
      });
      if (is_gate) continue;
      PropBuilder& builder = at(0.5 * (a + b), 0);
      for (const double up : {0.5, 1.0}) {
        builder.tube({a, -0.06, z + up}, 0.025, {b, -0.06, z + up}, 0.025, kStandSteel,
                     Finish::matt, 4);
      }
      builder.tube({a, -0.06, z}, 0.025, {a, -0.06, z + 1}, 0.025, kStandSteel, Finish::matt, 4);
      builder.tube({b, -0.06, z}, 0.025, {b, -0.06, z + 1}, 0.025, kStandSteel, Finish::matt, 4);
    }
  }

  /// A cantilever: sheets that rise towards the field on frames with columns at the back.
  void add_roof() {
    const double back_z = top_m() + 4.5;
    const double front_z = back_z + 0.09 * depth_;
    const double back = depth_ + 0.8;
    const double front = -1.5;
    const Vector3d sheet(0.5, 0.51, 0.52);
    const double frames = std::max(1.0, std::round(length_ / 8));
    const double apart = length_ / frames;
    const auto roof_at = [&](double depth) {
      return back_z + (back - depth) / (back - front) * (front_z - back_z);
    };
    constexpr int kSheets = 4;
    for (double i = 0; i < frames; ++i) {
      const double a = i * apart;
      const double b = a + apart;
      for (int k = 0; k < kSheets; ++k) {
        const double near = front + (back - front) * k / kSheets;
        const double far = front + (back - front) * (k + 1) / kSheets;
        const double z0 = roof_at(near);
        const double z1 = roof_at(far);
        PropBuilder& builder = at(0.5 * (a + b), 0.5 * (near + far));
        const Vector3d tone = (k == 0 ? 1.25 : 1.0 - 0.03 * (static_cast<int>(i) % 2)) * sheet;
        builder.quad({Vector3d(a, -far, z1), Vector3d(b, -far, z1), Vector3d(b, -near, z0),
                      Vector3d(a, -near, z0)},
                     tone, Finish::matt);
        builder.quad({Vector3d(a, -near, z0 - 0.15), Vector3d(b, -near, z0 - 0.15),
                      Vector3d(b, -far, z1 - 0.15), Vector3d(a, -far, z1 - 0.15)},
                     0.8 * tone, Finish::matt);
      }
      box(a, b, front - 0.15, front + 0.1, roof_at(front) - 0.75, roof_at(front) + 0.1,
          0.75 * sheet);
      box(a + 0.5 * apart - 0.8, a + 0.5 * apart + 0.8, front + 0.3, front + 0.7,
          roof_at(front) - 0.75, roof_at(front) - 0.4, {0.75, 0.74, 0.7}, true);
    }
    for (double i = 0; i <= frames; ++i) {
      const double x = std::clamp(i * apart, 0.15, length_ - 0.15);
      PropBuilder& builder = at(x, depth_);
      builder.box({x - 0.18, -depth_ - 0.7, 0}, {x + 0.18, -depth_ - 0.32, back_z + 0.9},
                  kStandSteel);
      builder.tube({x, -depth_ - 0.5, back_z - 0.1}, 0.16, {x, -front, front_z - 0.35}, 0.08,
                   kStandSteel, Finish::matt, 6);
      builder.tube({x, -depth_ - 0.5, back_z - 2.8}, 0.1,
                   {x, -0.55 * depth_, roof_at(0.55 * depth_) - 0.3}, 0.08, kStandSteel,
                   Finish::matt, 6);
      builder.tube({x, -depth_ - 0.5, back_z + 0.9}, 0.05,
                   {x, -0.3 * depth_, roof_at(0.3 * depth_)}, 0.04, kStandSteel, Finish::matt, 5);
    }
  }

  const world::Stand& stand_;
  SeatWriting writing_;
  double length_;
  double depth_;
  std::vector<world::Vomitory> openings_;
  PropCells cells_;
  Eigen::Affine3d frame_ = Eigen::Affine3d::Identity();
  Vector3d first_;
  Vector3d second_;
  Vector3d last_;
};

}  // namespace

std::vector<PropMesh> make_stand(const world::Stand& stand, std::uint32_t id) {
  return StandBuilder(stand, id).build();
}

}  // namespace throng::render
