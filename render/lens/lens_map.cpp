#include "render/lens/lens_map.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include "base/compute/parallel.h"
#include "base/error.h"
#include "spec/annotate/outlines.h"

namespace throng::render {

namespace {

using Eigen::Vector2d;

/// Rows that one task of a loop takes.
constexpr std::size_t kGrain = 16;
/// At a magnification above this the wide image is coarser than the output image.
constexpr double kMaxMagnification = 2;
/// Farther out are no pixels (px).
constexpr float kMaxPosition = 1e6F;
/// Steps of the search for the largest magnification (px).
constexpr int kCoarse = 16;

std::size_t cells(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

/// How many wide pixels per image pixel it takes to lose nothing where the lens magnifies most.
double magnification(const camera::Intrinsics& lens) {
  double max_magnification = 1;
  for (int y = 0; y < lens.height; y += kCoarse) {
    for (int x = 0; x < lens.width; x += kCoarse) {
      const auto direction = lens.direction_of({x, y});
      if (!direction) continue;
      max_magnification =
          std::max(max_magnification,
                   lens.distortion->derivatives(*direction).jacobiSvd().singularValues()[0]);
    }
  }
  return std::min(max_magnification, kMaxMagnification);
}

/// Directions of a row of pixels from `first` on, NaN beyond the model.
void fill_row(const camera::Intrinsics& lens, const Eigen::Vector2i& first,
              std::span<Vector2d> row) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Vector2d before = Vector2d::Constant(kNone);
  Vector2d last = before;
  Vector2d pixel = first.cast<double>();
  for (Vector2d& direction : row) {
    // Along a row directions grow nearly evenly. NaN is no guess.
    direction = lens.direction_of(pixel, 2 * last - before).value_or(Vector2d::Constant(kNone));
    before = last;
    last = direction;
    pixel.x() += 1;
  }
}

/// Directions of an area's pixels, row by row: NaN beyond the model.
std::vector<Vector2d> ray_directions(const camera::Intrinsics& lens,
                                     const Eigen::AlignedBox2i& area) {
  const Eigen::Vector2i size = area.sizes();
  const auto width = static_cast<std::size_t>(size.x());
  std::vector<Vector2d> directions(cells(size.x(), size.y()));
  parallel_ranges(static_cast<std::size_t>(size.y()), kGrain,
                  [&](std::size_t begin, std::size_t end) {
                    for (std::size_t row = begin; row < end; ++row) {
                      fill_row(lens, {area.min().x(), area.min().y() + static_cast<int>(row)},
                               std::span(directions).subspan(row * width, width));
                    }
                  });
  return directions;
}

/// The pinhole image that holds all these directions but NaN, with a pixel more at each side for
/// the interpolation.
camera::Intrinsics wide_pinhole(const camera::Intrinsics& lens,
                                const std::vector<Vector2d>& directions) {
  Eigen::AlignedBox2d field;
  for (const Vector2d& direction : directions) {
    if (!direction.hasNaN()) field.extend(direction);
  }
  // Rows that show nothing still are an image.
  if (field.isEmpty()) field.extend(Vector2d(0, 0));
  const double finer = magnification(lens);
  camera::Intrinsics wide;
  wide.fx_px = lens.fx_px * finer;
  wide.fy_px = lens.fy_px * finer;
  // Whole pixels from the lens's own axis: where nothing is magnified, pixels lie on pixels.
  wide.cx_px = lens.cx_px + std::ceil(1 - field.min().x() * wide.fx_px - lens.cx_px);
  wide.cy_px = lens.cy_px + std::ceil(1 - field.min().y() * wide.fy_px - lens.cy_px);
  wide.width = static_cast<int>(std::ceil(field.max().x() * wide.fx_px + wide.cx_px)) + 2;
  wide.height = static_cast<int>(std::ceil(field.max().y() * wide.fy_px + wide.cy_px)) + 2;
  return wide;
}

/// Adds the farthest directions that the lens's model reaches, as far as they are in the image.
void extend_to_limit(const camera::Intrinsics& lens, std::vector<Vector2d>& directions) {
  constexpr int kDirections = 256;
  constexpr double kInside = 1 - 1e-9;
  const double limit = kInside * lens.distortion->limit();
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2 * std::numbers::pi * i / kDirections;
    const Vector2d direction = limit * Vector2d(std::cos(angle), std::sin(angle));
    const auto pixel = lens.pixel_of(direction);
    const bool is_in_image = pixel && pixel->x() > -0.5 && pixel->y() > -0.5 &&
                             pixel->x() < lens.width - 0.5 && pixel->y() < lens.height - 0.5;
    if (is_in_image) directions.push_back(direction);
  }
}

/// Position of a direction in the wide image. Floats, since it is stored for every pixel.
Eigen::Vector2f wide_position(const camera::Intrinsics& wide, const Vector2d& direction) {
  return Vector2d(direction.x() * wide.fx_px + wide.cx_px, direction.y() * wide.fy_px + wide.cy_px)
      .cast<float>();
}

/// Counts the nearest wide pixel of every pixel of the image and of what is around these rows.
PixelWeights pixel_weights(const camera::Intrinsics& lens, const Rows& rows,
                           const camera::Intrinsics& wide) {
  const int beside = lens.width / annotate::kLensMarginDivisor;
  const int above = rows.first == 0 ? lens.height / annotate::kLensMarginDivisor : 0;
  const int below = rows.end == lens.height ? lens.height / annotate::kLensMarginDivisor : 0;
  const Eigen::AlignedBox2i area(Eigen::Vector2i(-beside, rows.first - above),
                                 Eigen::Vector2i(lens.width + beside, rows.end + below));
  const Eigen::Vector2i size(wide.width, wide.height);
  PixelWeights weights;
  weights.domain = Eigen::AlignedBox2i(-size / 2, size + size / 2);
  const Eigen::Vector2i span = weights.domain.sizes();
  weights.count.resize(cells(span.x(), span.y()));
  for (const Vector2d& direction : ray_directions(lens, area)) {
    const Eigen::Vector2f at = wide_position(wide, direction);
    // Written so that NaN leaves, too.
    if (!(at.cwiseAbs().maxCoeff() < kMaxPosition)) continue;
    const Eigen::Vector2i pixel(std::lround(at.x()), std::lround(at.y()));
    if (!weights.domain.contains(pixel) || pixel.x() == weights.domain.max().x() ||
        pixel.y() == weights.domain.max().y()) {
      continue;
    }
    const Eigen::Vector2i inside = pixel - weights.domain.min();
    std::uint8_t& count =
        weights.count[static_cast<std::size_t>(inside.y()) * static_cast<std::size_t>(span.x()) +
                      static_cast<std::size_t>(inside.x())];
    if (count < std::numeric_limits<std::uint8_t>::max()) ++count;
  }
  return weights;
}

}  // namespace

