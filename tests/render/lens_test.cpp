// Images through distorting lenses, against the camera's model and against pinhole images.
#include "render/lens/lens.h"

#include <gtest/gtest.h>

#include "base/compute/random.h"
#include "tests/render/stage.h"

namespace throng::render {
namespace {

using camera::Camera;
using camera::Distortion;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Model = Distortion::Model;

Camera through(Camera camera, const Distortion& distortion) {
  camera.intrinsics.distortion = distortion;
  return camera;
}

const Distortion& barrel() {
  static const Distortion lens(Model::brown_conrady, {-0.28, 0.08, 0.001, -0.0005, -0.01});
  return lens;
}
const Distortion& pincushion() {
  static const Distortion lens(Model::brown_conrady, {0.12, 0.02});
  return lens;
}
const Distortion& fisheye() {
  static const Distortion lens(Model::fisheye, {-0.04, 0.003, -0.002, 0.0004});
  return lens;
}

/// A stage with a lens before its renderer.
struct Set {
  explicit Set(world::Scenario scenario, const RenderOptions& options = {})
      : stage(std::move(scenario), {}, options), lens(stage.renderer(), stage.people()) {}

  Frame draw(const Camera& camera, std::vector<PersonInstance> people = {}) {
    Scene scene;
    scene.people = std::move(people);
    return lens.draw(scene, camera);
  }

