#include "skinning/wardrobe/dress.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "skinning/body/stance.h"
#include "skinning/wardrobe/headwear.h"
#include "skinning/wardrobe/layers.h"

namespace throng::skinning {

namespace {

float below_waist(const BoneWeights& weights) {
  float sum = weights[index_from(Bone::hips)];
  for (std::size_t bone = index_from(Bone::left_thigh); bone < kBoneCount; ++bone) {
    sum += weights[bone];
  }
  return sum;
}

// Height at which a bottom ends in the A-pose, in which legs hang nearly straight down; far below
// the feet when it is as long as it comes.
float hem_height(const Outfit& outfit, const Joints& a_pose, float height_m) {
  const float knee = a_pose[index_from(Bone::left_shin)].z();
  const bool skirt = outfit.bottom == kSkirt;
  if (outfit.hem == Hem::knee) return knee + (skirt ? -0.015F : 0.03F) * height_m;
  if (outfit.hem == Hem::calf) return knee - 0.12F * height_m;
  return std::numeric_limits<float>::lowest();
}

// Skin under clothes, per body vertex.
struct CoveredSkin {
  std::vector<bool> hidden;  // not rendered
  std::vector<bool> tucked;  // rendered a little further in, or it might come through
};

// A garment covers the skin of its own half only: worn over something else's trousers, a shirt must
// not hide the legs that its own trousers would have covered. Skin that shows below a bottom's hem
// stays.
CoveredSkin covered_skin(const MakeHuman& makehuman, const Wardrobe& wardrobe,
                         const PersonSpec& person, std::span<const Eigen::Vector3f> body,
                         float hem) {
  const Proxy* top = wardrobe.top(person.outfit).proxy;
  const Proxy* bottom = wardrobe.bottom(person.outfit).proxy;  // none with dresses and overalls
  const Proxy* shoes = wardrobe.shoes(person.outfit).proxy;
  const Proxy* hair = wardrobe.hair(person.outfit).proxy;
  const Proxy* hat = wardrobe.hat(person.outfit).proxy;
  constexpr float kInsideM = 0.1F;  // a look up from below the hem must find skin
  CoveredSkin covered;
  covered.hidden.resize(makehuman.weights().size());
  covered.tucked.resize(makehuman.weights().size());
  for (std::size_t vertex = 0; vertex < covered.hidden.size(); ++vertex) {
    const bool lower_half = below_waist(makehuman.weights()[vertex]) > 0.5F;
    const bool by_bottom = lower_half && bottom != nullptr;
    const Proxy* over = by_bottom ? bottom : top;
    const bool above_hem = !by_bottom || body[vertex].z() > hem;
    const bool inside = !by_bottom || body[vertex].z() > hem + kInsideM;
    covered.hidden[vertex] = shoes->hides[vertex] || (over->hides[vertex] && inside);
    covered.tucked[vertex] = shoes->tucks[vertex] || (over->tucks[vertex] && above_hem) ||
                             (hair != nullptr && hair->tucks[vertex]) ||
                             (hat != nullptr && hat->tucks[vertex]);
  }
  return covered;
}

// Lowest point of what covers the shins, per leg side; large when the legs are bare.
float lowest_on_shins(std::span<const Surface> bottoms) {
  float hem = std::numeric_limits<float>::max();
  for (const Surface& surface : bottoms) {
    for (const std::uint32_t index : surface.indices) {
      const BoneWeights& weights = surface.weights[index];
      const float shin =
          weights[index_from(Bone::left_shin)] + weights[index_from(Bone::right_shin)];
      if (shin > 0.5F) hem = std::min(hem, surface.positions[index].z());
    }
  }
  return hem;
}

// Between a short top and a low waistband skin is visible that both would have covered with the
// garments they were designed for.
void bare_waist(const MakeHuman& makehuman, const DressedPerson& dressed,
                std::span<const Surface> tops, std::span<const Surface> bottoms,
                CoveredSkin& covered) {
  constexpr float kInsideM = 0.04F;
  constexpr float kNowhereM = 10;
  const Rim hem(tops, dressed.joints, Rim::End::lower);
  const Rim waistband(bottoms, dressed.joints, Rim::End::upper);
  std::array<bool, Rim::kSectors> bare{};
  for (std::size_t sector = 0; sector < Rim::kSectors; ++sector) {
    const bool both = hem[sector] < kNowhereM && waistband[sector] > -kNowhereM;
    if (!both || waistband[sector] > hem[sector]) continue;
    for (const std::size_t beside : {Rim::kSectors - 1, std::size_t{0}, std::size_t{1}}) {
      bare[(sector + beside) % Rim::kSectors] = true;
    }
  }
  for (std::size_t vertex = 0; vertex < covered.hidden.size(); ++vertex) {
    const BoneWeights& weights = makehuman.weights()[vertex];
    if (trunk_weight(weights) < 0.5F) continue;
    const Eigen::Vector3f point = move_point(dressed.body[vertex], weights, dressed.to_neutral);
    const std::size_t sector = Rim::sector_of(point - dressed.joints[0]);
    if (bare[sector] && point.z() > waistband[sector] - kInsideM &&
        point.z() < hem[sector] + kInsideM) {
      covered.hidden[vertex] = false;
    }
  }
}

// Height of a coat's hem in the A-pose, or far above the head without a coat.
float coat_hem(const Outfit& outfit, const Joints& a_pose) {
  if (outfit.coat <= 0) return std::numeric_limits<float>::max();
  return std::lerp(a_pose[index_from(Bone::left_thigh)].z(),
                   a_pose[index_from(Bone::left_shin)].z(), static_cast<float>(outfit.coat));
}

float lowest_point(std::span<const Surface> surfaces) {
  float lowest = std::numeric_limits<float>::max();
  for (const Surface& surface : surfaces) {
    for (const std::uint32_t index : surface.indices) {
      lowest = std::min(lowest, surface.positions[index].z());
    }
  }
  return lowest;
}

float highest_fitted(std::span<const Surface> surfaces) {
  float highest = std::numeric_limits<float>::lowest();
  for (const Surface& surface : surfaces) {
    for (const std::uint32_t index : surface.indices) {
      highest = std::max(highest, surface.fitted[index].z());
    }
  }
  return highest;
}

float highest_point(std::span<const Surface> surfaces) {
  float highest = std::numeric_limits<float>::lowest();
  for (const Surface& surface : surfaces) {
    for (const std::uint32_t index : surface.indices) {
      highest = std::max(highest, surface.positions[index].z());
    }
  }
  return highest;
}

Surface skin_surface(const MakeHuman& makehuman, const PersonSpec& person,
                     const DressedPerson& dressed, const CoveredSkin& covered) {
  Surface skin = make_surface(makehuman.skin(), makehuman.uvs(), dressed.body, makehuman.weights(),
                              dressed.to_neutral);
  constexpr float kTuckM = 0.007F;
  for (std::size_t i = 0; i < skin.source.size(); ++i) {
    if (covered.tucked[skin.source[i]]) tuck_in(skin, i, kTuckM, dressed.to_neutral);
  }
  keep_triangles(skin, [&](std::size_t at) {
    return !all_corners(skin, at, [&](std::uint32_t vertex) -> bool {
      return covered.hidden[skin.source[vertex]];
    });
  });
  skin.texture = person.skin;
  return skin;
}

// Cloth is one-sided: where it ends, the inside of its far side would be missing. Adds the back of
// the triangles along its open borders.
void add_linings(Surface& surface) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  const auto edge = [&](std::size_t at, std::size_t corner) {
    const std::uint32_t a = surface.source[surface.indices[at + corner]];
    const std::uint32_t b = surface.source[surface.indices[at + (corner + 1) % 3]];
    return std::pair(std::min(a, b), std::max(a, b));  // std::minmax would return references
  };
  for (std::size_t at = 0; at < surface.indices.size(); at += 3) {
    for (std::size_t corner = 0; corner < 3; ++corner) ++edges[edge(at, corner)];
  }
  std::set<std::uint32_t> border;
  for (const auto& [ends, faces] : edges) {
    if (faces == 1) border.insert({ends.first, ends.second});
  }
  std::map<std::uint32_t, std::uint32_t> back;
  const std::size_t count = surface.indices.size();
  for (std::size_t at = 0; at < count; at += 3) {
    bool near_border = false;
    for (std::size_t corner = 0; corner < 3; ++corner) {
      near_border = near_border || border.contains(surface.source[surface.indices[at + corner]]);
    }
    if (!near_border) continue;
    for (const std::size_t corner : {0, 2, 1}) {
      const std::uint32_t front = surface.indices[at + corner];
      const auto [entry, is_new] = back.try_emplace(front, 0);
      if (is_new) entry->second = add_turned(surface, front);
      surface.indices.push_back(entry->second);
    }
  }
}

// Adds surfaces that together have about `triangles` triangles, each its share.
enum class Lined : std::uint8_t { no, yes };
void add_simplified(std::vector<Surface> more, std::size_t triangles, std::vector<Surface>& all,
                    Lined lined = Lined::no) {
  std::size_t indices = 0;
  for (const Surface& surface : more) indices += surface.indices.size();
  for (Surface& surface : more) {
    if (surface.indices.empty()) continue;
    simplify(surface, triangles * surface.indices.size() / indices, lined == Lined::yes);
    if (lined == Lined::yes) add_linings(surface);
    all.push_back(std::move(surface));
  }
}

// Moves everything so that the soles stand on z = 0 with the hips above the origin.
void put_on_ground(DressedPerson& dressed, float crown) {
  float lowest = std::numeric_limits<float>::max();
  for (const Surface& surface : dressed.surfaces) {
    for (const std::uint32_t index : surface.indices) {
      lowest = std::min(lowest, surface.positions[index].z());
    }
  }
  const Eigen::Vector3f shift(-dressed.joints[0].x(), -dressed.joints[0].y(), -lowest);
  for (Surface& surface : dressed.surfaces) {
    for (Eigen::Vector3f& position : surface.positions) position += shift;
  }
  for (Eigen::Vector3f& joint : dressed.joints) joint += shift;
  for (BoneMatrix& matrix : dressed.to_neutral) matrix.col(3) += shift;
  dressed.stature_m = crown - lowest;
}

}  // namespace

