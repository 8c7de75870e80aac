// Limits of memory: sanitizers reserve terabytes of addresses, so this program runs with the
// release build.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "jobs/queue/confine/worker_limits.h"
#include "tests/jobs/queue/perform_in_child.h"

namespace throng::jobs {
namespace {

TEST(MemoryLimits, AConfinedChildHasOne) {
  const auto greedy = [](const nlohmann::json&) {
    return nlohmann::json{{"size", std::string(std::size_t{5} << 30U, 'x').size()}};
  };
  EXPECT_THAT(performed_in_child(greedy, 2)[0]["found"].get<std::string>(),
              testing::HasSubstr("4 GiB"));
}

TEST(MemoryLimits, OfAWorkerAreSetIfAsked) {
  EXPECT_EXIT(
      {
        ::setenv(kMemoryVariable, "3000", 1);
        ::setenv(kDataVariable, "2000", 1);
        limit_this_process();
        rlimit limit{};
        ::getrlimit(RLIMIT_AS, &limit);
        rlimit data{};
        ::getrlimit(RLIMIT_DATA, &data);
        int score = 0;
        std::ifstream("/proc/self/oom_score_adj") >> score;
        rlimit core{};
        ::getrlimit(RLIMIT_CORE, &core);
        ::_exit(::prctl(PR_GET_DUMPABLE, 0, 0, 0, 0) == 0 && limit.rlim_cur == 3000ULL << 20U &&
                        data.rlim_cur == 2000ULL << 20U && core.rlim_cur == 0 && score == 500
                    ? 0
                    : 1);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace throng::jobs
