#include "skinning/wardrobe/item_shapes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "skinning/items.h"
#include "skinning/wardrobe/cloth.h"
#include "skinning/wardrobe/trunk_outline.h"

namespace throng::skinning {

namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr float kPi = std::numbers::pi_v<float>;

// Places on the image: cloth with seams and a pocket on the left half, plain cloth on the upper
// right, dark straps and sticks on the lower right quarter.
constexpr float kHalf = 0.5F;
const Vector2f kPlain(0.75F, 0.25F);
const Vector2f kDark(0.75F, 0.75F);

BoneWeights all_on(Bone bone) {
  BoneWeights weights{};
  weights[index_from(bone)] = 1;
  return weights;
}

// Collects vertices and triangles; normals are given or smooth.
class Shape {
 public:
  std::uint32_t add(const Vector3f& position, const Vector3f& normal, const Vector2f& uv,
                    const BoneWeights& weights) {
    surface_.source.push_back(static_cast<std::uint32_t>(surface_.source.size()));
    surface_.fitted.push_back(position);
    surface_.positions.push_back(position);
    surface_.normals.push_back(normal.normalized());
    surface_.uvs.push_back(uv);
    surface_.weights.push_back(weights);
    return surface_.source.back();
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    surface_.indices.insert(surface_.indices.end(), {a, b, c});
  }
  void quad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  Surface take() {
    surface_.texture = kItemTexture;
    surface_.tint = Tint::item;
    return std::move(surface_);
  }

 private:
  Surface surface_;
};

// A box with rounded edges, its axes along the model's: a superellipsoid.
void add_box(Shape& shape, const Vector3f& center, const Vector3f& half, Bone bone, int rings,
             int columns) {
  constexpr float kSquareness = 0.32F;  // exponent: 1 is an ellipsoid, 0 a box
  const auto power = [](float value) {
    return std::copysign(std::pow(std::abs(value), kSquareness), value);
  };
  const BoneWeights weights = all_on(bone);
  std::vector<std::uint32_t> place;
  // Boxes of few columns have their corners where the rounded edges are: between the sides and the
  // corners of the box that they round, so that both are missed by as much.
  const float corner = power(std::cos(kPi / static_cast<float>(columns)));
  const float wide = 1 / std::sqrt(corner);
  for (int ring = 0; ring <= rings; ++ring) {
    const float up = kPi * (static_cast<float>(ring) / static_cast<float>(rings) - 0.5F);
    for (int column = 0; column <= columns; ++column) {
      const float turn =
          2 * kPi * (static_cast<float>(column) + 0.5F) / static_cast<float>(columns);
      const float flat = wide * power(std::cos(up));
      const Vector3f unit(flat * power(std::cos(turn)), flat * power(std::sin(turn)),
                          power(std::sin(up)));
      const Vector3f normal(std::cos(up) * std::cos(turn) / half.x(),
                            std::cos(up) * std::sin(turn) / half.y(), std::sin(up) / half.z());
      const Vector2f uv(kHalf * (0.06F + 0.44F * (1 + unit.y())), 0.5F - 0.44F * unit.z());
      place.push_back(shape.add(center + half.cwiseProduct(unit), normal, uv, weights));
    }
  }
  const auto at = [&](int ring, int column) {
    return place[static_cast<std::size_t>(ring) * (columns + 1) + column];
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int column = 0; column < columns; ++column) {
      if (ring > 0) shape.triangle(at(ring, column), at(ring, column + 1), at(ring + 1, column));
      if (ring + 1 < rings) {
        shape.triangle(at(ring, column + 1), at(ring + 1, column + 1), at(ring + 1, column));
      }
    }
  }
}

// A flat band along a path; `out` points away from what it lies on.
struct StrapPoint {
  Vector3f position;
  Vector3f out;
  BoneWeights weights;
};

void add_strap(Shape& shape, const std::vector<StrapPoint>& path, float width_m, bool closed) {
  std::vector<std::array<std::uint32_t, 4>> rows;  // outside left, right; inside left, right
  const std::size_t count = path.size();
  for (std::size_t i = 0; i < count; ++i) {
    const StrapPoint& here = path[i];
    const StrapPoint& before = path[i > 0 ? i - 1 : closed ? count - 1 : 0];
    const StrapPoint& after = path[i + 1 < count ? i + 1 : closed ? 0 : count - 1];
    const Vector3f along = (after.position - before.position).normalized();
    const Vector3f across = 0.5F * width_m * along.cross(here.out).normalized();
    rows.push_back({shape.add(here.position + across, here.out, kDark, here.weights),
                    shape.add(here.position - across, here.out, kDark, here.weights),
                    shape.add(here.position + across, -here.out, kDark, here.weights),
                    shape.add(here.position - across, -here.out, kDark, here.weights)});
  }
  for (std::size_t i = 0; i + 1 < count + (closed ? 1 : 0); ++i) {
    const auto& a = rows[i];
    const auto& b = rows[(i + 1) % count];
    shape.quad(a[0], b[0], b[1], a[1]);
    shape.quad(a[2], a[3], b[3], b[2]);
  }
}

