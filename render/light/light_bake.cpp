#include "render/light/light_bake.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace throng::render {

namespace {

using Eigen::Array3f;
using Eigen::Vector3f;

/// Rays begin so far above a surface: more than layers of ground lie apart (ground_layers.cpp).
constexpr float kOffM = 0.02F;

/// Side of the cells that know which lamps may reach them.
constexpr float kLampCellM = 26;

/// Bounces of baked light.
constexpr int kBakedBounces = 2;

/// An irregular number, 0 to 1, of a path and what it is used for.
float scatter(std::uint32_t number, std::uint32_t use) {
  std::uint32_t h = number * 0x9E3779B1U ^ (use + 1) * 0x85EBCA77U;
  h ^= h >> 15U;
  h *= 0x2C1B3C6DU;
  h ^= h >> 12U;
  h *= 0x297A2D39U;
  h ^= h >> 15U;
  return static_cast<float>(h >> 8U) * (1.0F / 16777216.0F);
}

/// A direction about +z for a height and a turn, both 0 to 1.
Vector3f about_z(float height, float turn) {
  const float angle = 2 * std::numbers::pi_v<float> * turn;
  const float level = std::sqrt(std::max(1 - height * height, 0.0F));
  return {level * std::cos(angle), level * std::sin(angle), height};
}

/// Turns a direction about +z into one about a normal (Duff et al. 2017).
Vector3f about(const Vector3f& normal, const Vector3f& d) {
  const float sign = std::copysign(1.0F, normal.z());
  const float a = -1 / (sign + normal.z());
  const float b = normal.x() * normal.y() * a;
  const Vector3f u(1 + sign * normal.x() * normal.x() * a, sign * b, -sign * normal.x());
  const Vector3f v(b, sign + normal.y() * normal.y() * a, -normal.y());
  return d.x() * u + d.y() * v + d.z() * normal;
}

/// The turn of the i-th direction in a spiral, which spreads them evenly: all points use the same,
/// so that their errors are alike and their light has no grain.
float spiral_turn(int i) {
  constexpr double kGolden = 0.6180339887498949;
  const double turn = i * kGolden;
  return static_cast<float>(turn - std::floor(turn));
}

Array3f linear(const std::array<std::uint8_t, 3>& albedo) {
  return Array3f(albedo[0], albedo[1], albedo[2]) * (1.0F / 255);
}

}  // namespace

LightRays::LightRays(const RayScene& scene, const SkyLight& sky, const Daylight& day,
                     std::vector<Lamp> lamps)
    : scene_(scene),
      sky_(sky),
      to_sun_(day.direction.cast<float>()),
      sun_((day.sun / day.exposure).cast<float>()),
      soft_(day.soft),
      lamp_color_((day.lamps / day.exposure).cast<float>()),
      lamps_(std::move(lamps)) {
  if (lamps_.empty()) return;
  Eigen::AlignedBox2f bounds;
  for (const Lamp& lamp : lamps_) {
    const Eigen::Vector2f at = lamp.position.head<2>().cast<float>();
    const auto reach = static_cast<float>(lamp_reach_m(lamp));
    bounds.extend(Eigen::Vector2f(at.array() - reach));
    bounds.extend(Eigen::Vector2f(at.array() + reach));
  }
  cells_from_ = bounds.min();
  cells_ = (bounds.sizes().array() / kLampCellM).ceil().cast<int>().max(1);
  lamps_by_cell_.resize(static_cast<std::size_t>(cells_.x()) *
                        static_cast<std::size_t>(cells_.y()));
  for (std::size_t i = 0; i < lamps_.size(); ++i) {
    const Eigen::Vector2f at = lamps_[i].position.head<2>().cast<float>() - cells_from_;
    const auto reach = static_cast<float>(lamp_reach_m(lamps_[i]));
    const Eigen::Array2i low = ((at.array() - reach) / kLampCellM).floor().cast<int>().max(0);
    const Eigen::Array2i high =
        ((at.array() + reach) / kLampCellM).floor().cast<int>().min(cells_.array() - 1);
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) lamps_by_cell_[cell_index({x, y})].push_back(i);
    }
  }
}

std::size_t LightRays::cell_index(const Eigen::Vector2i& cell) const {
  return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(cells_.x()) +
         static_cast<std::size_t>(cell.x());
}

const std::vector<std::size_t>& LightRays::lamps_near(const Vector3f& point) const {
  static const std::vector<std::size_t> kNone;
  if (lamps_.empty()) return kNone;
  const Eigen::Vector2f at = (point.head<2>() - cells_from_) / kLampCellM;
  const Eigen::Vector2i cell = at.array().floor().cast<int>();
  if ((cell.array() < 0).any() || (cell.array() >= cells_.array()).any()) return kNone;
  return lamps_by_cell_[cell_index(cell)];
}

std::optional<LightRays::Beam> LightRays::beam(const Lamp& lamp, const Vector3f& point) const {
  const Vector3f to_lamp = lamp.position.cast<float>() - point;
  const float distance = to_lamp.norm();
  if (distance > static_cast<float>(lamp_reach_m(lamp)) || distance < 0.05F) return std::nullopt;
  if (lamp.away.cast<float>().dot(to_lamp.head<2>()) > 0.05F) return std::nullopt;
  const Vector3f direction = to_lamp / distance;
  const auto strength = static_cast<float>(lamp_strength(lamp, distance, direction.z()));
  if (strength <= 0) return std::nullopt;
  return Beam{direction, strength, lamp.color.cast<float>(), distance};
}

