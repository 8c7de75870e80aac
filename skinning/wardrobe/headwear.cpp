#include "skinning/wardrobe/headwear.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "base/geometry/smoothstep.h"
#include "skinning/skeleton.h"
#include "skinning/wardrobe/cloth.h"
#include "skinning/wardrobe/pattern.h"

namespace throng::skinning {

namespace {

constexpr float kFullTurn = 2 * std::numbers::pi_v<float>;

// Measures of the unmorphed body (m): the middle of the skull, and the height range of hair on the
// face and the scalp.
const Eigen::Vector3f kSkull(0.057F, 0, 0.745F);
constexpr float kHairTop = 0.86F;
constexpr float kHairBottom = 0.58F;

bool is_hair(std::string_view name) {
  return name == kBeard || name == kMoustache || name == kCropped || name == kReceding;
}

// Vertices of the skin that move with the head, or for `neck` those around the neck.
std::vector<std::uint32_t> vertices_near(const MakeHuman& makehuman, bool neck) {
  std::vector<bool> taken(makehuman.base_positions().size(), false);
  std::vector<std::uint32_t> vertices;
  for (const Quad& quad : makehuman.skin()) {
    for (const std::uint32_t vertex : quad.vertex) {
      const Eigen::Vector3f& point = makehuman.base_positions()[vertex];
      const bool wanted =
          neck ? point.z() > 0.54F && point.z() < 0.63F && std::abs(point.y()) < 0.1F &&
                     point.x() < 0.09F
               : makehuman.weights()[vertex][index_from(Bone::head)] > 0.5F && point.z() > 0.6F;
      if (!wanted || taken[vertex]) continue;
      taken[vertex] = true;
      vertices.push_back(vertex);
    }
  }
  return vertices;
}

// A grid of points that are attached to the vertex below each.
class Sheet {
 public:
  Sheet(const MakeHuman& makehuman, std::string_view name, bool on_neck)
      : makehuman_(&makehuman), below_(vertices_near(makehuman, on_neck)) {
    proxy_.name = std::string(name);
    proxy_.hides.assign(makehuman.base_positions().size(), false);
  }

  const std::vector<std::uint32_t>& below() const { return below_; }

  /// Adds a grid; `point_at` and the texture's v are by share of a row and column. Closed grids
  /// join their last column to the first.
  void add_grid(int rows, int columns, bool closed, std::array<float, 2> v_range,
                const std::function<Eigen::Vector3f(float, float)>& point_at) {
    const auto first = static_cast<std::uint32_t>(proxy_.positions.size());
    const auto first_uv = static_cast<std::uint32_t>(proxy_.uvs.size());
    const int width = closed ? columns : columns + 1;
    for (int row = 0; row <= rows; ++row) {
      const float down = static_cast<float>(row) / static_cast<float>(rows);
      for (int column = 0; column <= columns; ++column) {
        const float across = static_cast<float>(column) / static_cast<float>(columns);
        proxy_.uvs.emplace_back(across, std::lerp(v_range[0], v_range[1], down));
        if (column < width) attach(point_at(down, across));
      }
    }
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        Quad quad{};
        constexpr std::array<std::array<int, 2>, 4> kCorners = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
        for (std::size_t corner = 0; corner < 4; ++corner) {
          const int r = row + kCorners[corner][0];
          const int c = column + kCorners[corner][1];
          quad.vertex[corner] = first + static_cast<std::uint32_t>(r * width + c % width);
          quad.uv[corner] = first_uv + static_cast<std::uint32_t>(r * (columns + 1) + c);
        }
        proxy_.quads.push_back(quad);
      }
    }
  }

  Proxy take() { return std::move(proxy_); }

 private:
  void attach(const Eigen::Vector3f& point) {
    const std::vector<Eigen::Vector3f>& body = makehuman_->base_positions();
    std::uint32_t nearest = below_.front();
    for (const std::uint32_t vertex : below_) {
      if ((body[vertex] - point).squaredNorm() < (body[nearest] - point).squaredNorm()) {
        nearest = vertex;
      }
    }
    proxy_.positions.push_back(point);
    proxy_.anchors.push_back({{nearest, nearest, nearest}, {1, 0, 0}, point - body[nearest]});
    proxy_.weights.push_back(makehuman_->weights()[nearest]);
  }