// The first three levels of detail have shapes of their own, then several share one.
constexpr int kItemShapes = 5;
int shape_of_level(int level) { return level < 3 ? level : level < 6 ? 3 : 4; }

// Frame of reference of an item.
struct Site {
  const DressedPerson* person;
  float scale;  // 1 for a person of 1.7 m
  int shape;    // 0 is the finest

  const Vector3f& joint(Bone bone) const { return person->joints[index_from(bone)]; }
  int of_shape(const std::array<int, kItemShapes>& numbers) const {
    return numbers[static_cast<std::size_t>(shape)];
  }
  int finer(int finest) const { return std::max(2, finest >> shape); }
};

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
  add_box(shape, center, half, Bone::chest, rings, columns);
  if (site.shape < 3) {  // a pocket
    add_box(shape, center - Vector3f(0.8F * half.x(), 0, 0.35F * half.z()),
            Vector3f(0.5F * half.x(), 0.72F * half.y(), 0.45F * half.z()), Bone::chest,
            site.of_shape({6, 6, 3, 0, 0}), site.of_shape({8, 8, 4, 0, 0}));
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
  add_box(shape, at + 0.03F * out - Vector3f(0, 0, 0.5F * half.z()), half, Bone::hips,
          site.of_shape({6, 6, 4, 4, 3}), columns);
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
  add_box(shape, center, half, Bone::right_hand, site.of_shape({6, 6, 4, 4, 3}), columns);
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

void add_stick(Shape& shape, const Vector3f& from, const Vector3f& to, float radius_m, Bone bone) {
  constexpr int kSides = 4;
  const Vector3f axis = (to - from).normalized();
  const Vector3f u = axis.cross(Vector3f::UnitY()).normalized();
  const Vector3f v = axis.cross(u);
  const BoneWeights weights = all_on(bone);
  std::array<std::array<std::uint32_t, 2>, kSides> ends{};
  for (int i = 0; i < kSides; ++i) {
    const float turn = 2 * kPi * static_cast<float>(i) / kSides;
    const Vector3f out = std::cos(turn) * u + std::sin(turn) * v;
    ends[static_cast<std::size_t>(i)] = {shape.add(from + radius_m * out, out, kDark, weights),
                                         shape.add(to + radius_m * out, out, kDark, weights)};
  }
  for (std::size_t i = 0; i < kSides; ++i) {
    const auto& a = ends[i];
    const auto& b = ends[(i + 1) % kSides];
    shape.quad(a[0], b[0], b[1], a[1]);
  }
}

void add_umbrella(Shape& shape, const Site& site) {
  const float s = std::clamp(site.scale, 0.7F, 1.1F);
  const Vector3f grip = find_grip(Carry::umbrella, site.person->joints)->point;
  const float crown = site.person->stature_m;
  const Vector3f apex(0.3F * grip.x(), 0.55F * grip.y(), crown + 0.24F * s);
  const Vector3f axis = (apex - grip).normalized();
  if (site.shape < 3) {
    add_stick(shape, grip - 0.12F * s * axis, apex, 0.009F, Bone::chest);
    add_stick(shape, grip - 0.16F * s * axis, grip + 0.01F * axis, 0.016F, Bone::chest);
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

// Numbers that look random, for the weave of cloth.
double grain(int x, int y) {
  auto bits =
      static_cast<std::uint32_t>(x) * 0x9E3779B1U + static_cast<std::uint32_t>(y) * 0x85EBCA77U;
  bits = (bits ^ (bits >> 15U)) * 0x2C1B3C6DU;
  return static_cast<double>((bits ^ (bits >> 12U)) & 0xFFFFU) / 65535 - 0.5;
}

double shade_at(double u, double v, int x, int y) {
  const double weave = 0.07 * grain(x, y);
  if (u >= 0.5) return (v < 0.5 ? 1.0 : 0.42) + weave;
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
  }
  return shape.take();
}

}  // namespace throng::skinning
