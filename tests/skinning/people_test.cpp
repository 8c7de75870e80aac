// The people that set-up baked.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "skinning/animate/gait.h"
#include "skinning/animate/motion.h"
#include "skinning/body/raster.h"
#include "skinning/items.h"
#include "skinning/levels.h"
#include "tests/skinning/baked_people.h"
#include "tests/skinning/walkers.h"

namespace throng::skinning {
namespace {

using PeopleTest = BakedPeopleTest;

Palette rest_palette() {
  Palette palette;
  for (BoneMatrix& matrix : palette) matrix = BoneMatrix::Identity();
  return palette;
}

// Without what is carried, which may be above the head.
std::vector<Vertex> worn_vertices(const Mesh& mesh) {
  std::vector<Vertex> vertices;
  for (const Part& part : mesh.parts) {
    if (part.tint == Tint::item) continue;
    for (std::uint32_t at = 0; at < part.index_count; ++at) {
      vertices.push_back(mesh.vertices[mesh.indices[part.first_index + at]]);
    }
  }
  return vertices;
}

TEST_F(PeopleTest, AreAtLeastEightAndAllDifferent) {
  ASSERT_GE(people_->characters.size(), 8U);
  std::set<std::string> names;
  std::set<long> statures_mm;
  for (const Character& character : people_->characters) {
    names.insert(character.name);
    statures_mm.insert(std::lround(1000 * character.stature_m));
  }
  EXPECT_EQ(names.size(), people_->characters.size());
  EXPECT_GE(statures_mm.size(), 8U);
}

/// Surface of a part's triangles, m², of those only that `counts` by their first corner.
template <typename Counts>
double area_m2(const Mesh& mesh, const Part& part, const Counts& counts) {
  double sum = 0;
  const auto corner = [&](std::uint32_t at) -> const Vertex& {
    return mesh.vertices[mesh.indices[part.first_index + at]];
  };
  for (std::uint32_t at = 0; at + 2 < part.index_count; at += 3) {
    if (!counts(corner(at))) continue;
    const Eigen::Vector3f a(corner(at).position.data());
    const Eigen::Vector3f b(corner(at + 1).position.data());
    const Eigen::Vector3f c(corner(at + 2).position.data());
    sum += static_cast<double>((b - a).cross(c - a).norm()) / 2;
  }
  return sum;
}

TEST_F(PeopleTest, ShoesAreDyedWhateverTheyAre) {
  const auto is_foot = [](const Vertex& vertex) {
    const auto bone = static_cast<Bone>(vertex.bones[0]);
    return bone == Bone::left_foot || bone == Bone::left_toe || bone == Bone::right_foot ||
           bone == Bone::right_toe;
  };
  for (const Character& character : people_->characters) {
    const Mesh& mesh = character.levels.front();
    double dyed = 0;
    double all = 0;
    for (const Part& part : mesh.parts) {
      const double feet = area_m2(mesh, part, is_foot);
      all += feet;
      if (part.tint == Tint::shoes) dyed += feet;
    }
    EXPECT_GT(dyed, 0.8 * all) << character.name << ": " << character.wears;
  }
}

TEST_F(PeopleTest, ColorsAreThoseThatAreDrawn) {
  const auto everything = [](const Vertex&) { return true; };
  for (const Character& character : people_->characters) {
    const Mesh& mesh = character.levels.front();
    std::array<double, kTintCount> drawn{};
    for (const Part& part : mesh.parts) {
      if (part.tint == Tint::portrait) continue;
      const auto tint = static_cast<std::size_t>(part.tint);
      drawn[tint] += area_m2(mesh, part, everything);
      if (part.tint == Tint::none || character.tints[tint].empty()) continue;
      // A suit keeps its colors.
      if (character.wears.starts_with("suit") && part.tint == Tint::top) continue;
      // Light and shade only: the color is the instance's.
      const Texture& texture = people_->textures[static_cast<std::size_t>(part.texture)];
      for (std::uint32_t at = 0; at < part.index_count; ++at) {
        const auto& uv = mesh.vertices[mesh.indices[part.first_index + at]].uv;
        const auto texel = [&](float share) {
          const auto place = static_cast<int>(share * static_cast<float>(people_->texture_size));
          return static_cast<std::size_t>(std::clamp(place, 0, people_->texture_size - 1));
        };
        const std::size_t place =
            4 * (texel(uv[1]) * static_cast<std::size_t>(people_->texture_size) + texel(uv[0]));
        ASSERT_EQ(texture.rgba[place], texture.rgba[place + 1]) << character.name;
        ASSERT_EQ(texture.rgba[place], texture.rgba[place + 2]) << character.name;
      }
    }
    for (const Tint tint : {Tint::top, Tint::shoes}) {
      const auto index = static_cast<std::size_t>(tint);
      if (!character.tints[index].empty()) {
        EXPECT_GT(drawn[index], 0.02) << character.name << ": " << character.wears;
      }
    }
  }
}

TEST_F(PeopleTest, MeshesAreSound) {
  for (const Character& character : people_->characters) {
    ASSERT_EQ(character.levels.size(), kDetailLevels.size());
    for (const Mesh& mesh : character.levels) {
      std::uint32_t next = 0;
      for (const Part& part : mesh.parts) {
        EXPECT_EQ(part.first_index, next);
        EXPECT_EQ(part.index_count % 3, 0U);
        ASSERT_GE(part.texture, 0);
        ASSERT_LT(static_cast<std::size_t>(part.texture), people_->textures.size());
        EXPECT_EQ(part.shades >= 0, part.tint == Tint::portrait);
        ASSERT_LT(part.shades, static_cast<std::int32_t>(people_->textures.size()));
        next += part.index_count;
      }
      EXPECT_EQ(next, mesh.indices.size());
      for (const std::uint32_t index : mesh.indices) ASSERT_LT(index, mesh.vertices.size());
      for (const Vertex& vertex : mesh.vertices) {
        int sum = 0;
        for (std::size_t slot = 0; slot < 4; ++slot) {
          ASSERT_LE(vertex.bones[slot], is_led(character.carries) ? kStillBone : kBoneCount - 1);
          sum += vertex.weights[slot];
        }
        ASSERT_EQ(sum, 255);
        const Eigen::Vector3f normal(vertex.normal[0], vertex.normal[1], vertex.normal[2]);
        ASSERT_NEAR(normal.norm(), 1, 1e-3);
        for (const float value : vertex.position) ASSERT_LT(std::abs(value), 3);
        for (const float value : vertex.uv) ASSERT_LT(std::abs(value), 2);
      }
    }
  }
}

TEST_F(PeopleTest, StatureIsThatOfTheMesh) {
  for (const Character& character : people_->characters) {
    float crown = 0;
    float sole = 1;
    const Mesh& mesh = character.levels.front();
    for (const Part& part : mesh.parts) {
      for (std::uint32_t at = 0; at < part.index_count; ++at) {
        const float z = mesh.vertices[mesh.indices[part.first_index + at]].position[2];
        sole = std::min(sole, z);
        if (part.tint == Tint::none)
          crown = std::max(crown, z);  // of the head, not of hair or hats
      }
    }
    EXPECT_NEAR(sole, 0, 0.01) << character.name;
    EXPECT_NEAR(crown, character.stature_m, 0.01) << character.name;
    EXPECT_GT(character.stature_m, 1.0F);
    EXPECT_LT(character.stature_m, 2.1F);
  }
}

TEST_F(PeopleTest, HeadsAreOnTopAndFeetBelowPointingForwards) {
  for (const Character& character : people_->characters) {
    float toes = 0;
    float heels = 0;
    for (const Vertex& vertex : worn_vertices(character.levels.front())) {
      const auto bone = static_cast<Bone>(vertex.bones[0]);
      if (vertex.position[2] > 0.95F * character.stature_m) {
        EXPECT_EQ(bone, Bone::head);
      }
      if (vertex.position[2] > 0.1F * character.stature_m) continue;
      EXPECT_GE(bone, Bone::left_shin);
      toes = std::max(toes, vertex.position[0]);
      heels = std::min(heels, vertex.position[0]);
    }
    EXPECT_GT(toes, -heels) << character.name;
  }
}

TEST_F(PeopleTest, LeftIsPositiveY) {
  constexpr float kTouchingM = 0.01F;  // heavy legs touch
  for (const Character& character : people_->characters) {
    for (const Vertex& vertex : character.levels.front().vertices) {
      if (vertex.weights[0] < 250) continue;
      const auto bone = static_cast<Bone>(vertex.bones[0]);
      if (bone == Bone::left_hand || bone == Bone::left_shin) {
        EXPECT_GT(vertex.position[1], -kTouchingM);
      }
      if (bone == Bone::right_hand || bone == Bone::right_shin) {
        EXPECT_LT(vertex.position[1], kTouchingM);
      }
    }
  }
}

TEST_F(PeopleTest, TrianglesFaceOutwards) {
  // A closed surface that faces outwards has a positive volume: that of a person.
  for (const Character& character : people_->characters) {
    for (std::size_t level = 1; level < character.levels.size(); ++level) {
      const Mesh& mesh = character.levels[level];
      double volume_m3 = 0;
      for (std::size_t at = 0; at < mesh.indices.size(); at += 3) {
        std::array<Eigen::Vector3d, 3> corner;
        for (std::size_t i = 0; i < 3; ++i) {
          const auto& p = mesh.vertices[mesh.indices[at + i]].position;
          corner[i] = Eigen::Vector3d(p[0], p[1], p[2]);
        }
        volume_m3 += corner[0].dot(corner[1].cross(corner[2])) / 6;
      }
      const double cubes = volume_m3 / std::pow(character.stature_m, 3);
      EXPECT_GT(cubes, 0.003) << character.name << " level " << level;
      EXPECT_LT(cubes, 0.05) << character.name << " level " << level;
    }
  }
}

TEST_F(PeopleTest, TexturesHaveOneSize) {
  const auto size = static_cast<std::size_t>(people_->texture_size);
  for (const Texture& texture : people_->textures) {
    EXPECT_EQ(texture.rgba.size(), size * size * 4);
  }
}

TEST_F(PeopleTest, EveryFrameIsOnTheGroundAndKeepsTheBodyTogether) {
  for (std::size_t i = 0; i < people_->characters.size(); ++i) {
    const Mesh& mesh = people_->characters[i].levels.back();
    const Mesh& full = people_->characters[i].levels.front();
    // A stick reaches farther than the hand that holds it, and a pram or bicycle is long.
    const Carry carries = people_->characters[i].carries;
    const float more = is_led(carries) ? 0.35F : carries == Carry::walking_stick ? 0.3F : 0;
    const float far_up = 0.75F + more;
    const float far_fallen = 0.95F + more;
    std::vector<const Vertex*> soles;
    for (const Vertex& vertex : full.vertices) {
      if (vertex.position[2] < 0.03F) soles.push_back(&vertex);
    }
    for (const Clip& clip : people_->clips) {
      const bool flies =
          clip.name == "run" || clip.name.starts_with("panic") || clip.name == "act_hop";
      const bool falls = clip.name.starts_with("fall");
      // People who lean on something or lead it neither sit nor squat.
      const bool folds = clip.name.starts_with("sit") || clip.name == "rise" ||
                         clip.name == "act_squat" || clip.name == "act_cower";
      if (more > 0 && folds) continue;
      for (std::uint32_t frame = clip.first; frame < clip.first + clip.frames; frame += 3) {
        const Palette palette = people_->palette(i, frame);
        float lowest = 1;
        for (const Vertex* vertex : soles) {
          lowest = std::min(lowest, skin(*vertex, palette, palette, 0).z());
        }
        ASSERT_GT(lowest, falls ? -0.03F : -0.02F)
            << people_->characters[i].name << " " << clip.name;
        if (!flies && !falls) {
          ASSERT_LT(lowest, 0.01F) << people_->characters[i].name << " " << clip.name;
        }
        const float stature = people_->characters[i].stature_m;
        for (const Vertex& vertex : mesh.vertices) {
          const Eigen::Vector3f posed = skin(vertex, palette, palette, 0);
          ASSERT_TRUE(posed.allFinite());
          ASSERT_LT(posed.head<2>().norm(), (falls ? far_fallen : far_up) * stature) << clip.name;
          ASSERT_LT(posed.z(), 1.35F * stature) << clip.name;
        }
      }
    }
  }
}

TEST_F(PeopleTest, FallenPeopleLieFlat) {
  const ClipSet clips(*people_);
  for (std::size_t i = 0; i < people_->characters.size(); ++i) {
    for (const char* name : {"fall_forwards", "fall_backwards"}) {
      const Clip* clip = clips.find(name);
      ASSERT_NE(clip, nullptr);
      const Palette palette = people_->palette(i, clip->first + clip->frames - 1);
      float lowest = 1;
      std::vector<float> heights;
      // A backpack is pressed into the ground, which hides that.
      for (const Vertex& vertex : worn_vertices(people_->characters[i].levels.front())) {
        heights.push_back(skin(vertex, palette, palette, 0).z());
        lowest = std::min(lowest, heights.back());
      }
      std::nth_element(heights.begin(), heights.begin() + heights.size() / 2, heights.end());
      EXPECT_LT(heights[heights.size() / 2], 0.26F) << people_->characters[i].name << " " << name;
      EXPECT_NEAR(lowest, 0, 0.03) << people_->characters[i].name << " " << name;
    }
  }
}

TEST_F(PeopleTest, BlendingHalfwayLiesBetweenTheFrames) {
  const Character& character = people_->characters.front();
  const PoseBlend pose = pose_at(*people_, 0.3, 1.35, 0);
  const Palette a = people_->palette(0, pose.a);
  const Palette b = people_->palette(0, pose.b);
  for (const Vertex& vertex : character.levels.back().vertices) {
    const Eigen::Vector3f middle = 0.5F * (skin(vertex, a, b, 0) + skin(vertex, a, b, 1));
    EXPECT_LT((skin(vertex, a, b, 0.5F) - middle).norm(), 1e-5F);
  }
}

// Pixels that a mesh covers, seen from the front, 100 to the meter.
std::vector<bool> silhouette(const Mesh& mesh, const Palette& palette, float yaw_rad) {
  constexpr int kSize = 220;
  std::vector<bool> covered(static_cast<std::size_t>(kSize) * kSize, false);
  std::vector<Eigen::Vector2f> points;
  for (const Vertex& vertex : mesh.vertices) {
    const Eigen::Vector3f p = skin(vertex, palette, palette, 0);
    const float across = std::cos(yaw_rad) * p.y() - std::sin(yaw_rad) * p.x();
    points.emplace_back(110 + 100 * across, 215 - 100 * p.z());
  }
  for (std::size_t at = 0; at < mesh.indices.size(); at += 3) {
    for_each_pixel(points[mesh.indices[at]], points[mesh.indices[at + 1]],
                   points[mesh.indices[at + 2]], kSize, kSize,
                   [&](int x, int y, const Eigen::Vector3f&) {
                     covered[static_cast<std::size_t>(y) * kSize + x] = true;
                   });
  }
  return covered;
}

// A leg without skin between shorts and shoes is a gap in the silhouette.
TEST_F(PeopleTest, NobodyHasGapsFromHeadToFoot) {
  const Palette rest = rest_palette();
  for (const Character& character : people_->characters) {
    // The last level is chosen by nobody's size, and has too few triangles for narrow necks and
    // ankles.
    for (std::size_t level = 0; level + 1 < character.levels.size(); ++level) {
      const std::vector<bool> covered = silhouette(character.levels[level], rest, 0);
      const int crown = 215 - static_cast<int>(100 * 0.97F * character.stature_m);
      for (int y = crown; y < 213; ++y) {
        const auto row = covered.begin() + static_cast<std::ptrdiff_t>(y) * 220;
        // On both sides of the middle: both legs are there, if with thin ankles.
        EXPECT_GT(std::count(row, row + 110, true), 0) << character.name << " row " << y;
        EXPECT_GT(std::count(row + 110, row + 220, true), 0) << character.name << " row " << y;
      }
    }
  }
}

// Skin is left out where clothes cover it: where a short top leaves a low waistband, one must not
// look through somebody.
TEST_F(PeopleTest, NobodyCanBeLookedThroughAtTheWaist) {
  constexpr float kPixelM = 0.002F;
  constexpr int kWidth = 40;  // the middle of the trunk, which arms leave free
  const Palette rest = rest_palette();
  for (const Character& character : people_->characters) {
    const Mesh& mesh = character.levels.front();
    const float low_m = 0.52F * character.stature_m;
    const auto height = static_cast<int>(0.2F * character.stature_m / kPixelM);
    std::vector<char> covered(static_cast<std::size_t>(kWidth) * height, 0);
    const auto place = [&](std::uint32_t index) {
      const Eigen::Vector3f p = skin(mesh.vertices[index], rest, rest, 0);
      return Eigen::Vector2f(p.y() / kPixelM + 0.5F * kWidth, (p.z() - low_m) / kPixelM);
    };
    for (std::size_t at = 0; at < mesh.indices.size(); at += 3) {
      const Eigen::Vector2f corner = place(mesh.indices[at]);
      const Eigen::Vector2f b = place(mesh.indices[at + 1]);
      const Eigen::Vector2f c = place(mesh.indices[at + 2]);
      const Eigen::Vector2f ab = b - corner;
      const Eigen::Vector2f ac = c - corner;
      if (ab.x() * ac.y() < ab.y() * ac.x()) continue;  // seen from behind, so not rendered
      for_each_pixel(corner, b, c, kWidth, height, [&](int x, int y, const Eigen::Vector3f&) {
        covered[static_cast<std::size_t>(y) * kWidth + x] = 1;
      });
    }
    EXPECT_EQ(std::count(covered.begin(), covered.end(), 0), 0) << character.name;
  }
}

TEST_F(PeopleTest, RestPoseIsTheIdentity) {
  const Palette rest = rest_palette();
  const Vertex& vertex = people_->characters.front().levels.front().vertices.front();
  const Eigen::Vector3f position(vertex.position[0], vertex.position[1], vertex.position[2]);
  EXPECT_LT((skin(vertex, rest, rest, 0.3F) - position).norm(), 1e-6F);
}

int bone_weight(const Vertex& vertex, Bone bone) {
  int share = 0;
  for (std::size_t slot = 0; slot < 4; ++slot) {
    if (static_cast<Bone>(vertex.bones[slot]) == bone) share += vertex.weights[slot];
  }
  return share;
}

// The ball of the foot: of what follows the toes more than the rest of the foot, the rearmost
// vertex of the sole. The soles of some shoes rise toward their tips, which stay in the air.
const Vertex* ball_of_foot(const Mesh& mesh, Bone toe) {
  constexpr float kSoleM = 0.006F;
  std::vector<const Vertex*> forefoot;
  for (const Vertex& vertex : mesh.vertices) {
    if (bone_weight(vertex, toe) > 127) forefoot.push_back(&vertex);
  }
  if (forefoot.empty()) return nullptr;
  const auto lower = [](const Vertex* a, const Vertex* b) {
    return a->position[2] < b->position[2];
  };
  const float sole_m = (*std::min_element(forefoot.begin(), forefoot.end(), lower))->position[2];
  const Vertex* found = nullptr;
  for (const Vertex* vertex : forefoot) {
    if (vertex->position[2] > sole_m + kSoleM) continue;
    if (found == nullptr || vertex->position[0] < found->position[0]) found = vertex;
  }
  return found;
}

// How far the ball of the left foot moves over the ground while it stands on it, in millimeters.
double slide_mm(const Population& people, std::uint32_t character, double speed_mps,
                float amplitude) {
  const Mesh& mesh = people.characters[character].levels.front();
  const std::vector<Moment> moments = straight_trajectory(std::vector<double>(70, speed_mps), 0.1);
  Appearance appearance;
  appearance.character = character;
  appearance.amplitude = amplitude;
  appearance.phase_offset = 0.6F;
  const MotionPlan plan(people, appearance, 1, moments, 0.1);
  const Vertex* ball = ball_of_foot(mesh, Bone::left_toe);
  if (ball == nullptr) return 1000;
  const Contact contact =
      find_contact(people, character, plan, moments, 0, 70, *ball, 0.0025F, 0.1);
  return contact.landings < 2 ? 1000 : 1000 * contact.slide_m;
}

TEST_F(PeopleTest, FeetDoNotSkateAtAnySpeed) {
  double worst_mm = 0;
  for (std::uint32_t i = 0; i < people_->characters.size(); ++i) {
    for (double speed = 0.3; speed <= 4; speed += 0.37) {
      for (const float amplitude : {0.9F, 1.1F}) {
        const double slide = slide_mm(*people_, i, speed, amplitude);
        EXPECT_LT(slide, 15) << people_->characters[i].name << " at " << speed << " m/s";
        worst_mm = std::max(worst_mm, slide);
      }
    }
  }
  RecordProperty("worst_slide_mm", static_cast<int>(worst_mm));
}

}  // namespace
}  // namespace throng::skinning