  const MakeHuman* makehuman_;
  std::vector<std::uint32_t> below_;
  Proxy proxy_;
};

// How far the head reaches around a direction from the middle of the skull: ears and nose make wide
// bumps, as under cloth.
float reach_of_head(const MakeHuman& makehuman, std::span<const std::uint32_t> head,
                    const Eigen::Vector3f& direction) {
  constexpr float kCone = 0.96F;  // cosine
  float reach = 0.075F;
  for (const std::uint32_t vertex : head) {
    const Eigen::Vector3f from_middle = makehuman.base_positions()[vertex] - kSkull;
    const float along = from_middle.dot(direction);
    if (along > kCone * from_middle.norm()) reach = std::max(reach, along);
  }
  return reach;
}

// A dome over the head: from the pole down to the rim, whose directions `rim_at` gives by turn.
void add_dome(const MakeHuman& makehuman, Sheet& sheet, const Eigen::Vector3f& pole, float gap_m,
              const std::function<Eigen::Vector3f(float)>& rim_at) {
  constexpr int kRows = 7;
  constexpr int kColumns = 22;
  constexpr float kPoleShare = 0.04F;
  sheet.add_grid(kRows, kColumns, true, {0, 0.75F}, [&](float down, float across) {
    const Eigen::Vector3f rim = rim_at(across * kFullTurn).normalized();
    const float share = std::max(down, kPoleShare);
    const float angle = std::acos(std::clamp(pole.dot(rim), -1.0F, 1.0F));
    const Eigen::Vector3f aside = (rim - pole.dot(rim) * pole).normalized();
    const Eigen::Vector3f direction =
        std::cos(share * angle) * pole + std::sin(share * angle) * aside;
    return Eigen::Vector3f(kSkull + (reach_of_head(makehuman, sheet.below(), direction) + gap_m) *
                                        direction);
  });
}

// From the crown to a level rim that is higher in front.
Eigen::Vector3f hat_rim(float turn) {
  constexpr float kTilt = 0.32F;
  return {0.097F * std::cos(turn), 0.078F * std::sin(turn),
          0.004F + 0.097F * kTilt * std::cos(turn)};
}

void add_peak(const MakeHuman& makehuman, Sheet& sheet, float gap_m) {
  constexpr int kColumns = 10;
  constexpr float kHalfTurn = 0.95F;
  constexpr float kLengthM = 0.075F;
  sheet.add_grid(1, kColumns, false, {0.8F, 1}, [&](float out, float across) {
    const float turn = kHalfTurn * (2 * across - 1);
    const Eigen::Vector3f rim = hat_rim(turn).normalized();
    const float reach = reach_of_head(makehuman, sheet.below(), rim) + gap_m;
    const float length = out * kLengthM * std::cos(1.5F * turn);
    const float side = rim.y() * reach;
    return Eigen::Vector3f(kSkull + reach * rim +
                           Eigen::Vector3f(length, 0, -0.22F * length - out * 2.2F * side * side));
  });
}

// Around the face, from the back of the head; below the chin the cloth closes.
void add_headscarf(const MakeHuman& makehuman, Sheet& sheet) {
  const Eigen::Vector3f back(-0.94F, 0, 0.34F);
  const Eigen::Vector3f up(0.34F, 0, 0.94F);
  add_dome(makehuman, sheet, back, 0.011F, [&](float turn) {
    const float height = std::cos(turn);
    const float open = height > 0 ? 0.78F : 0.98F;  // the forehead is nearer than the chin
    return Eigen::Vector3f(-0.55F * back + open * height * up +
                           0.74F * std::sin(turn) * Eigen::Vector3f::UnitY());
  });
}

