#include "render/people/distant_painter.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "base/compute/srgb.h"
#include "render/frame/view.h"

namespace throng::render {

namespace {

constexpr int kSnap = 256;  ///< positions per pixel; also in shaders/view.glsl
constexpr int kHalf = kSnap / 2;

/// First pixel whose center is at or after a position, and the last one at or before it.
int first_pixel(int position) { return (position + kHalf - 1) >> 8; }
int last_pixel(int position) { return (position - kHalf) >> 8; }

/// One side of a triangle: how far inside of it a place is, 0 or more in the triangle.
struct Side {
  int value;   ///< at the first pixel
  int step_x;  ///< per pixel
  int step_y;

  /// From (ax, ay) to (bx, by); the first pixel's center is (x, y). Of two triangles that share the
  /// side one has the pixels on it.
  Side(int ax, int ay, int bx, int by, int x, int y) {
    const int dx = bx - ax;
    const int dy = by - ay;
    const bool has_own = dy > 0 || (dy == 0 && dx < 0);
    value = dy * (x - ax) - dx * (y - ay) - (has_own ? 0 : 1);
    step_x = dy * kSnap;
    step_y = -dx * kSnap;
  }
};

/// The nearest integer of a number that is not negative; std::lround() takes much longer.
int rounded(float value) {
  constexpr float kToNearest = 0.5F;
  return static_cast<int>(value + kToNearest);
}

/// The square root of a share, as an integer up to `max`.
std::uint32_t root_bits(float share, float max) {
  return static_cast<std::uint32_t>(rounded(std::sqrt(std::clamp(share, 0.0F, 1.0F)) * max));
}

}  // namespace

void PaintedShape::begin(const Eigen::Vector2i& first, int rows) {
  first_ = first;
  count_ = rows;
  std::fill_n(rows_.begin(), rows, 0);
}

std::uint64_t PaintedShape::area(const PixelWeights* weights) const {
  std::uint64_t sum = 0;
  for (int i = 0; i < count_; ++i) {
    std::uint64_t row = rows_[static_cast<std::size_t>(i)];
    if (weights == nullptr) {
      sum += static_cast<std::uint64_t>(std::popcount(row));
      continue;
    }
    for (; row != 0; row &= row - 1) {
      sum += weights->at(first_.x() + std::countr_zero(row), first_.y() + i);
    }
  }
  return sum;
}

PixelMask PaintedShape::mask() const {
  std::uint64_t columns = 0;
  for (int i = 0; i < count_; ++i) columns |= rows_[static_cast<std::size_t>(i)];
  const int width = static_cast<int>(std::bit_width(columns));
  PixelMask mask(Eigen::AlignedBox2i(first_, first_ + Eigen::Vector2i(width, count_)));
  for (int i = 0; i < count_; ++i) {
    for (std::uint64_t row = rows_[static_cast<std::size_t>(i)]; row != 0; row &= row - 1) {
      mask.put(first_.x() + std::countr_zero(row), first_.y() + i);
    }
  }
  return mask;
}

void DistantPainter::begin(const camera::Camera& camera, const Eigen::Vector3f& sun) {
  camera_ = camera;
  sun_ = sun;
  const int width = camera.intrinsics.width;
  const int height = camera.intrinsics.height;
  tiles_.clear();
  ++image_;
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  pixels_.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto tiles_along = [](int size) {
    return static_cast<std::size_t>((size + kTilePx - 1) / kTilePx);
  };
  tile_image_.assign(tiles_along(width) * tiles_along(height), 0);
}

DistantPainter::LinearTints DistantPainter::linear_tints(const skinning::Appearance& appearance) {
  LinearTints tints;
  tints[0].setOnes();
  for (std::size_t i = 1; i < tints.size(); ++i) {
    const skinning::Rgb& srgb = appearance.tint[i];
    tints[i] << linear_from_srgb(srgb[0]), linear_from_srgb(srgb[1]), linear_from_srgb(srgb[2]), 0;
  }
  return tints;
}

bool DistantPainter::paint(const Person& person, PaintedShape& shape) {
  if (person.mesh.triangles.empty() || !place_corners(person)) return false;
  Corner low = corners_[0];
  Corner high = low;
  for (const Corner& corner : corners_) {
    low = {std::min(low.x, corner.x), std::min(low.y, corner.y), 0};
    high = {std::max(high.x, corner.x), std::max(high.y, corner.y), 0};
  }
  const Eigen::Vector2i first(first_pixel(low.x), first_pixel(low.y));
  const Eigen::Vector2i end(last_pixel(high.x) + 1, last_pixel(high.y) + 1);
  const Eigen::Vector2i size = end - first;
  if (high.x > width_ * kSnap || high.y > height_ * kSnap ||
      size.maxCoeff() > PaintedShape::kMaxPx) {
    return false;
  }
  shape.begin(first, std::max(size.y(), 0));
  if (size.minCoeff() <= 0) return true;  // between the centers of pixels
  tints_ = linear_tints(person.appearance);
  clear_tiles({first, end});
  for (const DistantTriangle& triangle : person.mesh.triangles) fill(person, triangle, shape);
  return true;
}

/// False if some are not in front of the camera, or not in the image.
bool DistantPainter::place_corners(const Person& person) {
  constexpr float kFarPx = 1e5F;
  const DistantMesh& mesh = person.mesh;
  const Eigen::Matrix4f to_image = image_from_model(person.stance, camera_);
  const Eigen::Matrix3f turn = person.stance.turn.cast<float>();
  const Eigen::Vector4f up = to_image.col(2);
  std::array<Eigen::Matrix4f, skinning::kBoneCount> bones;
  for (std::size_t i = 0; i < mesh.bones.size(); ++i) {
    const skinning::BoneMatrix& bone = person.palette[mesh.bones[i]];
    Eigen::Matrix4f posed = Eigen::Matrix4f::Identity();
    posed.topRows<3>() = bone;
    bones[i].noalias() = to_image * posed;
    turns_[i].noalias() = turn.lazyProduct(bone.leftCols<3>());
  }
  corners_.resize(mesh.vertices.size());
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const DistantVertex& vertex = mesh.vertices[i];
    Eigen::Vector4f p = bones[vertex.bone] * vertex.rest;
    p += std::max(kAboveGround - p.w(), 0.0F) * up;
    if (p.z() < kNear) return false;
    const float per_z = 1 / p.z();
    const float x = p.x() * per_z;
    const float y = p.y() * per_z;
    if (std::min(x, y) < 0 || std::max(x, y) > kFarPx) return false;
    corners_[i] = {rounded(x * kSnap), rounded(y * kSnap), kNear * per_z};
  }
  return true;
}