std::optional<camera::Intrinsics> wide_image(const camera::Intrinsics& lens) {
  if (!lens.distortion) return lens;
  // The extremes are at the border of the image, or at that of what the lens shows, which a grid
  // finds but for one step: at most that much of the widest direction is missing.
  std::vector<Vector2d> directions;
  const auto step = [](int at, int size) { return std::min(at + kCoarse, size - 1); };
  for (int y = 0;; y = step(y, lens.height)) {
    for (int x = 0;; x = step(x, lens.width)) {
      if (const auto direction = lens.direction_of({x, y})) directions.push_back(*direction);
      if (x == lens.width - 1) break;
    }
    if (y == lens.height - 1) break;
  }
  if (directions.empty()) return std::nullopt;
  if (!shows_everywhere(lens)) extend_to_limit(lens, directions);
  return wide_pinhole(lens, directions);
}

Eigen::Vector2i wide_size(const camera::Intrinsics& lens) {
  const std::optional<camera::Intrinsics> wide = wide_image(lens);
  return wide ? Eigen::Vector2i(wide->width, wide->height) : Eigen::Vector2i::Zero();
}

bool shows_everywhere(const camera::Intrinsics& lens) {
  if (!lens.distortion) return true;
  // The image circle of a lens is convex: an image whose border is within it lies in it entirely.
  for (int x = 0; x < lens.width; ++x) {
    if (!lens.direction_of({x, 0}) || !lens.direction_of({x, lens.height - 1})) return false;
  }
  for (int y = 0; y < lens.height; ++y) {
    if (!lens.direction_of({0, y}) || !lens.direction_of({lens.width - 1, y})) return false;
  }
  return true;
}

std::vector<std::uint8_t> shown_pixels(const camera::Intrinsics& lens) {
  std::vector<std::uint8_t> shown(cells(lens.width, lens.height), 255);
  if (!lens.distortion) return shown;
  const std::vector<Vector2d> directions =
      ray_directions(lens, {Eigen::Vector2i::Zero(), Eigen::Vector2i(lens.width, lens.height)});
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (directions[i].hasNaN()) shown[i] = 0;
  }
  return shown;
}

LensMap lens_map(const camera::Intrinsics& lens, const Rows& rows) {
  check(lens.distortion.has_value(), "only a lens that distorts has a map");
  const std::vector<Vector2d> directions =
      ray_directions(lens, {Eigen::Vector2i(0, rows.first), Eigen::Vector2i(lens.width, rows.end)});
  LensMap map;
  map.wide = wide_pinhole(lens, directions);
  map.whole = wide_image(lens).value_or(map.wide);
  map.position.reserve(directions.size() * 2);
  for (const Vector2d& direction : directions) {
    const Eigen::Vector2f at = wide_position(map.wide, direction);
    map.position.push_back(at.x());
    map.position.push_back(at.y());
  }
  map.weights = pixel_weights(lens, rows, map.wide);
  return map;
}

}  // namespace throng::render
