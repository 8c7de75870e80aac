#include "jobs/queue/workers/injected_faults.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>

#include "base/error.h"

namespace throng::jobs {
namespace {

class Faults : public testing::Test {
 protected:
  ~Faults() override { ::unsetenv(kFaultsVariable); }
  static void set(const char* list) { ::setenv(kFaultsVariable, list, 1); }
};

TEST_F(Faults, WithoutAnyNothingHappens) { EXPECT_NO_THROW(inject_faults("run000/trace", 1)); }

TEST_F(Faults, FailAtThisPlaceForSoManyAttempts) {
  set("fail:run000/shard0001:2");
  EXPECT_THROW(inject_faults("run000/shard0001", 1), EnvironmentError);
  EXPECT_THROW(inject_faults("run000/shard0001", 2), EnvironmentError);
  EXPECT_NO_THROW(inject_faults("run000/shard0001", 3));
  EXPECT_NO_THROW(inject_faults("run000/shard0002", 1));
}

TEST_F(Faults, AStarIsAnyTaskButNotTheServer) {
  set("slow:dataset:0,fail:*");
  EXPECT_THROW(inject_faults("dataset", 7), EnvironmentError);
  EXPECT_NO_THROW(inject_faults("server/started/before", 1));
}

TEST_F(Faults, DieKillsAndSlowWaits) {
  set("die:run000/trace:1");
  EXPECT_EXIT(inject_faults("run000/trace", 1), testing::KilledBySignal(SIGKILL), "");
  set("slow:run000/trace:0.05");
  const auto start = std::chrono::steady_clock::now();
  inject_faults("run000/trace", 1);
  EXPECT_GE(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(50));
}

TEST_F(Faults, AMistakeInTheListIsNamed) {
  for (const char* list :
       {"die", "die:", "explode:dataset", "slow:dataset:x", "slow:dataset:-1", "die:dataset:1x"}) {
    EXPECT_THROW(parse_faults(list), InputError) << list;
  }
  EXPECT_EQ(parse_faults("die:a/b:2,slow:*").size(), 2U);
}

}  // namespace
}  // namespace throng::jobs
