// The people that set-up baked. Tests of them are skipped where there are none, as on a machine
// where set-up has not run.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "skinning/population.h"

namespace throng::skinning {

/// Loads them once for all tests of a suite.
class BakedPeopleTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (std::filesystem::exists(population_folder() / "population.json")) {
      people_ = std::make_unique<Population>(load_population(population_folder()));
    }
  }
  static void TearDownTestSuite() { people_.reset(); }
  void SetUp() override {
    if (!people_) {
      GTEST_SKIP() << "no baked people in " << population_folder()
                   << ": run scripts/setup.sh or set THRONG_PEOPLE";
    }
  }

  inline static std::unique_ptr<Population> people_;
};

}  // namespace throng::skinning
