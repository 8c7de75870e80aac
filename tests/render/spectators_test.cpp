// People on a stand, with the baked population where it has been built.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <tuple>

#include "render/animator.h"
#include "render/props/prop_shapes.h"
#include "tests/render/stage.h"
#include "world/clutter/sitters.h"
#include "world/stand_seats.h"

namespace throng::render {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

world::Stand tier() {
  world::Stand stand;
  stand.from = {-8, -2};
  stand.to = {8, -2};
  stand.rows = 6;
  return stand;
}

/// Each spectator in a state all the time; states as in world::kStandStates.
world::Trace made_trace(const std::vector<world::Seat>& seats, std::uint8_t state) {
  world::Trace trace;
  trace.header.dt_s = 0.1;
  trace.header.seed = 5;
  for (const std::string_view name : world::kStandStates)
    trace.header.state_names.emplace_back(name);
  trace.header.role.assign(seats.size(), world::AgentRole::spectator);
  trace.header.radius_m.assign(seats.size(), 0.24F);
  for (int step = 0; step < 41; ++step) {
    trace.time_s.push_back(0.1 * step);
    for (const world::Seat& seat : seats) {
      const Vector2d ahead(0, state == 0 ? 0 : 0.3);
      trace.position.push_back((seat.position + ahead).cast<float>());
      trace.velocity.push_back(Eigen::Vector2f::Zero());
      trace.yaw_rad.push_back(static_cast<float>(EIGEN_PI / 2));
      trace.state.push_back(state);
      trace.flags.push_back(world::kPresent);
    }
  }
  return trace;
}

class OnAStand : public testing::Test {
 protected:
  void SetUp() override {
    const std::filesystem::path folder = skinning::population_folder();
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no people in " << folder;
    people_ = skinning::load_population(folder);
    scenario_ = open_ground();
    scenario_.stands = {tier()};
    const std::vector<world::Seat> all = world::seats(tier());
    for (std::size_t i = 0; i < all.size(); i += 7) seats_.push_back(all[i]);
  }

  Scene scene_in(std::uint8_t state) const {
    const world::Trace trace = made_trace(seats_, state);
    return Animator(trace, people_, {}, scenario_.stands).scene_at(2.05, 0);
  }
  Frame draw(const Scene& scene) const {
    Renderer renderer(scenario_, people_, {}, {"software"});
    return renderer.draw(scene, camera_at({0, 14, 9}, -90, -25, 1280, 960));
  }

  skinning::Population people_;
  world::Scenario scenario_;
  std::vector<world::Seat> seats_;
};

TEST_F(OnAStand, PeopleAreOnTheirSeats) {
  const Scene scene = scene_in(0);
  ASSERT_EQ(scene.people.size(), seats_.size());
  const Frame frame = draw(scene);
  ASSERT_EQ(frame.people.size(), seats_.size());
  for (const PersonInView& person : frame.people) {
    const world::Seat& seat = seats_[person.agent];
    const Vector3d floor(seat.position.x(), seat.position.y(), seat.height_m);
    EXPECT_TRUE(person.position.isApprox(floor, 1e-5));
    // The pelvis is a hand above the seat, the head well above it, the feet on the floor.
    EXPECT_NEAR((person.hips - floor).head<2>().norm(), 0, 0.12);
    EXPECT_NEAR(person.hips.z() - floor.z(), world::kSeatHeightM + 0.1, 0.07);
    const double bottom_m = static_cast<double>(person.box_middle.z() - person.box_size.z() / 2);
    EXPECT_NEAR(bottom_m, floor.z(), 0.03);
    const Vector2d pixel = frame.camera.project(person.hips).pixel.array() + 0.5;
    EXPECT_TRUE(person.amodal_box.contains(pixel));
    const Mask mask = instance_mask(frame, id_of_agent(person.agent));
    if (mask.pixels == 0) continue;  // behind others
    EXPECT_GE(mask.box.min().y(), person.amodal_box.min().y() - 1);
    EXPECT_LE(mask.box.max().y(), person.amodal_box.max().y() + 1);
    EXPECT_GE(mask.box.min().x(), person.amodal_box.min().x() - 1);
    EXPECT_LE(mask.box.max().x(), person.amodal_box.max().x() + 1);
  }
}

TEST_F(OnAStand, SittersOfPropsAreOnTheirSeats) {
  scenario_.stands.clear();
  for (const auto& [kind, x, scale] : {std::tuple(world::PropKind::bench, -4.0, 1.0),
                                       std::tuple(world::PropKind::beer_table, 0.0, 1.1),
                                       std::tuple(world::PropKind::cafe_table, 4.0, 0.95)}) {
    world::Prop prop;
    prop.kind = kind;
    prop.position = {x, 2};
    prop.scale = scale;
    scenario_.props.push_back(prop);
  }
  world::seat_people({1, 0}, scenario_);
  ASSERT_EQ(scenario_.sitters.size(), 3U + 6 + 2);
  seats_.clear();
  for (const world::Sitter& sitter : scenario_.sitters) {
    seats_.emplace_back().position = sitter.position;
  }
  const world::Trace trace = made_trace(seats_, 0);
  const Animator animator(trace, people_, {}, {}, scenario_.sitters);
  const Frame frame = draw(animator.scene_at(2.05, 0));
  ASSERT_EQ(frame.people.size(), seats_.size());
  for (const PersonInView& person : frame.people) {
    const world::Sitter& sitter = scenario_.sitters[person.agent];
    const world::Prop& prop = scenario_.props[sitter.prop];
    const double seat_m = prop.scale * world::prop_seats(prop.kind)[0].height_m;
    EXPECT_NEAR(person.position.z(), seat_m - world::kSeatHeightM, 1e-6);
    EXPECT_NEAR((person.hips.head<2>() - sitter.position).norm(), 0, 0.12);
    EXPECT_NEAR(person.hips.z() - seat_m, 0.1, 0.07) << "a hand above the seat";
    EXPECT_TRUE(person.actions.has(skinning::Action::sit));
  }
  EXPECT_EQ(animator.actions_at(0, 7), skinning::Actions(skinning::Action::sit));
}

/// Whether a ray straight down meets a triangle near a height.
bool is_surface_at(const PropMesh& mesh, const Vector2d& place, double height_m, double slack_m) {
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    std::array<Vector3d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& at = mesh.vertices[mesh.indices[i + k]].position;
      corner.at(k) = Vector3d(at[0], at[1], at[2]);
    }
    Eigen::Matrix3d lines;
    for (int k = 0; k < 3; ++k) {
      lines.col(k) << corner.at(static_cast<std::size_t>(k)).head<2>(), 1;
    }
    if (std::abs(lines.determinant()) < 1e-9) continue;
    const Vector3d shares = lines.inverse() * Vector3d(place.x(), place.y(), 1);
    if (shares.minCoeff() < 0) continue;
    const double z = shares.dot(Vector3d(corner[0].z(), corner[1].z(), corner[2].z()));
    if (std::abs(z - height_m) <= slack_m) return true;
  }
  return false;
}