void DistantPainter::clear_tiles(const Eigen::AlignedBox2i& pixels) {
  const int tiles_across = (width_ + kTilePx - 1) / kTilePx;
  for (int y = pixels.min().y() / kTilePx; y <= (pixels.max().y() - 1) / kTilePx; ++y) {
    for (int x = pixels.min().x() / kTilePx; x <= (pixels.max().x() - 1) / kTilePx; ++x) {
      std::uint32_t& shown =
          tile_image_[static_cast<std::size_t>(y) * static_cast<std::size_t>(tiles_across) +
                      static_cast<std::size_t>(x)];
      if (shown == image_) continue;
      shown = image_;
      const Eigen::Vector2i first(x * kTilePx, y * kTilePx);
      tiles_.push_back(first);
      const int columns = std::min(kTilePx, width_ - first.x());
      for (int row = first.y(); row < std::min(first.y() + kTilePx, height_); ++row) {
        std::fill_n(&pixels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                             static_cast<std::size_t>(first.x())],
                    columns, PaintedPixel{});
      }
    }
  }
}

/// A pixel of a triangle, at no depth.
PaintedPixel DistantPainter::color_of(const Person& person, const DistantTriangle& triangle) const {
  const auto tint = [&](skinning::Tint which) -> const Eigen::Array4f& {
    return tints_[static_cast<std::size_t>(which)];
  };
  Eigen::Array4f albedo = triangle.base;
  if (triangle.tint < tints_.size()) albedo *= tints_[triangle.tint];
  albedo += triangle.shades[0] * tint(skinning::Tint::top) +
            triangle.shades[1] * tint(skinning::Tint::bottom) +
            triangle.shades[2] * tint(skinning::Tint::hair) +
            triangle.shades[3] * tint(skinning::Tint::shoes);
  const Eigen::Vector3f normal = turns_[triangle.bone] * triangle.normal;
  const Eigen::Array3f light = person.light.received(normal) / kMaxLight;
  PaintedPixel pixel{0, person.id, 0, 0};
  for (unsigned i = 0; i < 3; ++i) {
    pixel.albedo |= root_bits(albedo[i], 255) << (8 * i);
    pixel.light |= root_bits(light[i], 1023) << (10 * i);
  }
  const float sun = std::clamp(normal.dot(sun_), 0.0F, 1.0F);
  pixel.albedo |= static_cast<std::uint32_t>(rounded(255 * sun)) << kSunBits;
  return pixel;
}

/// Pixels whose centers lie in the triangle, if it faces the camera.
void DistantPainter::fill(const Person& person, const DistantTriangle& triangle,
                          PaintedShape& shape) {
  const Corner& a = corners_[triangle.corners[0]];
  const Corner& b = corners_[triangle.corners[1]];
  const Corner& c = corners_[triangle.corners[2]];
  // Twice the area: y goes down, so that counter-clockwise triangles have a positive one.
  const int area = (b.y - a.y) * (c.x - a.x) - (b.x - a.x) * (c.y - a.y);
  if (area <= 0) return;
  const int left = first_pixel(std::min({a.x, b.x, c.x}));
  const int right = last_pixel(std::max({a.x, b.x, c.x}));
  const int top = first_pixel(std::min({a.y, b.y, c.y}));
  const int bottom = last_pixel(std::max({a.y, b.y, c.y}));
  if (left > right || top > bottom) return;
  const int x = left * kSnap + kHalf;
  const int y = top * kSnap + kHalf;
  Side to_a(b.x, b.y, c.x, c.y, x, y);
  Side to_b(c.x, c.y, a.x, a.y, x, y);
  Side to_c(a.x, a.y, b.x, b.y, x, y);
  const float per_area = 1 / static_cast<float>(area);
  const float b_depth = (b.depth - a.depth) * per_area;
  const float c_depth = (c.depth - a.depth) * per_area;
  PaintedPixel color{};
  for (int row = top; row <= bottom; ++row) {
    PaintedPixel* pixel =
        &pixels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(left)];
    int of_a = to_a.value;
    int of_b = to_b.value;
    int of_c = to_c.value;
    for (int column = left; column <= right; ++column, ++pixel) {
      if ((of_a | of_b | of_c) >= 0) {
        shape.put(column, row);
        const float depth =
            a.depth + static_cast<float>(of_b) * b_depth + static_cast<float>(of_c) * c_depth;
        if (depth > pixel->depth) {
          if (color.id == 0) color = color_of(person, triangle);
          color.depth = depth;
          *pixel = color;
        }
      }
      of_a += to_a.step_x;
      of_b += to_b.step_x;
      of_c += to_c.step_x;
    }
    to_a.value += to_a.step_y;
    to_b.value += to_b.step_y;
    to_c.value += to_c.step_y;
  }
}

}  // namespace throng::render
