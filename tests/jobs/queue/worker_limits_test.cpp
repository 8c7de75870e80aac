#include "jobs/queue/worker_limits.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

namespace throng::jobs {
namespace {

// Limits are permanent: each test limits a process of its own.
[[noreturn]] void leave(bool is_as_expected) { ::_exit(is_as_expected ? 0 : 1); }

TEST(WorkerLimits, NoSocketLeadsOutOfTheMachine) {
  EXPECT_EXIT(
      {
        const bool was_limited = limit_this_process().find("network") == std::string::npos;
        bool refused = true;
        for (const int family : {AF_INET, AF_INET6}) {
          refused = refused && ::socket(family, SOCK_STREAM, 0) < 0 && errno == EACCES;
        }
        leave((!was_limited || refused) && ::socket(AF_UNIX, SOCK_STREAM, 0) >= 0);
      },
      testing::ExitedWithCode(0), "");
}

TEST(WorkerLimits, MemoryIsBoundedIfAsked) {
#if defined(THRONG_SANITIZE_ADDRESS) || defined(THRONG_SANITIZE_THREAD)
  GTEST_SKIP() << "sanitizers reserve terabytes of addresses";
#endif
  EXPECT_EXIT(
      {
        ::setenv(kMemoryVariable, "3000", 1);
        limit_this_process();
        rlimit limit{};
        ::getrlimit(RLIMIT_AS, &limit);
        rlimit core{};
        ::getrlimit(RLIMIT_CORE, &core);
        leave(limit.rlim_cur == 3000ULL << 20U && core.rlim_cur == 0);
      },
      testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace throng::jobs
