// Cars and trains as ground truth: boxes and whole masks, against images of each of them alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "render/lens/exposure.h"
#include "render/lens/lens.h"
#include "render/props/vehicles.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

using world::SemanticClass;

world::Prop prop(world::PropKind kind, double x, double y, double yaw_deg) {
  world::Prop made;
  made.kind = kind;
  made.position = {x, y};
  made.yaw_rad = yaw_deg * kDegree;
  return made;
}

/// A bench, two cars behind each other and a train: ids kIdProp to kIdProp + 3.
std::vector<world::Prop> parked() {
  return {prop(world::PropKind::bench, 4, 4, 0), prop(world::PropKind::car, 2, 0, 30),
          prop(world::PropKind::car, 5, 1, 120), prop(world::PropKind::train, 12, -3, 80)};
}

RenderOptions with_vehicles() {
  RenderOptions options;
  options.vehicles = true;
  return options;
}

world::Scenario place_with(std::vector<world::Prop> props) {
  world::Scenario scenario = open_ground();
  scenario.props = std::move(props);
  return scenario;
}

/// A place with those props, and a lens.
class View {
 public:
  explicit View(std::vector<world::Prop> props, const RenderOptions& options = with_vehicles())
      : stage_(place_with(std::move(props)), {}, options),
        lens_(stage_.renderer(), stage_.people()) {}

  Frame draw(const camera::Camera& camera) { return lens_.draw({}, camera); }
  Lens& lens() { return lens_; }

 private:
  Stage stage_;
  Lens lens_;
};

/// Compares what a frame says of the props with frames of each of them alone. At most a share
/// `tolerance` of pixels, at edges, may differ.
void expect_masks(const std::vector<world::Prop>& props, const camera::Camera& camera,
                  std::size_t expected, double tolerance) {
  View together(props);
  const Frame frame = together.draw(camera);
  ASSERT_EQ(frame.objects.size(), expected);
  for (const ObjectInView& object : frame.objects) {
    SCOPED_TRACE(object.id);
    const world::Prop& what = props.at(object.id - kIdProp);
    EXPECT_EQ(object.surface, world::prop_type(what.kind).semantic_class);
    View single({what});
    const Frame alone = single.draw(camera);
    std::uint64_t whole = 0;
    std::uint64_t wrong = 0;
    for (int y = 0; y < frame.height(); ++y) {
      for (int x = 0; x < frame.width(); ++x) {
        const bool is_shown = alone.id[pixel_index(alone, x, y)] == kIdProp;
        whole += is_shown ? 1 : 0;
        wrong += is_shown != object.whole_mask->at(x, y) ? 1 : 0;
      }
    }
    EXPECT_GT(whole, 300U);
    EXPECT_LE(static_cast<double>(wrong), tolerance * static_cast<double>(whole));
    EXPECT_GE(static_cast<double>(object.amodal_area_px),
              (1 - tolerance) * static_cast<double>(whole));
    const Mask visible = instance_mask(frame, object.id);
    EXPECT_LE(visible.pixels, object.amodal_area_px);
  }
}

/// The smallest box in the image around a box in the world.
Eigen::AlignedBox2d projected_box(const ObjectInView& object, const camera::Camera& camera) {
  Eigen::AlignedBox2d box;
  const Eigen::AngleAxisd turn(object.yaw_rad, Eigen::Vector3d::UnitZ());
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d sign((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                               (corner & 4) != 0 ? 1 : -1);
    const Eigen::Vector3d at =
        object.box_middle + turn * (0.5 * sign.cwiseProduct(object.box_size)).eval();
    box.extend(Eigen::Vector2d(camera.project(at).pixel.array() + 0.5));
  }
  return box;
}

TEST(Vehicles, AreTheCarsAndTrainsOfAScenario) {
  const world::Scenario scenario = place_with(parked());
  EXPECT_EQ(vehicle_count(scenario), 3U);
  const std::vector<Vehicle> vehicles = list_vehicles(scenario);
  ASSERT_EQ(vehicles.size(), 3U);
  EXPECT_EQ(vehicles[0].id, kIdProp + 1);
  EXPECT_EQ(vehicles[2].surface, SemanticClass::train);
  EXPECT_EQ(vehicles[1].position, Eigen::Vector3d(5, 1, 0));
}

TEST(Vehicles, AreMeasuredOnlyWhenAskedFor) {
  View view(parked(), {});
  EXPECT_TRUE(view.draw(camera_at({0, 0, 20}, 0, -60)).objects.empty());
}

TEST(Vehicles, HaveTheMasksThatTheyHaveAlone) {
  // The second car is partly hidden by the first, and the train reaches beyond the image.
  expect_masks(parked(), camera_at({-6, -2, 4}, 10, -15, 640, 480), 3, 0.02);
}