// A ring of cloth around the neck, higher behind.
void add_neckwear(Sheet& sheet) {
  constexpr float kThickM = 0.022F;
  constexpr float kHighM = 0.036F;
  const Eigen::Vector3f middle(0.016F, 0, 0.578F);
  sheet.add_grid(8, 20, true, {0, 1}, [&](float around, float across) {
    const float turn = across * kFullTurn;
    const float profile = -around * kFullTurn;
    const float wave = 1 + 0.12F * std::sin(3 * turn + 1);
    const float radius = 1 + kThickM / 0.07F * wave * std::cos(profile);
    return Eigen::Vector3f(
        middle + Eigen::Vector3f(0.073F * radius * std::cos(turn), 0.078F * radius * std::sin(turn),
                                 kHighM * std::sin(profile) - 0.02F * std::cos(turn)));
  });
}

// How dense hair is at a point of the unmorphed head, from 0 to 1.
float density_of_hair(std::string_view name, const Eigen::Vector3f& point) {
  const float side = std::abs(point.y());
  const auto above = [](float value, float edge) {
    return geometry::smoothstep(-0.006F, 0.006F, value - edge);
  };
  const float moustache = above(point.x(), 0.138F) * above(point.z(), 0.669F) *
                          above(0.688F - 0.25F * side, point.z()) * above(0.036F, side);
  if (name == kMoustache) return moustache;
  if (name == kBeard) {
    const float cheek =
        std::lerp(0.725F, 0.652F, std::clamp((point.x() - 0.07F) / 0.06F, 0.0F, 1.0F));
    const float jaw = above(cheek, point.z()) * above(point.x(), 0.062F) * above(point.z(), 0.592F);
    const bool on_lips = point.x() > 0.14F && side < 0.031F && point.z() > 0.641F;
    return std::max(moustache, on_lips ? 0.0F : jaw);
  }
  const bool on_ear = side > 0.0755F && point.z() < 0.757F && point.x() > 0.015F;
  if (on_ear) return 0;
  // The hairline: nape, behind the ears, sideburns, temples, forehead.
  const float line = point.x() < 0.03F   ? 0.655F
                     : point.x() < 0.06F ? std::lerp(0.655F, 0.71F, (point.x() - 0.03F) / 0.03F)
                     : point.x() < 0.09F
                         ? std::lerp(0.71F, 0.765F, (point.x() - 0.06F) / 0.03F)
                         : std::lerp(0.765F, 0.812F, std::min(1.0F, (point.x() - 0.09F) / 0.04F));
  const float below_line = above(point.z(), line);
  if (name == kCropped) return below_line;
  const float crown = 0.788F - 0.35F * std::max(0.0F, point.x() - 0.01F);
  return below_line * above(crown, point.z());
}

// The skin of the head, a little outward.
Proxy make_hair(const MakeHuman& makehuman, std::string_view name) {
  constexpr float kThickM = 0.0025F;
  constexpr float kMin = 0.02F;
  const std::vector<Eigen::Vector3f>& body = makehuman.base_positions();
  std::map<std::uint32_t, Eigen::Vector3f> normals;
  std::vector<Quad> quads;
  for (const Quad& quad : makehuman.skin()) {
    const auto& corner = quad.vertex;
    const Eigen::Vector3f middle =
        0.25F * (body[corner[0]] + body[corner[1]] + body[corner[2]] + body[corner[3]]);
    const bool on_head = makehuman.weights()[corner[0]][index_from(Bone::head)] > 0.3F;
    if (!on_head || middle.z() < kHairBottom) continue;
    const Eigen::Vector3f normal =
        (body[corner[2]] - body[corner[0]]).cross(body[corner[3]] - body[corner[1]]).normalized();
    // Not what lies inside the mouth and the nose.
    const Eigen::Vector3f inside(0.07F, 0, std::clamp(middle.z(), 0.655F, 0.76F));
    if (normal.dot((middle - inside).normalized()) < 0.05F) continue;
    const bool any = std::any_of(corner.begin(), corner.end(), [&](std::uint32_t vertex) {
      return density_of_hair(name, body[vertex]) > kMin;
    });
    if (!any) continue;
    quads.push_back(quad);
    for (const std::uint32_t vertex : corner) {
      normals.try_emplace(vertex, Eigen::Vector3f::Zero()).first->second += normal;
    }
  }
  Proxy proxy;
  proxy.name = std::string(name);
  proxy.hides.assign(body.size(), false);
  std::map<std::uint32_t, std::uint32_t> place;
  for (const auto& [vertex, normal] : normals) {
    place[vertex] = static_cast<std::uint32_t>(proxy.positions.size());
    const Eigen::Vector3f offset = kThickM * normal.normalized();
    proxy.positions.push_back(body[vertex] + offset);
    proxy.anchors.push_back({{vertex, vertex, vertex}, {1, 0, 0}, offset});
    proxy.weights.push_back(makehuman.weights()[vertex]);
  }
  for (const Quad& quad : quads) {
    Quad own{};
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const Eigen::Vector3f& point = body[quad.vertex[corner]];
      float turn = std::atan2(point.y(), point.x() - kSkull.x()) / kFullTurn + 0.5F;
      own.vertex[corner] = place.at(quad.vertex[corner]);
      own.uv[corner] = static_cast<std::uint32_t>(proxy.uvs.size());
      if (corner > 0 && turn - proxy.uvs[own.uv[0]].x() > 0.5F) turn = 0;
      if (corner > 0 && proxy.uvs[own.uv[0]].x() - turn > 0.5F) turn = 1;
      proxy.uvs.emplace_back(turn, (kHairTop - point.z()) / (kHairTop - kHairBottom));
    }
    proxy.quads.push_back(own);
  }
  return proxy;
}