  Stage stage;
  Lens lens;
};

std::vector<PersonInstance> scatter_people(const Stage& stage, std::uint32_t count,
                                           double reach_m) {
  std::vector<PersonInstance> crowd;
  for (std::uint32_t i = 0; i < count; ++i) {
    Random random(5, Stream::crowd_generator, i);
    crowd.push_back(stage.standing(i, random.uniform(-reach_m, reach_m),
                                   random.uniform(-reach_m, reach_m), random.uniform(-3, 3)));
  }
  return crowd;
}

TEST(Lens, WithoutDistortionTheImageIsThePinholes) {
  Set set(open_ground({block(2, 5, -2, 1, 2)}));
  const Camera pinhole = camera_at({-9, 2, 6}, -10, -30);
  const std::vector<PersonInstance> crowd = scatter_people(set.stage, 30, 5);
  const Frame plain = set.draw(pinhole, crowd);
  const Frame mapped = set.draw(through(pinhole, Distortion(Model::brown_conrady, {})), crowd);
  EXPECT_EQ(mapped.id, plain.id);
  // A wider image has coarser shadows.
  double difference = 0;
  for (std::size_t i = 0; i < plain.rgb.size(); ++i) {
    difference += std::abs(plain.rgb[i] - mapped.rgb[i]);
  }
  EXPECT_LT(difference / static_cast<double>(plain.rgb.size()), 1);
  ASSERT_EQ(mapped.people.size(), plain.people.size());
  for (std::size_t i = 0; i < plain.people.size(); ++i) {
    const Eigen::AlignedBox2d& a = plain.people[i].amodal_box;
    const Eigen::AlignedBox2d& b = mapped.people[i].amodal_box;
    EXPECT_LT((a.min() - b.min()).norm() + (a.max() - b.max()).norm(), 0.02);
  }
}

// A point of the world, found through the map that the image is looked up by.
TEST(Lens, MapAgreesWithTheModelToATwentiethPixel) {
  for (const Distortion& distortion : {barrel(), pincushion(), fisheye()}) {
    const Camera camera = through(camera_at({0, 0, 10}, 30, -40), distortion);
    const LensMap map = lens_map(camera.intrinsics, {0, camera.intrinsics.height});
    const Camera wide{map.wide, camera.pose};
    for (std::uint64_t i = 0; i < 500; ++i) {
      Random random(3, Stream::sensors, i);
      const Vector3d point = camera.unproject(
          {random.uniform(0, 318.99), random.uniform(0, 238.99)}, random.uniform(2, 50));
      const Vector2d shown = camera.project(point).pixel;
      const Eigen::Vector2i corner = shown.array().floor().cast<int>();
      const Vector2d part = shown - corner.cast<double>();
      const auto position = [&](int right, int down) {
        const auto at = static_cast<std::size_t>((corner.y() + down) * 320 + corner.x() + right);
        return Vector2d(map.position[2 * at], map.position[2 * at + 1]);
      };
      const Vector2d top = position(0, 0) + part.x() * (position(1, 0) - position(0, 0));
      const Vector2d bottom = position(0, 1) + part.x() * (position(1, 1) - position(0, 1));
      const Vector2d looked_up = top + part.y() * (bottom - top);
      EXPECT_LT((looked_up - wide.project(point).pixel).norm(), 0.05);
    }
  }
}

/// First x, right of `from`, at which the ray through (x, row) no longer meets `block(4, 5, -3, 0,
/// 6)`.
double edge_in_row(const Camera& camera, int row) {
  const Eigen::AlignedBox3d box(Vector3d(4, -3, 0), Vector3d(5, 0, 6));
  const auto hits = [&](double x) {
    const Vector3d from = camera.pose.center();
    const Vector3d direction = camera.unproject({x, row}, 1) - from;
    double enter = 0;
    double leave = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
      const double a = (box.min()[axis] - from[axis]) / direction[axis];
      const double b = (box.max()[axis] - from[axis]) / direction[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    return enter < leave;
  };
  double left = 0;
  double right = -1;
  constexpr int kStep = 8;
  for (int x = 0; x < camera.intrinsics.width; x += kStep) {
    if (hits(x)) {
      right = x;
      left = x - kStep;
      break;
    }
  }
  if (right < kStep) return -1;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (left + right);
    (hits(middle) ? right : left) = middle;
  }
  return right;
}

/// How far images of that block have its left edge from where rays cast through the model meet
/// it.
struct EdgeErrors {
  double ids = 0;
  double colors = 0;
  int rows = 0;
};

void add_errors(const Frame& frame, EdgeErrors& errors) {
  for (int y = 1; y + 1 < frame.height(); ++y) {
    const double edge = edge_in_row(frame.camera, y);
    const double slope = edge_in_row(frame.camera, y + 1) - edge_in_row(frame.camera, y - 1);
    if (edge < 12 || edge > frame.width() - 12 || std::abs(slope) > 1) continue;
    const int near = static_cast<int>(edge);
    const int left = brightness(frame, near - 5, y);
    const int right = brightness(frame, near + 6, y);
    if (std::abs(left - right) < 90) continue;
    int first = near - 4;
    while (frame.id[pixel_index(frame, first, y)] != kIdBuilding && first < near + 4) ++first;
    ASSERT_LT(std::abs(first - 0.5 - edge), 1.3) << "row " << y;
    double covered = 0;
    for (int x = near - 4; x <= near + 5; ++x) {
      covered += static_cast<double>(brightness(frame, x, y) - right) / (left - right);
    }
    errors.ids += first - 0.5 - edge;
    errors.colors += near - 4 - 0.5 + covered - edge;
    ++errors.rows;
  }
}

TEST(Lens, EdgesAreWhereTheModelShowsThem) {
  // In a draft walls and ground are of one color each, or nearly so.
  Set set(open_ground({block(4, 5, -3, 0, 6)}), {.quality = Quality::draft});
  for (const Distortion& distortion : {barrel(), pincushion(), fisheye()}) {
    EdgeErrors errors;
    for (int i = 0; i < 12; ++i) {
      add_errors(set.draw(through(camera_at({-5, -2, 7}, 3 + 1.57 * i, -24 - 0.9 * i, 640, 480, 70),
                                  distortion)),
                 errors);
    }
    ASSERT_GT(errors.rows, 1000);
    EXPECT_NEAR(errors.ids / errors.rows, 0, 0.05);
    EXPECT_NEAR(errors.colors / errors.rows, 0, 0.1);
  }
}

TEST(Lens, DepthIsTheCamerasZ) {
  Set set(open_ground());
  for (const Distortion& distortion : {barrel(), fisheye()}) {
    const Camera camera = through(camera_at({0, 0, 10}, 0, -60), distortion);
    const Frame frame = set.draw(camera);
    double error = 0;
    for (int y = 0; y < frame.height(); y += 3) {
      for (int x = 0; x < frame.width(); x += 3) {
        const double depth = frame.depth_m[pixel_index(frame, x, y)];
        const Vector3d ground = camera.unproject({x, y}, depth);
        EXPECT_LT(std::abs(ground.z()), 0.06) << x << ' ' << y;
        error += ground.z();
      }
    }
    EXPECT_NEAR(error / (320.0 * 240 / 9), 0, 0.002);
  }
}

TEST(Lens, PeoplesBoxesAndAreasAreThoseOfTheDistortedImage) {
  Set set(open_ground({block(-1, 0, -3, 3, 1.2)}));
  Set open(open_ground());
  for (const Distortion& distortion : {barrel(), pincushion(), fisheye()}) {
    const Camera camera = through(camera_at({-8, 0, 3}, 5, -14, 640, 480), distortion);
    std::size_t hidden = 0;
    for (std::uint32_t i = 0; i < 8; ++i) {
      const PersonInstance person = open.stage.standing(i, 3.0, 0.7 * i - 2.2, 0.6 * i);
      const Frame alone = open.draw(camera, {person});
      const Mask mask = instance_mask(alone, id_of_agent(i));
      const PersonInView& truth = find_person(alone, i);
      EXPECT_EQ(truth.amodal_area_px, mask.pixels);
      EXPECT_LT((truth.amodal_box.min() - mask.box.min()).cwiseAbs().maxCoeff(), 1.5);
      EXPECT_LT((truth.amodal_box.max() - mask.box.max()).cwiseAbs().maxCoeff(), 1.5);

      const Frame behind = set.draw(camera, {person});
      EXPECT_EQ(find_person(behind, i).amodal_area_px, mask.pixels);
      EXPECT_TRUE(find_person(behind, i).amodal_box.isApprox(truth.amodal_box));
      hidden += instance_mask(behind, id_of_agent(i)).pixels < mask.pixels ? 1 : 0;
    }
    EXPECT_GT(hidden, 3U);
  }
}

TEST(Lens, VisibleNeverExceedsAmodalAndAllVisiblePeopleAreListed) {
  Set set(open_ground({block(2, 5, -2, 1, 2)}));
  const std::vector<PersonInstance> crowd = scatter_people(set.stage, 250, 7);
  for (const Distortion& distortion : {barrel(), pincushion(), fisheye()}) {
    for (const Camera& camera :
         {camera_at({-9, 2, 4}, -10, -20), camera_at({0.3, 0.2, 1.5}, 70, -5)}) {
      const Frame frame = set.draw(through(camera, distortion), crowd);
      for (const PersonInView& person : frame.people) {
        EXPECT_LE(instance_mask(frame, id_of_agent(person.agent)).pixels, person.amodal_area_px);
        EXPECT_TRUE(person.amodal_box.min().allFinite() && person.amodal_box.max().allFinite());
      }
      for (const std::uint32_t id : frame.id) {
        if (!is_agent(id)) continue;
        ASSERT_NO_THROW(find_person(frame, agent_of_id(id)));
      }
    }
  }
}

TEST(Lens, StripsOfRowsMakeUpTheImage) {
  Set set(open_ground({block(2, 5, -2, 1, 2)}));
  Scene scene;
  scene.people = scatter_people(set.stage, 40, 5);
  const Camera pinhole = camera_at({-9, 2, 6}, -10, -30);
  for (const Camera& camera : {pinhole, through(pinhole, barrel())}) {
    const Frame whole = set.lens.draw(scene, camera);
    std::vector<std::uint32_t> ids;
    std::vector<std::uint8_t> rgb;
    std::unordered_map<std::uint32_t, std::uint64_t> areas;
    std::unordered_map<std::uint32_t, Eigen::AlignedBox2d> boxes;
    for (const Rows rows : {Rows{0, 100}, Rows{100, 101}, Rows{101, 240}}) {
      const Frame strip = set.lens.draw_rows(scene, camera, rows);
      ids.insert(ids.end(), strip.id.begin(), strip.id.end());
      rgb.insert(rgb.end(), strip.rgb.begin(), strip.rgb.end());
      for (const PersonInView& person : strip.people) {
        areas[person.agent] += person.amodal_area_px;
        boxes[person.agent].extend(person.amodal_box);
      }
    }
    ASSERT_EQ(ids.size(), whole.id.size());
    std::size_t differing = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) differing += ids[i] != whole.id[i] ? 1 : 0;
    // The strips' wide images have other pixels than the whole's.
    EXPECT_LE(differing, camera.intrinsics.distortion ? ids.size() / 100 : 3);
    // Shadows are those of the whole image; edges beside cuts are smoothed otherwise.
    std::size_t colored = 0;
    for (std::size_t i = 0; i < rgb.size(); ++i) {
      colored += std::abs(rgb[i] - whole.rgb[i]) > 8 ? 1 : 0;
    }
    EXPECT_LE(colored, camera.intrinsics.distortion ? rgb.size() / 50 : rgb.size() / 500);
    for (const PersonInView& person : whole.people) {
      const auto area = static_cast<double>(person.amodal_area_px);
      EXPECT_NEAR(static_cast<double>(areas[person.agent]), area,
                  camera.intrinsics.distortion ? 0.05 * area + 3 : 3);
      EXPECT_LT((boxes[person.agent].min() - person.amodal_box.min()).norm(), 0.02);
      EXPECT_LT((boxes[person.agent].max() - person.amodal_box.max()).norm(), 0.02);
    }
  }
}

TEST(Lens, KnowsHowWideItSees) {
  camera::Intrinsics lens = camera::intrinsics_from_hfov(640, 480, 1.2);
  lens.distortion = barrel();
  EXPECT_GT(wide_size(lens).x(), 700) << "barrels see more";
  EXPECT_LT(wide_size(lens).x(), 1000);
  const LensMap map = lens_map(lens, {0, lens.height});
  EXPECT_EQ(wide_size(lens), Eigen::Vector2i(map.wide.width, map.wide.height));
  EXPECT_TRUE(shows_everywhere(lens));
  lens.distortion.emplace(Model::brown_conrady, Distortion::Coefficients{-0.9});
  EXPECT_FALSE(shows_everywhere(lens)) << "folds within the image";
  EXPECT_GT(wide_size(lens).minCoeff(), 300);
  lens.cx_px = -9000;
  EXPECT_EQ(wide_size(lens), Eigen::Vector2i(0, 0)) << "shows nothing of it";
  lens.cx_px = 319.5;
  lens.distortion.reset();
  EXPECT_EQ(wide_size(lens), Eigen::Vector2i(640, 480));
}

}  // namespace
}  // namespace throng::render
