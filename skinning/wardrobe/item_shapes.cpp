#include "skinning/wardrobe/item_shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "skinning/items.h"
#include "skinning/wardrobe/cloth.h"
#include "skinning/wardrobe/item_parts.h"
#include "skinning/wardrobe/led_shapes.h"
#include "skinning/wardrobe/trunk_outline.h"

namespace throng::skinning {

namespace items {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

int shape_of_level(int level) { return level < 3 ? level : level < 6 ? 3 : 4; }

// Straps would sink into the hulls of lower levels in places, and further levels are too coarse for
// them altogether.
constexpr int kStrapsUpTo = 1;
float strap_lift_m(int shape) { return shape == 0 ? 0.009F : 0.01F; }

// Points of a strap over the trunk where rays from `origin` leave it.
void add_outline(const TrunkOutline& trunk, const Vector3f& origin, const Vector3f& direction,
                 float lift_m, std::vector<StrapPoint>& path) {
  const auto hit = trunk.outermost(origin, direction);
  if (!hit) return;
  path.push_back({hit->position + lift_m * direction, direction, hit->weights});
}

void add_backpack(Shape& shape, const Site& site) {
  const TrunkOutline trunk(*site.person);
  const Vector3f& chest = site.joint(Bone::chest);
  const Vector3f& shoulder = site.joint(Bone::left_upper_arm);
  const float s = std::clamp(site.scale, 0.72F, 1.1F);
  // Coarse shapes have no pocket: they end as far behind the pack as before the pocket.
  const float thick = site.shape < 3 ? 1 : 1.09F;
  const Vector3f half(thick * 0.085F * s, 0.15F * s, 0.22F * s);
  const float middle = shoulder.z() - 0.03F * s - half.z();
  float back = chest.x();
  for (const float height : {-0.6F, 0.0F, 0.6F}) {
    const Vector3f origin(chest.x(), 0, middle + height * half.z());
    const auto hit = trunk.outermost(origin, -Vector3f::UnitX());
    if (hit) back = std::min(back, hit->position.x());
  }
  const Vector3f center(back - 0.8F * half.x(), 0, middle);
  const int columns = site.of_shape({12, 8, 8, 4, 4});
  const int rings = site.of_shape({8, 6, 4, 4, 3});
  add_box(shape, {center, half, Bone::chest, rings, columns});
  if (site.shape < 3) {  // a pocket
    add_box(shape, {center - Vector3f(0.8F * half.x(), 0, 0.35F * half.z()),
                    Vector3f(0.5F * half.x(), 0.72F * half.y(), 0.45F * half.z()), Bone::chest,
                    site.of_shape({6, 6, 3, 0, 0}), site.of_shape({8, 8, 4, 0, 0})});
  }
  if (site.shape > kStrapsUpTo) return;
  const int steps = site.finer(9);
  for (const float side : {1.0F, -1.0F}) {
    const float y = side * 0.52F * shoulder.y();
    std::vector<StrapPoint> path;
    // Over the shoulder from behind and down the front ...
    const Vector3f over(chest.x(), y, shoulder.z() - 0.09F * s);
    for (int i = 0; i <= steps; ++i) {
      const float turn =
          (150 - 185 * static_cast<float>(i) / static_cast<float>(steps)) * kPi / 180;
      add_outline(trunk, over, {std::cos(turn), 0, std::sin(turn)}, strap_lift_m(site.shape), path);
    }
    // ... then below the arm to the lower corner of the pack.
    for (int i = 1; i <= steps; ++i) {
      const float share = static_cast<float>(i) / static_cast<float>(steps);
      const float turn = side * (48 + 92 * share) * kPi / 180;
      const Vector3f under(chest.x(), 0, shoulder.z() - (0.17F + 0.17F * share) * s);
      add_outline(trunk, under, {std::cos(turn), std::sin(turn), 0}, strap_lift_m(site.shape),
                  path);
    }
    if (path.size() > 2) add_strap(shape, path, 0.045F * s, false);
  }
}

void add_shoulder_bag(Shape& shape, const Site& site) {
  const TrunkOutline trunk(*site.person);
  const float s = std::clamp(site.scale, 0.75F, 1.1F);
  const Vector3f& left_shoulder = site.joint(Bone::left_upper_arm);
  const Vector3f& right_hip = site.joint(Bone::right_thigh);
  const Vector3f high(site.joint(Bone::chest).x(), 0.6F * left_shoulder.y(), left_shoulder.z());
  const Vector3f low(site.joint(Bone::hips).x(), 1.5F * right_hip.y(), right_hip.z() + 0.06F * s);
  const Vector3f up = (high - low).normalized();
  const Vector3f origin = 0.5F * (high + low);
  const int steps = 3 * site.finer(8);
  std::vector<StrapPoint> path;
  for (int i = 0; i < steps; ++i) {
    const float turn = 2 * kPi * static_cast<float>(i) / static_cast<float>(steps);
    add_outline(trunk, origin, std::cos(turn) * up + std::sin(turn) * Vector3f::UnitX(),
                strap_lift_m(site.shape), path);
  }
  if (site.shape <= kStrapsUpTo && path.size() > 4) add_strap(shape, path, 0.035F * s, true);
  // The bag lies behind the hip, where the arm does not swing through it.
  const Vector3f half(0.13F * s, 0.05F * s, 0.11F * s);
  const float turn = -125 * kPi / 180;
  const Vector3f out(std::cos(turn), std::sin(turn), 0);
  const auto hit = trunk.outermost({low.x(), 0, low.z()}, out);
  const Vector3f at = hit ? hit->position : low;
  const int columns = site.of_shape({12, 8, 4, 4, 4});
  add_box(shape, {at + 0.03F * out - Vector3f(0, 0, 0.5F * half.z()), half, Bone::hips,
                  site.of_shape({6, 6, 4, 4, 3}), columns});
}

void add_handbag(Shape& shape, const Site& site) {
  const float s = std::clamp(site.scale, 0.75F, 1.1F);
  const Vector3f& elbow = site.joint(Bone::right_forearm);
  const Vector3f& wrist = site.joint(Bone::right_hand);
  const Vector3f palm = wrist + 0.085F * s * (wrist - elbow).normalized();
  const Vector3f half(0.15F * s, 0.055F * s, 0.105F * s);
  const float handle = 0.13F * s;
  const Vector3f center = palm - Vector3f(0, 0.015F * s, handle + half.z());
  const int columns = site.of_shape({12, 8, 4, 4, 4});
  add_box(shape, {center, half, Bone::right_hand, site.of_shape({6, 6, 4, 4, 3}), columns});
  if (site.shape > 2) return;
  const int steps = site.finer(10);
  const BoneWeights weights = all_on(Bone::right_hand);
  std::vector<StrapPoint> path;
  for (int i = 0; i <= steps; ++i) {
    const float turn = kPi * static_cast<float>(i) / static_cast<float>(steps);
    const Vector3f out(std::cos(turn), 0, std::sin(turn));
    path.push_back({center + Vector3f(0.6F * half.x() * out.x(), 0,
                                      0.9F * half.z() + (handle + 0.1F * half.z()) * out.z()),
                    out, weights});
  }
  add_strap(shape, path, 0.022F * s, false);
}

void add_umbrella(Shape& shape, const Site& site) {
  const float s = std::clamp(site.scale, 0.7F, 1.1F);
  const Vector3f grip = find_grips(Carry::umbrella, site.person->joints).front().point;
  const float crown = site.person->stature_m;
  const Vector3f apex(0.3F * grip.x(), 0.55F * grip.y(), crown + 0.24F * s);
  const Vector3f axis = (apex - grip).normalized();
  if (site.shape < 3) {
    add_rod(shape, grip - 0.12F * s * axis, apex, 0.009F, Bone::chest);
    add_rod(shape, grip - 0.16F * s * axis, grip + 0.01F * axis, 0.016F, Bone::chest);
  }
  const Vector3f u = axis.cross(Vector3f::UnitY()).normalized();
  const Vector3f v = axis.cross(u);
  const int panels = 8;
  const int rings = site.of_shape({4, 3, 2, 1, 1});
  constexpr float kSpan = 62 * kPi / 180;  // of the dome, from its axis
  const float radius = 0.52F * s / std::sin(kSpan);
  constexpr float kFlatness = 0.72F;
  const BoneWeights weights = all_on(Bone::chest);
  for (const bool outside : {true, false}) {
    std::vector<std::uint32_t> place;
    for (int ring = 0; ring <= rings; ++ring) {
      const float open = kSpan * static_cast<float>(ring) / static_cast<float>(rings);
      for (int panel = 0; panel <= panels; ++panel) {
        const float turn = 2 * kPi * static_cast<float>(panel) / static_cast<float>(panels);
        const Vector3f side = std::cos(turn) * u + std::sin(turn) * v;
        const Vector3f out = std::sin(open) * side + std::cos(open) * axis;
        const Vector3f at =
            apex + radius * (std::sin(open) * side - kFlatness * (1 - std::cos(open)) * axis);
        const Vector2f uv =
            kPlain + 0.2F * std::sin(open) * Vector2f(std::cos(turn), std::sin(turn));
        place.push_back(shape.add(at, outside ? out : Vector3f(-out), uv, weights));
      }
    }
    for (int ring = 0; ring < rings; ++ring) {
      for (int panel = 0; panel < panels; ++panel) {
        const auto at = [&](int down, int along) {
          return place[static_cast<std::size_t>(ring + down) * (panels + 1) + panel + along];
        };
        const std::uint32_t a = at(0, 0);
        const std::uint32_t b = at(0, 1);
        const std::uint32_t c = at(1, 0);
        const std::uint32_t d = at(1, 1);
        if (ring > 0) outside ? shape.triangle(a, c, b) : shape.triangle(a, b, c);
        outside ? shape.triangle(b, c, d) : shape.triangle(b, d, c);
      }
    }
  }
}

std::optional<Surface> shape_item(Carry carry, const DressedPerson& person, int level) {
  constexpr float kUsualStatureM = 1.7F;
  const Site site{&person, person.stature_m / kUsualStatureM, shape_of_level(level)};
  Shape shape;
  switch (carry) {
    case Carry::nothing:
      return std::nullopt;
    case Carry::backpack:
      add_backpack(shape, site);
      break;
    case Carry::shoulder_bag:
      add_shoulder_bag(shape, site);
      break;
    case Carry::handbag:
      add_handbag(shape, site);
      break;
    case Carry::umbrella:
      add_umbrella(shape, site);
      break;
    case Carry::walking_stick:
      add_walking_stick(shape, site);
      break;
    case Carry::suitcase:
      add_suitcase(shape, site);
      break;
    case Carry::pram:
      add_pram(shape, site);
      break;
    case Carry::bicycle:
      add_bicycle(shape, site);
      break;
  }
  return shape.take();
}

}  // namespace

}  // namespace items

