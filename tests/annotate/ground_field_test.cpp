#include "annotate/ground_field.h"

#include <gtest/gtest.h>

#include <numeric>

#include "base/random.h"

namespace throng::annotate {
namespace {

world::Trace crowd_of(std::size_t agents) {
  world::Trace trace;
  trace.header.role.assign(agents, world::AgentRole::person);
  trace.time_s = {0, 0.5};
  for (std::size_t i = 0; i < 2 * agents; ++i) {
    Random random(9, Stream::crowd_generator, i);
    const auto x = static_cast<float>(random.uniform(-12, 12));
    trace.position.emplace_back(x, static_cast<float>(random.uniform(-6, 6)));
    trace.velocity.emplace_back(1.0F, -0.5F);
    trace.flags.push_back(world::kPresent);
  }
  return trace;
}

const world::Rectangle kGround{{-10, -5}, {10, 5.5}};

TEST(GroundField, SumsToThePeopleOnTheGround) {
  world::Trace trace = crowd_of(400);
  trace.header.role[3] = world::AgentRole::disaster;
  trace.flags[400 + 5] = 0;  // has left by the second step
  const GroundField field = ground_field(trace, kGround, 0.4);
  EXPECT_EQ(field.columns, 20);
  EXPECT_EQ(field.rows, 11);
  std::int64_t expected = 0;
  for (std::size_t agent = 0; agent < 400; ++agent) {
    const Eigen::Vector2f& at = trace.position[400 + agent];
    const bool is_counted = agent != 3 && agent != 5;
    expected += is_counted && at.x() >= -10 && at.x() < 10 && at.y() >= -5 && at.y() < 6 ? 1 : 0;
  }
  EXPECT_EQ(field.people, expected);
  EXPECT_EQ(std::accumulate(field.density.begin(), field.density.end(), 0.0),
            static_cast<double>(expected));
}

TEST(GroundField, PutsPeopleIntoTheirCellsWithTheirMeanVelocity) {
  world::Trace trace = crowd_of(3);
  trace.position[0] = trace.position[1] = {0.5F, 1.2F};
  trace.position[2] = {-9.9F, -4.9F};
  trace.velocity[1] = {3, 0.5F};
  const GroundField field = ground_field(trace, kGround, 0);
  const std::size_t cell = 6 * 20 + 10;
  EXPECT_EQ(field.density[cell], 2);
  EXPECT_EQ(field.velocity_x[cell], 2);
  EXPECT_EQ(field.velocity_y[cell], 0);
  EXPECT_EQ(field.density[0], 1);
  const std::string bytes = npy_bytes(field);
  EXPECT_NE(bytes.find("'shape': (3, 11, 20)"), std::string::npos);
  EXPECT_EQ(bytes.size() % 64, (3 * 11 * 20 * 4) % 64);
}

}  // namespace
}  // namespace throng::annotate
