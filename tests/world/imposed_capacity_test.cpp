#include "world/imposed_capacity.h"

#include <gtest/gtest.h>

#include <string>

namespace throng::world {
namespace {

double per_s_by_code(const std::string& code, double width_m) {
  ImposedCapacity capacity;
  capacity.code = code;
  return capacity.per_s_at(width_m);
}

TEST(ImposedCapacity, CodesCountTheirWidth) {
  EXPECT_NEAR(per_s_by_code("sfpe", 1.2), 1.32 * 0.9, 1e-12);
  EXPECT_EQ(per_s_by_code("sfpe", 0.3), 0.01);
  EXPECT_NEAR(per_s_by_code("imo", 1.2), 1.56, 1e-12);
  EXPECT_NEAR(per_s_by_code("rimea", 2), 2.45, 1e-12);
}

TEST(ImposedCapacity, DevicesCountNoWidth) {
  ImposedCapacity three;
  three.device = "turnstile";
  three.devices = 3;
  EXPECT_NEAR(three.per_s_at(1), 150.0 / 60, 1e-12);
  EXPECT_NEAR(three.per_s_at(4), 150.0 / 60, 1e-12);
  EXPECT_EQ(three.text(), "3 x turnstile");
}

TEST(ImposedCapacity, GivenRatesAreTaken) {
  ImposedCapacity rate;
  rate.per_s = 0.75;
  EXPECT_EQ(rate.per_s_at(2), 0.75);
  EXPECT_EQ(rate.text(), "0.75 /s");
  ImposedCapacity specific;
  specific.per_ms = 1.5;
  EXPECT_EQ(specific.per_s_at(2), 3);
  EXPECT_EQ(specific.text(), "1.5 /(m s)");
}

}  // namespace
}  // namespace throng::world