namespace {

// Numbers that look random, for the weave of cloth.
double grain(int x, int y) {
  auto bits =
      static_cast<std::uint32_t>(x) * 0x9E3779B1U + static_cast<std::uint32_t>(y) * 0x85EBCA77U;
  bits = (bits ^ (bits >> 15U)) * 0x2C1B3C6DU;
  return static_cast<double>((bits ^ (bits >> 12U)) & 0xFFFFU) / 65535 - 0.5;
}

double shade_at(double u, double v, int x, int y) {
  const double weave = 0.07 * grain(x, y);
  if (u >= 0.5) return (v < 0.5 ? 1.0 : v < 0.84 ? 0.42 : 0.06) + (v < 0.84 ? weave : 0);
  const double across = 2 * u;
  const auto near = [](double value, double line, double width) {
    return std::abs(value - line) < width;
  };
  // A zip around the top, the border of a pocket, and darkening toward the edges.
  double shade = 1 - 0.25 * std::pow(std::abs(2 * across - 1), 6.0) - 0.2 * v * v;
  if (near(v, 0.22, 0.012) && across > 0.1 && across < 0.9) shade *= 0.55;
  const bool beside = across > 0.18 && across < 0.82;
  if ((near(v, 0.52, 0.01) && beside) ||
      ((near(across, 0.18, 0.012) || near(across, 0.82, 0.012)) && v > 0.52 && v < 0.92)) {
    shade *= 0.65;
  }
  return shade + weave;
}

}  // namespace

Image item_image(int size) {
  Image image(size, size);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double shade = shade_at((x + 0.5) / size, (y + 0.5) / size, x, y);
      std::uint8_t* pixel = image.pixel(x, y);
      pixel[0] = pixel[1] = pixel[2] =
          static_cast<std::uint8_t>(std::lround(std::clamp(kMedianShade * shade, 0.0, 255.0)));
      pixel[3] = 255;
    }
  }
  return image;
}

std::optional<Surface> make_item(Carry carry, const DressedPerson& person, int level) {
  return items::shape_item(carry, person, level);
}

}  // namespace throng::skinning
