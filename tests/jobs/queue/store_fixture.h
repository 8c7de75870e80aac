// A job store in a folder of its own, by a clock that the test sets.
#pragma once

#include <gtest/gtest.h>

#include "jobs/queue/store/store.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {

class StoreTest : public testing::Test {
 protected:
  Store::Clock clock() {
    return [this] { return now_ms; };
  }

  TemporaryFolder folder;
  std::int64_t now_ms = 1'000'000;
};

}  // namespace throng::jobs
