#include "skinning/bake/carving.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <numbers>

namespace throng::skinning {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

PosedSurface posed(const Surface& surface) { return {&surface, surface.fitted, nullptr}; }

void add_box(Surface& surface, const Eigen::Vector3f& low, const Eigen::Vector3f& high) {
  const auto first = static_cast<std::uint32_t>(surface.fitted.size());
  for (int corner = 0; corner < 8; ++corner) {
    surface.fitted.emplace_back((corner & 1) != 0 ? high.x() : low.x(),
                                (corner & 2) != 0 ? high.y() : low.y(),
                                (corner & 4) != 0 ? high.z() : low.z());
  }
  for (const std::array<std::uint32_t, 4>& face : {std::array<std::uint32_t, 4>{0, 1, 3, 2},
                                                   {4, 5, 7, 6},
                                                   {0, 1, 5, 4},
                                                   {2, 3, 7, 6},
                                                   {0, 2, 6, 4},
                                                   {1, 3, 7, 5}}) {
    for (const std::size_t corner : {0, 1, 2, 0, 2, 3}) {
      surface.indices.push_back(first + face[corner]);
    }
  }
}

// Around the z axis, open below.
Surface make_skirt(float radius_m, float low_m, float high_m) {
  Surface surface;
  constexpr std::uint32_t kSides = 48;
  for (std::uint32_t i = 0; i < kSides; ++i) {
    const float turn = 2 * kPi * static_cast<float>(i) / kSides;
    for (const float z : {low_m, high_m}) {
      surface.fitted.emplace_back(radius_m * std::cos(turn), radius_m * std::sin(turn), z);
    }
    const std::uint32_t next = (i + 1) % kSides;
    surface.indices.insert(surface.indices.end(), {1, 2 * i + 1, 2 * next + 1});
    for (const std::uint32_t index :
         {2 * i, 2 * next, 2 * next + 1, 2 * i, 2 * next + 1, 2 * i + 1}) {
      surface.indices.push_back(index);
    }
  }
  return surface;
}

void expect_closed(const ClosedSurface& surface) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t at = 0; at < surface.indices.size(); at += 3) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      ++edges[{surface.indices[at + corner], surface.indices[at + (corner + 1) % 3]}];
    }
  }
  for (const auto& [ends, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(edges.contains({ends.second, ends.first}));
  }
}

double volume_m3(const ClosedSurface& surface) {
  double sum = 0;
  for (std::size_t at = 0; at < surface.indices.size(); at += 3) {
    const Eigen::Vector3f& a = surface.points[surface.indices[at]];
    const Eigen::Vector3f& b = surface.points[surface.indices[at + 1]];
    const Eigen::Vector3f& c = surface.points[surface.indices[at + 2]];
    sum += static_cast<double>(a.dot(b.cross(c))) / 6;
  }
  return sum;
}

TEST(Carving, ASkirtIsFilledAndKeepsItsShape) {
  const Surface skirt = make_skirt(0.25F, 0.4F, 1.0F);
  const std::vector<PosedSurface> surfaces = {posed(skirt)};
  const Carving carving(surfaces);
  EXPECT_LT(carving.distance_m({0, 0, 0.7F}), -0.1F);
  EXPECT_LT(carving.distance_m({0, 0, 0.42F}), 0);
  EXPECT_NEAR(carving.distance_m({0.26F, 0, 0.7F}), 0.01F, 0.004F);
  EXPECT_NEAR(carving.distance_m({0.24F, 0, 0.7F}), -0.01F, 0.004F);
  EXPECT_NEAR(carving.distance_m({0, 0, 0.38F}), 0.02F, 0.006F);
  EXPECT_FLOAT_EQ(carving.distance_m({2, 2, 2}), Carving::kFarM);
  const ClosedSurface hull = carving.surface();
  expect_closed(hull);
  EXPECT_NEAR(volume_m3(hull), kPi * 0.25 * 0.25 * 0.6, 0.03 * kPi * 0.25 * 0.25 * 0.6);
}

TEST(Carving, LegsStayApart) {
  Surface legs;
  add_box(legs, {-0.08F, 0.04F, 0}, {0.08F, 0.2F, 0.9F});
  add_box(legs, {-0.08F, -0.2F, 0}, {0.08F, -0.04F, 0.9F});
  const std::vector<PosedSurface> surfaces = {posed(legs)};
  const Carving carving(surfaces);
  EXPECT_GT(carving.distance_m({0, 0, 0.5F}), 0.02F);
  EXPECT_LT(carving.distance_m({0, 0.12F, 0.5F}), -0.03F);
  expect_closed(carving.surface());
}

TEST(Carving, ASlitAtTheWaistDoesNotCutSomebodyInTwo) {
  Surface trunk;
  add_box(trunk, {-0.1F, -0.2F, 0.5F}, {0.1F, 0.2F, 1.0F});
  add_box(trunk, {-0.1F, -0.2F, 1.006F}, {0.1F, 0.2F, 1.5F});
  const std::vector<PosedSurface> surfaces = {posed(trunk)};
  EXPECT_LT(Carving(surfaces).distance_m({0, 0, 1.003F}), 0);
}

TEST(Carving, FloatingCrumbsAndPaintedPartsAreLeftOut) {
  Surface body;
  add_box(body, {-0.1F, -0.1F, 0}, {0.1F, 0.1F, 0.5F});
  Surface crumb;
  add_box(crumb, {0.3F, 0.3F, 0.3F}, {0.33F, 0.33F, 0.33F});
  Surface paint;
  paint.painted = true;
  add_box(paint, {0.4F, -0.5F, 0}, {0.6F, -0.3F, 0.5F});
  const std::vector<PosedSurface> surfaces = {posed(body), posed(crumb), posed(paint)};
  const ClosedSurface hull = Carving(surfaces).surface();
  ASSERT_FALSE(hull.points.empty());
  for (const Eigen::Vector3f& point : hull.points) {
    EXPECT_LT(point.cwiseAbs().maxCoeff(), 0.52F);
    EXPECT_LT(point.x(), 0.12F);
  }
}

// Two boxes that share an edge only: their surface would pass there twice.
TEST(Carving, SurfacesDoNotTouchThemselves) {
  Surface boxes;
  add_box(boxes, {-0.2F, -0.2F, 0}, {0, 0, 0.5F});
  add_box(boxes, {0, 0, 0}, {0.2F, 0.2F, 0.5F});
  const std::vector<PosedSurface> surfaces = {posed(boxes)};
  expect_closed(Carving(surfaces).surface());
}

}  // namespace
}  // namespace throng::skinning
