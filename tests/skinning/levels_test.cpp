// Whether anybody would notice that people change their level of detail: what drones see of the
// character library on both sides of each switch.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/angle.h"
#include "skinning/animate/motion.h"
#include "skinning/body/raster.h"
#include "skinning/image.h"
#include "skinning/levels.h"
#include "tests/skinning/baked_people.h"

namespace throng::skinning {
namespace {

/// Pixels that somebody covers.
struct Silhouette {
  int size = 0;
  Mask covered;
};

/// Viewpoint on a person: a drone far above, whose camera looks down by `pitch_rad`.
struct View {
  double pitch_rad;
  double yaw_rad;
};

class Viewer {
 public:
  Viewer(const Population& people, const Character& character, const Palette& palette,
         const View& view, double height_px)
      : people_(&people),
        palette_(palette),
        px_per_m_(static_cast<float>(height_px) / character.stature_m),
        size_(static_cast<int>(std::ceil(2.6 * height_px)) + 4) {
    const auto turn = Eigen::AngleAxisd(view.yaw_rad, Eigen::Vector3d::UnitZ());
    const Eigen::Vector3d back =
        turn * Eigen::Vector3d(std::cos(view.pitch_rad), 0, std::sin(view.pitch_rad));
    const Eigen::Vector3d right = turn * Eigen::Vector3d::UnitY();
    right_ = right.cast<float>();
    down_ = right.cross(back).cast<float>();
    middle_ = {0, 0, 0.5F * character.stature_m};
  }

  Silhouette see(const Mesh& mesh) const {
    Silhouette image{size_, Mask(static_cast<std::size_t>(size_) * size_, 0)};
    std::vector<Eigen::Vector2f> points;
    for (const Vertex& vertex : mesh.vertices) {
      const Eigen::Vector3f p = skin(vertex, palette_, palette_, 0) - middle_;
      const Eigen::Vector2f flat(p.dot(right_), p.dot(down_));
      points.emplace_back((px_per_m_ * flat).array() + 0.5F * static_cast<float>(size_));
    }
    for (const Part& part : mesh.parts) {
      for (std::uint32_t at = 0; at < part.index_count; at += 3) {
        const std::uint32_t* corner = &mesh.indices[part.first_index + at];
        for_each_pixel(points[corner[0]], points[corner[1]], points[corner[2]], size_, size_,
                       [&](int x, int y, const Eigen::Vector3f& share) {
                         if (!is_there(mesh, part, corner, share)) return;
                         image.covered[static_cast<std::size_t>(y) * size_ + x] = 1;
                       });
      }
    }
    return image;
  }

 private:
  bool is_there(const Mesh& mesh, const Part& part, const std::uint32_t* corner,
                const Eigen::Vector3f& share) const {
    if (!part.alpha_tested) return true;
    Eigen::Vector2f uv = Eigen::Vector2f::Zero();
    for (int i = 0; i < 3; ++i) {
      const Vertex& vertex = mesh.vertices[corner[i]];
      uv += share[i] * Eigen::Vector2f(vertex.uv[0], vertex.uv[1]);
    }
    const int texels = people_->texture_size;
    const auto place = [&](float value) {
      return std::clamp(static_cast<int>((value - std::floor(value)) * static_cast<float>(texels)),
                        0, texels - 1);
    };
    const std::vector<std::uint8_t>& rgba =
        people_->textures[static_cast<std::size_t>(part.texture)].rgba;
    return rgba[4 * (static_cast<std::size_t>(place(uv.y())) * texels + place(uv.x())) + 3] >= 128;
  }

