// Whether bodies at all levels of detail reach as far as those that labels are made for, for all
// characters in all kinds of motion, in directions all around.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "skinning/levels.h"
#include "tests/skinning/baked_people.h"

namespace throng::skinning {
namespace {

using Directions = Eigen::Matrix<float, Eigen::Dynamic, 3>;

/// Spread evenly over the sphere (a Fibonacci lattice); others than those of the build.
Directions directions() {
  constexpr int kCount = 150;
  Directions all(kCount, 3);
  for (int i = 0; i < kCount; ++i) {
    const double z = 1 - (2 * i + 1.0) / kCount;
    const double turn = 2 * std::numbers::pi * i / std::numbers::phi;
    const double flat = std::sqrt(1 - z * z);
    all.row(i) = Eigen::RowVector3d(flat * std::cos(turn), flat * std::sin(turn), z).cast<float>();
  }
  return all;
}

/// Vertices of a body without umbrella; without what is alpha tested, most of which is not there,
/// where only what surely is there counts.
std::vector<const Vertex*> opaque_body(const Character& character, const Mesh& mesh, bool surely) {
  std::vector<char> is_used(mesh.vertices.size(), 0);
  for (const Part& part : mesh.parts) {
    if (is_apart(character, part) || (surely && part.alpha_tested)) continue;
    for (std::uint32_t i = 0; i < part.index_count; ++i) {
      is_used[mesh.indices[part.first_index + i]] = 1;
    }
  }
  std::vector<const Vertex*> vertices;
  for (std::size_t i = 0; i < is_used.size(); ++i) {
    if (is_used[i] != 0) vertices.push_back(&mesh.vertices[i]);
  }
  return vertices;
}

/// How far (m) a posed body reaches in each direction.
Eigen::VectorXf reach(const std::vector<const Vertex*>& body, const Palette& palette,
                      const Directions& all) {
  Eigen::Matrix3Xf posed(3, static_cast<Eigen::Index>(body.size()));
  for (std::size_t i = 0; i < body.size(); ++i) {
    posed.col(static_cast<Eigen::Index>(i)) = skin(*body[i], palette, palette, 0);
  }
  return (all * posed).rowwise().maxCoeff();
}

using LevelExtentsTest = BakedPeopleTest;

struct TestFrame {
  std::uint32_t palette;
  bool is_folded;  ///< sitting, squatting, cowering
};

/// Frames of every motion, those of falls more densely.
std::vector<TestFrame> test_frames(const Population& people) {
  std::vector<TestFrame> frames;
  for (const Clip& clip : people.clips) {
    const std::uint32_t step = clip.name.starts_with("fall") ? 3 : 17;
    const bool is_folded = clip.name.starts_with("sit") || clip.name == "rise" ||
                           clip.name == "act_squat" || clip.name == "act_cower";
    for (std::uint32_t frame = clip.first % 7; frame < clip.frames; frame += step) {
      frames.push_back({clip.first + frame, is_folded});
    }
  }
  return frames;
}

TEST_F(LevelExtentsTest, AreThoseOfTheFinestLevels) {
  const Directions all = directions();
  const std::vector<TestFrame> frames = test_frames(*people_);
  ASSERT_GT(frames.size(), 60U);
  std::array<float, kDrawnLevels> max_off_m{};
  for (std::size_t person = 0; person < people_->characters.size(); ++person) {
    const Character& character = people_->characters[person];
    const auto finest = opaque_body(character, character.levels[0], true);
    std::vector<std::vector<const Vertex*>> bodies;
    for (std::size_t level = 0; level < kDrawnLevels; ++level) {
      bodies.push_back(opaque_body(character, character.levels[level], false));
    }
    std::array<float, kDrawnLevels> off_m{};
    for (std::size_t i = person % 4; i < frames.size(); i += 4) {  // all of them within four people
      const Palette palette = people_->palette(person, frames[i].palette);
      const Eigen::VectorXf expected =
          reach(finest, palette, all).cwiseMax(reach(bodies[1], palette, all));
      for (std::size_t level = 0; level < kDrawnLevels; ++level) {
        const Eigen::VectorXf off = reach(bodies[level], palette, all) - expected;
        // Levels of few triangles are not fitted on folded bodies, and may miss twice as much
        // there.
        const float share = level >= 4 && frames[i].is_folded ? 0.5F : 1;
        off_m[level] = std::max(off_m[level], share * off.cwiseAbs().maxCoeff());
      }
    }
    for (std::size_t level = 0; level < kDistantLevel; ++level) {
      // Alpha-tested hair of the finest level ends beyond what is seen of it. Others: poses that
      // levels are not fitted on, and straps, which coarser levels have not.
      const double slack_m =
          extent_slack_m(level, character.stature_m) + (level == 0 ? 0.013 : 0.006);
      EXPECT_LE(off_m[level], slack_m)
          << character.name << " level " << level << ", " << character.wears;
      max_off_m[level] = std::max(max_off_m[level], off_m[level]);
    }
  }
  for (std::size_t level = 0; level < kDrawnLevels; ++level) {
    RecordProperty("level_" + std::to_string(level) + "_mm",
                   static_cast<int>(std::lround(1000 * max_off_m[level])));
  }
}

}  // namespace
}  // namespace throng::skinning