double shade_of_knit(double across, double down) {
  const double ribs = std::sin(2 * std::numbers::pi * 44 * across);
  const bool on_cuff = down > 0.52;
  const double edge = std::abs(down - 0.52) < 0.02 ? -0.2 : 0;
  return 1 + (on_cuff ? 0.18 : 0.1) * ribs + edge;
}

double shade_of_cap(double across, double down) {
  if (down > 0.78) return down < 0.83 ? 0.75 : 0.94;  // the peak and its seam
  const double panel = 6 * across - std::floor(6 * across);
  const double seam = std::abs(panel - 0.5) > 0.485 ? -0.22 : 0;
  return 1 + seam + (down > 0.7 ? -0.1 : 0);
}

double shade_of_folds(double across, double down) {
  const Eigen::Vector3d at(4 * std::cos(2 * std::numbers::pi * across),
                           4 * std::sin(2 * std::numbers::pi * across), 6 * down);
  return 0.72 + 0.5 * soft_noise(at);
}

}  // namespace

bool is_made_here(std::string_view garment) { return garment.starts_with("helper-"); }

Proxy make_headwear(const MakeHuman& makehuman, std::string_view name) {
  if (is_hair(name)) return make_hair(makehuman, name);
  Sheet sheet(makehuman, name, name == kScarf);
  constexpr float kGapM = 0.011F;
  if (name == kScarf) {
    add_neckwear(sheet);
  } else if (name == kHeadscarf) {
    add_headscarf(makehuman, sheet);
  } else {
    add_dome(makehuman, sheet, Eigen::Vector3f::UnitZ(), kGapM, hat_rim);
    if (name == kCap) add_peak(makehuman, sheet, kGapM);
  }
  return sheet.take();
}

Image headwear_cloth(std::string_view name, int size) {
  Image image(size, size);
  for (int y = 0; y < size; ++y) {
    const double down = (y + 0.5) / size;
    for (int x = 0; x < size; ++x) {
      const double across = (x + 0.5) / size;
      double shade = 1;
      double density = 1;
      if (name == kKnittedHat) shade = shade_of_knit(across, down);
      if (name == kCap) shade = shade_of_cap(across, down);
      if (name == kHeadscarf || name == kScarf) shade = shade_of_folds(across, down);
      if (is_hair(name)) {
        shade = 0.8 + 0.4 * soft_noise({150 * across, 26 * down, 1});
        density = 0.45 + 0.55 * soft_noise({190 * across, 40 * down, 2});
      }
      std::uint8_t* pixel = image.pixel(x, y);
      pixel[0] = pixel[1] = pixel[2] =
          static_cast<std::uint8_t>(std::lround(std::min(255.0, kMedianShade * shade)));
      pixel[3] = static_cast<std::uint8_t>(std::lround(255 * density));
    }
  }
  return image;
}

float hair_density(std::string_view name, const Eigen::Vector3f& point) {
  return is_hair(name) ? density_of_hair(name, point) : 1;
}

}  // namespace throng::skinning