  const Population* people_;
  Palette palette_;
  float px_per_m_;
  int size_;
  Eigen::Vector3f right_;
  Eigen::Vector3f down_;
  Eigen::Vector3f middle_;
};

double overlap(const Silhouette& a, const Silhouette& b) {
  int both = 0;
  int either = 0;
  for (std::size_t i = 0; i < a.covered.size(); ++i) {
    both += a.covered[i] != 0 && b.covered[i] != 0 ? 1 : 0;
    either += a.covered[i] != 0 || b.covered[i] != 0 ? 1 : 0;
  }
  return static_cast<double>(both) / either;
}

double share_quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

class LevelsTest : public BakedPeopleTest {
 protected:
  /// Frames of any character that stands, walks and runs.
  std::vector<std::uint32_t> poses() const {
    std::vector<std::uint32_t> frames;
    for (const double speed_mps : {0.0, 0.8, 1.4, 3.5}) {
      for (const double phase : {0.1, 0.4}) {
        frames.push_back(pose_at(*people_, phase, speed_mps, 0).a);
      }
    }
    return frames;
  }

  /// Overlaps of two neighboring levels where one replaces the other.
  std::vector<double> overlaps(const Character& character, std::size_t number,
                               std::size_t finer) const {
    std::vector<double> found;
    double yaw = 0.37 * static_cast<double>(number);  // so that people are seen from all around
    for (const std::uint32_t frame : poses()) {
      for (const double pitch_deg : {20.0, 45.0, 70.0}) {
        yaw += 2.4;
        const Viewer viewer(*people_, character, people_->palette(number, frame),
                            {pitch_deg * kDegree, yaw}, kDetailLevels[finer].above_px);
        found.push_back(
            overlap(viewer.see(character.levels[finer]), viewer.see(character.levels[finer + 1])));
      }
    }
    return found;
  }
};

TEST_F(LevelsTest, HaveTheTrianglesTheyAreMeantToHave) {
  std::array<std::size_t, kDetailLevels.size()> sum{};
  for (const Character& character : people_->characters) {
    ASSERT_EQ(character.levels.size(), kDetailLevels.size());
    for (std::size_t level = 0; level < kDetailLevels.size(); ++level) {
      std::size_t triangles = 0;
      for (const Part& part : character.levels[level].parts) {
        triangles +=
            is_apart(character, part) && is_led(character.carries) ? 0 : part.index_count / 3;
      }
      const std::size_t max_triangles = kDetailLevels[level].triangles;
      // Some need more to keep their extent, at most as many as the finer level may have.
      const bool may_have_more = level > 1;
      EXPECT_LE(triangles, kDetailLevels[may_have_more ? level - 1 : level].triangles)
          << character.name << " level " << level;
      sum[level] += triangles;
      if (level > 0) {
        EXPECT_GE(triangles, max_triangles - 20) << character.name << " level " << level;
      }
    }
  }
  for (std::size_t level = 0; level < kDetailLevels.size(); ++level) {
    const std::size_t mean = sum[level] / people_->characters.size();
    EXPECT_LE(mean, kDetailLevels[level].triangles * 5 / 4) << "level " << level;
    RecordProperty("level_" + std::to_string(level) + "_triangles", static_cast<int>(mean));
  }
}

TEST_F(LevelsTest, NobodyNoticesTheSwitch) {
  for (std::size_t finer = 0; kDetailLevels[finer].above_px > 0; ++finer) {
    // In the distance a pixel more or less along the outline is much, and the number of people is
    // more.
    const bool is_distant = finer + 1 >= kDistantLevel;
    std::vector<double> all;
    for (std::size_t i = 0; i < people_->characters.size(); ++i) {
      const std::vector<double> own = overlaps(people_->characters[i], i, finer);
      EXPECT_GE(share_quantile(own, 0.5), is_distant ? 0.5 : 0.87)
          << people_->characters[i].name << ", " << people_->characters[i].wears;
      all.insert(all.end(), own.begin(), own.end());
    }
    const std::string switch_name = "from_" + std::to_string(finer);
    RecordProperty(switch_name + "_median", std::to_string(share_quantile(all, 0.5)));
    RecordProperty(switch_name + "_tenth", std::to_string(share_quantile(all, 0.1)));
    EXPECT_GE(share_quantile(all, 0.5), is_distant ? 0.7 : 0.92)
        << "from level " << finer << " to the next";
    EXPECT_GE(share_quantile(all, 0.1), is_distant ? 0.5 : 0.86)
        << "from level " << finer << " to the next";
  }
}

}  // namespace
}  // namespace throng::skinning