// One lamp, chosen in proportion to its light, stands for all.
Array3f LightRays::one_lamp(const Vector3f& point, const Vector3f& normal,
                            std::uint32_t number) const {
  const auto light_of = [&](std::size_t i) {
    const auto found = beam(lamps_[i], point);
    return found ? found->strength * std::max(found->direction.dot(normal), 0.0F) : 0.0F;
  };
  float sum = 0;
  for (const std::size_t i : lamps_near(point)) sum += light_of(i);
  if (sum <= 0) return Array3f::Zero();
  float left = sum * scatter(number, 11);
  for (const std::size_t i : lamps_near(point)) {
    left -= light_of(i);
    if (left > 0) continue;
    const auto chosen = beam(lamps_[i], point);
    if (!chosen || !scene_.is_free(point, chosen->direction, chosen->distance_m - 0.3F))
      return Array3f::Zero();
    return lamp_color_ * chosen->color * sum;
  }
  return Array3f::Zero();
}

Array3f LightRays::direct(const Vector3f& point, const Vector3f& normal,
                          std::uint32_t number) const {
  Array3f sum = one_lamp(point, normal, number);
  const float facing = normal.dot(to_sun_);
  if (facing > 0 && sun_.maxCoeff() > 0) {
    Vector3f to_sun = to_sun_;
    // A soft light comes from all around the zenith.
    if (soft_) to_sun = about_z(1 - 0.25F * scatter(number, 12), scatter(number, 13));
    if (scene_.is_free(point, to_sun, 1e6F)) sum += sun_ * facing;
  }
  return sum;
}

Array3f LightRays::radiance(const Vector3f& from, const Vector3f& direction, int bounces,
                            std::uint32_t number, bool& from_behind, float skipped_m) const {
  Array3f sum = Array3f::Zero();
  Array3f passed = Array3f::Ones();
  Vector3f origin = from;
  Vector3f way = direction;
  for (int bounce = 0;; ++bounce) {
    const std::optional<RayHit> hit = scene_.trace(origin, way, bounce == 0 ? skipped_m : 0);
    if (!hit) return sum + passed * sky_.radiance(way);
    if (bounce == 0) from_behind = hit->is_back;
    if (bounce == bounces) return sum;
    // Every second path goes on after its first bounce, and counts twice: what comes then is small.
    if (bounce == 1 && bounces == kBakedBounces) {
      if (number % 2 == 1) return sum;
      passed *= 2;
    }
    const Vector3f point = hit->position + kOffM * hit->normal;
    sum += passed * hit->surface->glow;
    passed *= linear(hit->surface->albedo);
    const std::uint32_t draw = number * 8 + static_cast<std::uint32_t>(bounce);
    sum += passed * direct(point, hit->normal, draw);
    way = about(hit->normal, about_z(std::sqrt(scatter(draw, 1)), scatter(draw, 2)));
    origin = point;
  }
}

std::optional<Array3f> LightRays::received(const Vector3f& point, const Vector3f& normal,
                                           int paths) const {
  // Not below the layers of the ground, on which walls and props stand; but banks and bridges are.
  constexpr float kSunkM = -0.02F;
  Vector3f origin = point + kOffM * normal;
  if (origin.z() > kSunkM) origin.z() = std::max(origin.z(), kOffM);
  Array3f sum = Array3f::Zero();
  int behind = 0;
  for (int i = 0; i < paths; ++i) {
    const float height = std::sqrt((static_cast<float>(i) + 0.5F) / static_cast<float>(paths));
    bool from_behind = false;
    sum += radiance(origin, about(normal, about_z(height, spiral_turn(i))), kBakedBounces,
                    static_cast<std::uint32_t>(i), from_behind);
    behind += from_behind ? 1 : 0;
  }
  if (2 * behind > paths) return std::nullopt;
  sum /= static_cast<float>(paths);
  for (const std::size_t i : lamps_near(point)) {
    const std::optional<Beam> lamp = beam(lamps_[i], origin);
    if (!lamp) continue;
    const float facing = lamp->direction.dot(normal);
    if (facing <= 0 || !scene_.is_free(origin, lamp->direction, lamp->distance_m - 0.3F)) continue;
    sum += lamp_color_ * lamp->color * (lamp->strength * facing);
  }
  return sum;
}

std::optional<LightField> LightRays::field(const Vector3f& point, int paths,
                                           float skipped_m) const {
  LightField field;
  int behind = 0;
  const auto add = [&](const Vector3f& direction, const Array3f& light, float even, float toward) {
    field.even += even * light;
    field.toward += toward * direction * light.matrix().transpose();
  };
  // The light on a surface with normal n from all sides: the mean of the radiance, and twice the
  // mean of radiance times direction (Ramamoorthi and Hanrahan 2001, their first two bands).
  const float weight = 1 / static_cast<float>(paths);
  for (int i = 0; i < paths; ++i) {
    const Vector3f direction =
        about_z(1 - (2 * static_cast<float>(i) + 1) * weight, spiral_turn(i));
    bool from_behind = false;
    const Array3f light = radiance(point, direction, kBakedBounces, static_cast<std::uint32_t>(i),
                                   from_behind, skipped_m);
    behind += from_behind ? 1 : 0;
    add(direction, light, weight, 2 * weight);
  }
  if (2 * behind > paths) return std::nullopt;
  for (const std::size_t i : lamps_near(point)) {
    const std::optional<Beam> lamp = beam(lamps_[i], point);
    if (!lamp || !scene_.is_free(point, lamp->direction, lamp->distance_m - 0.3F, skipped_m))
      continue;
    add(lamp->direction, lamp_color_ * lamp->color * lamp->strength, 0.25F, 0.5F);
  }
  return field;
}

}  // namespace throng::render