TEST(PropSeats, AreOnTheShapesOfAllLooks) {
  for (std::size_t i = 0; i < world::kPropKinds; ++i) {
    world::Prop prop;
    prop.kind = static_cast<world::PropKind>(i);
    for (const world::PropSeat& seat : world::prop_seats(prop.kind)) {
      for (prop.look = 0; prop.look < 24; ++prop.look) {
        EXPECT_TRUE(is_surface_at(prop_shape(prop, 7), seat.position, seat.height_m, 0.025))
            << world::prop_type(prop.kind).name << " at " << seat.position.transpose()
            << " of look " << prop.look;
      }
    }
  }
}

TEST_F(OnAStand, SittersAreLowerThanThoseWhoStandAndThoseWhoCheer) {
  const Scene sitting = scene_in(0);
  const Scene standing = scene_in(1);
  const Scene cheering = scene_in(2);
  const Frame sits = draw(sitting);
  const Frame stands = draw(standing);
  const Frame cheers = draw(cheering);
  ASSERT_EQ(sits.people.size(), stands.people.size());
  ASSERT_EQ(sits.people.size(), cheers.people.size());
  for (std::size_t i = 0; i < sits.people.size(); ++i) {
    const double stature_m = stands.people[i].stature_m;
    const auto height = [](const PersonInView& person) {
      return static_cast<double>(person.box_size.z());
    };
    EXPECT_GT(height(stands.people[i]), 0.9 * stature_m);
    // Anthropometric tables have the sitting height, of children and adults, near half the stature;
    // some lean forward.
    EXPECT_GT(height(sits.people[i]) - world::kSeatHeightM, 0.4 * stature_m);
    EXPECT_LT(height(sits.people[i]) - world::kSeatHeightM, 0.6 * stature_m);
    EXPECT_LT(height(sits.people[i]), 0.95 * height(stands.people[i]));
    EXPECT_GT(height(cheers.people[i]), height(stands.people[i]) - 0.02);
    EXPECT_TRUE(sits.people[i].actions.has(skinning::Action::sit));
    EXPECT_TRUE(cheers.people[i].actions.has(skinning::Action::cheer));
  }
}

TEST_F(OnAStand, BodiesMoveSmoothlyBetweenPostures) {
  world::Trace trace = made_trace({seats_.front()}, 0);
  // Sits, stands from 1 s on, cheers from 2 s on, sits from 3.5 s on.
  for (std::size_t step = 0; step < trace.steps(); ++step) {
    trace.state[step] = step < 10 ? 0 : step < 20 ? 1 : step < 35 ? 2 : 0;
  }
  const Animator animator(trace, people_, {}, scenario_.stands);
  const auto joints = [&](double time_s) {
    const PersonInstance person = animator.scene_at(time_s, 0).people.front();
    const skinning::Palette a = people_.palette(person.appearance.character, person.pose.a);
    const skinning::Palette b = people_.palette(person.appearance.character, person.pose.b);
    Eigen::Matrix<float, 3, skinning::kBoneCount> places;
    const skinning::Character& body = people_.characters[person.appearance.character];
    for (int bone = 0; bone < skinning::kBoneCount; ++bone) {
      const auto i = static_cast<std::size_t>(bone);
      const skinning::BoneMatrix m = (1 - person.pose.blend) * a[i] + person.pose.blend * b[i];
      places.col(bone) = m * body.joints[i].homogeneous();
    }
    return places;
  };
  constexpr double kDtS = 0.01;
  auto before = joints(0);
  for (double time_s = kDtS; time_s < 4; time_s += kDtS) {
    const auto now = joints(time_s);
    const float moved = (now - before).colwise().norm().maxCoeff();
    EXPECT_LT(moved, 0.07F) << "at " << time_s;  // 7 m/s: hands that go up
    before = now;
  }
}

}  // namespace
}  // namespace throng::render