DressedPerson dress(const MakeHuman& makehuman, const Wardrobe& wardrobe,
                    const PersonSpec& person) {
  const Outfit& outfit = person.outfit;
  DressedPerson dressed;
  Stance stance = stand_at_height(makehuman, person.shape, person.height_m);
  makehuman.curl_fingers(stance.body);
  dressed.body = std::move(stance.body);
  dressed.joints = stance.joints;
  dressed.to_neutral = stance.to_neutral;
  const float hem = hem_height(outfit, stance.a_pose, static_cast<float>(person.height_m));
  CoveredSkin covered = covered_skin(makehuman, wardrobe, person, dressed.body, hem);

  std::vector<Surface> tops = wear_all(wardrobe.top(outfit), dressed);
  if (is_outerwear(outfit.top_cloth)) thicken(tops, kOuterwearM, dressed.to_neutral);
  std::vector<Surface> bottoms = wear_all(wardrobe.bottom(outfit), dressed);
  std::vector<Surface> shoes = wear_all(wardrobe.shoes(outfit), dressed);
  std::vector<Surface> hat = wear_all(wardrobe.hat(outfit), dressed);
  std::vector<Surface> hair = wear_all(wardrobe.hair(outfit), dressed);
  constexpr float kWaistOverlapM = 0.03F;
  constexpr float kHemOverlapM = 0.015F;
  if (outfit.hem != Hem::foot) cut_below(bottoms, hem);
  if (outfit.one_piece && outfit.bottom == kSkirt) {
    std::erase_if(tops, [](const Surface& surface) { return surface.tint == Tint::none; });
    cut_below(tops, highest_fitted(bottoms) - kWaistOverlapM);
  } else if (!bottoms.empty()) {
    tuck_under(bottoms, Rim(tops, dressed.joints, Rim::End::lower), dressed);
    bare_waist(makehuman, dressed, tops, bottoms, covered);
  }
  add_tail(wardrobe.tail(outfit), coat_hem(outfit, stance.a_pose),
           Rim(tops, dressed.joints, Rim::End::lower), dressed, bottoms);
  hide_above(shoes, lowest_on_shins(bottoms.empty() ? tops : bottoms) + kHemOverlapM);
  const float waist = stance.a_pose[index_from(Bone::spine)].z();
  const float shoulders = stance.a_pose[index_from(Bone::left_upper_arm)].z();
  cut_below(hair, waist + static_cast<float>(outfit.hair_cut) * (shoulders - waist));
  for (Surface& surface : hair) surface.painted = is_made_here(outfit.hair);
  if (is_made_here(outfit.hat)) {
    hide_under(hair, hat);
  } else if (!hat.empty()) {
    constexpr float kBrimShare = 0.3F;
    const float low = lowest_point(hat);
    hide_above(hair, low + kBrimShare * (highest_point(hat) - low));
  }

  std::vector<Surface> face = wear_all(wardrobe.eyebrows(person.eyebrows), dressed);
  const Proxy& eyes = wardrobe.eyes();
  face.push_back(wear({&eyes, eyes.quads, Tint::none, false, person.eyes}, dressed));
  std::vector<Surface> beard = wear_all(wardrobe.beard(outfit), dressed);
  for (Surface& surface : face) surface.painted = true;
  for (Surface& surface : beard) surface.painted = true;

  // Triangles at full detail, below 8 000 in all: most where people look.
  auto& all = dressed.surfaces;
  add_simplified({skin_surface(makehuman, person, dressed, covered)}, 2200, all);
  add_simplified(std::move(tops), bottoms.empty() ? 2000 : 1300, all, Lined::yes);
  add_simplified(std::move(bottoms), outfit.coat > 0 ? 1000 : 800, all, Lined::yes);
  add_simplified(std::move(shoes), 550, all);
  add_simplified(std::move(hair), hat.empty() ? 1250 : 900, all);
  add_simplified(std::move(hat), 350, all, Lined::yes);
  add_simplified(wear_all(wardrobe.scarf(outfit), dressed), 240, all);
  add_simplified(std::move(beard), 160, all);
  add_simplified(std::move(face), 250, all);
  put_on_ground(dressed, stance.highest);
  return dressed;
}

}  // namespace throng::skinning
