// Shapes of props that are files.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <string>
#include <string_view>

#include "render/frame/frame.h"
#include "render/props/prop_shapes.h"
#include "render/props/shape_file.h"

namespace throng::embedded {
extern const std::string_view prop_shapes;
}  // namespace throng::embedded

namespace throng::render {
namespace {

constexpr std::uint32_t kLooks = 12;

class ShapeFile : public testing::TestWithParam<std::size_t> {};

TEST_P(ShapeFile, StandsUprightOnTheGroundThatItsKindCovers) {
  constexpr double kHeadsM = 1.9;
  constexpr double kRoundingM = 0.011;
  const world::PropType& type = world::prop_types().at(GetParam());
  if (type.height_m == 0) GTEST_SKIP() << "it grows";
  // Slanting legs reach into the ground, and hulls into the water.
  const double kFootM = type.semantic_class == world::SemanticClass::boat ? 0.6 : 0.03;
  // Few are as large as a house.
  const bool is_large = type.half_size.prod() > 25;
  const std::size_t kMaxTriangles = is_large ? 12'000 : 2700;
  const std::size_t kMaxFarTriangles = is_large ? 3200 : 1100;
  std::set<std::size_t> sizes;
  for (std::uint32_t look = 0; look < kLooks; ++look) {
    SCOPED_TRACE(look);
    world::Prop prop;
    prop.kind = static_cast<world::PropKind>(GetParam());
    prop.look = look;
    const PropMesh mesh = prop_shape(prop, kIdProp);
    Eigen::AlignedBox3d box;
    Eigen::AlignedBox3d low;
    for (const PropVertex& vertex : mesh.vertices) {
      const Eigen::Vector3d at = Eigen::Vector3f(vertex.position.data()).cast<double>();
      box.extend(at);
      if (at.z() < kHeadsM) low.extend(at);
    }
    EXPECT_LE(low.max().cwiseMax(-low.min()).x(), type.half_size.x() + kRoundingM);
    EXPECT_LE(low.max().cwiseMax(-low.min()).y(), type.half_size.y() + kRoundingM);
    EXPECT_GE(box.min().z(), -kFootM);
    EXPECT_LE(box.min().z(), 0.95);
    EXPECT_LE(box.max().z(), type.height_m + kRoundingM);
    EXPECT_GE(box.max().z(), 0.3 * type.height_m) << "backs and parasols are there by chance";
    EXPECT_GT(mesh.indices.size(), 0U);
    EXPECT_LE(mesh.far_indices, mesh.indices.size());
    EXPECT_LE(mesh.indices.size() / 3, kMaxTriangles);
    EXPECT_LE(mesh.far_indices / 3, kMaxFarTriangles);
  }
}

std::string kind_name(const testing::TestParamInfo<std::size_t>& kind) {
  return std::string(world::prop_types().at(kind.param).name);
}
INSTANTIATE_TEST_SUITE_P(Kinds, ShapeFile, testing::Range(std::size_t{0}, world::kPropKinds),
                         kind_name);

TEST(ShapeFiles, AreKindsOrPartsOfThem) {
  for (const std::string_view name : shape_names()) {
    const auto& kinds = world::prop_types();
    const bool is_kind = std::any_of(
        kinds.begin(), kinds.end(), [&](const world::PropType& type) { return type.name == name; });
    const std::string use = "\"shape\": \"" + std::string(name) + '"';
    EXPECT_TRUE(is_kind || embedded::prop_shapes.find(use) != std::string_view::npos) << name;
  }
}

TEST(ShapeFiles, HaveDetailsOnlyForTheNear) {
  world::Prop car;
  car.kind = world::PropKind::car;
  const PropMesh mesh = prop_shape(car, kIdProp);
  EXPECT_LT(mesh.far_indices, 0.75 * static_cast<double>(mesh.indices.size()));
}

TEST(ShapeFiles, VaryByLook) {
  for (const world::PropKind kind : {world::PropKind::car, world::PropKind::bench,
                                     world::PropKind::stall, world::PropKind::traffic_sign}) {
    std::set<std::size_t> sizes;
    for (std::uint32_t look = 0; look < 3 * kLooks; ++look) {
      world::Prop prop;
      prop.kind = kind;
      prop.look = look;
      sizes.insert(prop_shape(prop, kIdProp).indices.size());
    }
    EXPECT_GE(sizes.size(), 3U) << world::prop_type(kind).name;
  }
}

}  // namespace
}  // namespace throng::render