TEST(Vehicles, HaveTheirMasksThroughALens) {
  camera::Camera camera = camera_at({-4, 0, 7}, 0, -30, 640, 480, 80);
  camera.intrinsics.distortion.emplace(camera::Distortion::Model::brown_conrady,
                                       camera::Distortion::Coefficients{-0.25, 0.07});
  expect_masks(parked(), camera, 3, 0.03);
}

TEST(Vehicles, AreCutWhereTheyReachBehindTheCamera) {
  // Beside a train, 1.4 m from its wall.
  const std::vector<world::Prop> train = {prop(world::PropKind::train, 0, 0, 0)};
  expect_masks(train, camera_at({2, -2.9, 2}, 20, -5, 640, 480, 90), 1, 0.02);
}

TEST(Vehicles, HaveA3DBoxAroundThem) {
  View view(parked());
  const camera::Camera camera = camera_at({-6, -2, 9}, 10, -40, 640, 480);
  const Frame frame = view.draw(camera);
  ASSERT_GE(frame.objects.size(), 2U);
  const std::array<double, 2> yaws = {30, 120};
  for (std::size_t i = 0; i < 2; ++i) {
    const ObjectInView& car = frame.objects[i];
    EXPECT_NEAR(car.yaw_rad, yaws[i] * kDegree, 1e-9);
    // A car of the usual size, on the ground, along its heading.
    EXPECT_NEAR(car.box_size.x(), 4.4, 0.5);
    EXPECT_NEAR(car.box_size.y(), 1.8, 0.3);
    EXPECT_NEAR(car.box_size.z(), 1.5, 0.3);
    EXPECT_NEAR(car.box_middle.z(), car.box_size.z() / 2, 0.05);
    const Eigen::AlignedBox2d outer = projected_box(car, camera);
    EXPECT_TRUE(outer.contains(car.amodal_box));
    const Eigen::Vector2d slack = outer.sizes() - car.amodal_box.sizes();
    EXPECT_LT(slack.maxCoeff(), 0.25 * outer.sizes().maxCoeff());
  }
}

TEST(Vehicles, HaveOneSetOfMasksInStripsOfARollingShutter) {
  View view(parked());
  const camera::Camera camera = camera_at({-6, -2, 9}, 10, -40, 640, 480);
  const auto moment = [&](double time_s) {
    Scene scene;
    scene.time_s = time_s;
    camera::Camera moved = camera;
    moved.pose = camera_at({-6, -2 + 4 * time_s, 9}, 10, -40).pose;
    return ShutterMoment{std::make_shared<const Scene>(scene), moved};
  };
  const Frame frame = expose(view.lens(), moment, 0, {0.002, 0.03}, {.next_s = 0.5}).frame;
  ASSERT_EQ(frame.objects.size(), 3U);
  for (const ObjectInView& object : frame.objects) {
    const Mask visible = instance_mask(frame, object.id);
    EXPECT_LE(visible.pixels, object.amodal_area_px);
    EXPECT_TRUE(Eigen::AlignedBox2d(object.amodal_box.min().array() - 1.5,
                                    object.amodal_box.max().array() + 1.5)
                    .contains(visible.box));
  }
}

TEST(Vehicles, AreMeasuredWholeWhereABorderCutsStripsOfARollingShutter) {
  View view(parked());
  // The car lies across the left border, diagonally, so that some strips have only its outside.
  int cut = 0;
  for (const double yaw_deg : {-22.0, -18.0, -14.0, 34.0, 38.0, 42.0}) {
    const auto moments = [&](bool is_wide) {
      return [&, is_wide](double time_s) {
        Scene scene;
        scene.time_s = time_s;
        camera::Camera moved = camera_at({-6, -2 + 4 * time_s, 9}, yaw_deg, -40, 640, 480);
        if (is_wide) {
          moved.intrinsics.width *= 2;
          moved.intrinsics.cx_px += 320;
        }
        return ShutterMoment{std::make_shared<const Scene>(scene), moved};
      };
    };
    const Frame frame = expose(view.lens(), moments(false), 0, {0.002, 0.03}).frame;
    const Frame wide = expose(view.lens(), moments(true), 0, {0.002, 0.03}).frame;
    for (const ObjectInView& object : frame.objects) {
      const auto whole = std::find_if(wide.objects.begin(), wide.objects.end(),
                                      [&](const auto& other) { return other.id == object.id; });
      ASSERT_NE(whole, wide.objects.end());
      const Eigen::AlignedBox2d box = whole->amodal_box.translated(Eigen::Vector2d(-320, 0));
      if (box.min().x() <= -320 || box.max().x() >= 960 || box.min().y() <= 0) continue;
      EXPECT_LT((object.amodal_box.min() - box.min()).cwiseAbs().maxCoeff(), 2.5) << yaw_deg;
      EXPECT_LT((object.amodal_box.max() - box.max()).cwiseAbs().maxCoeff(), 2.5) << yaw_deg;
      cut += box.min().x() < 0 || box.max().x() > 640 ? 1 : 0;
    }
  }
  EXPECT_GT(cut, 2);
}

}  // namespace
}  // namespace throng::render
