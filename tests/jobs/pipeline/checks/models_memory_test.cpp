#include "jobs/pipeline/checks/models_memory.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "base/error.h"
#include "base/files/files.h"
#include "jobs/pipeline/checks/resolve.h"
#include "spec/estimates/task_memory.h"
#include "tests/jobs/yard.h"

namespace throng::jobs {
namespace {

/// A square of `side` x `side` vertices, as OBJ.
std::string grid_obj(int side) {
  std::string text;
  for (int i = 0; i < side * side; ++i) {
    text += fmt::format("v {} 0 {}\n", i % side, i / side);
  }
  for (int y = 1; y < side; ++y) {
    for (int x = 1; x < side; ++x) {
      const int at = (y - 1) * side + x;
      text += fmt::format("f {} {} {}\nf {} {} {}\n", at, at + side, at + 1, at + 1, at + side,
                          at + side + 1);
    }
  }
  return text;
}

class ModelsMemory : public testing::Test {
 protected:
  ModelsMemory() { write_file_atomically(folder.path() / "grid.obj", grid_obj(kSide)); }

  std::int64_t mib_of(int meshes, int props = 0) const {
    world::Scenario scenario;
    for (int i = 0; i < meshes; ++i) scenario.meshes.push_back({folder.path() / "grid.obj"});
    scenario.props.resize(static_cast<std::size_t>(props));
    return models_memory_mib(scenario);
  }

  static constexpr int kSide = 200;  // 79 202 triangles
  TemporaryFolder folder;
};

// Measured with a million triangles: 317 MiB for the first placement (OBJ), 62 MiB for each further
// one, at least.
TEST_F(ModelsMemory, MeshesCountAsTheyAreReadAndPlaced) {
  const std::int64_t none = mib_of(0);
  EXPECT_GE(mib_of(1), none + 26);
  EXPECT_LE(mib_of(1), none + 60);
  EXPECT_GE(mib_of(41), mib_of(1) + 40 * 5);
  EXPECT_LE(mib_of(41), mib_of(1) + 40 * 10);
}

TEST_F(ModelsMemory, PropsCount) {
  EXPECT_GE(mib_of(0, 1000), mib_of(0) + 40);  // measured with trees
}

TEST_F(ModelsMemory, AResolvedJobCarriesItToTheEstimate) {
  write_yard(folder.path());
  const ResolvedJob job = resolve_job({{"scenario", "yard"}}, "", folder.path());
  EXPECT_GT(job.load().models_mib, 0);
  const Task kShard{Task::Kind::render};
  SceneLoad heavier = job.load();
  heavier.models_mib += 1000;
  EXPECT_EQ(TaskMemory(job.spec(), heavier).mib_of(kShard),
            TaskMemory(job.spec(), job.load()).mib_of(kShard) + 1000);
}

TEST_F(ModelsMemory, AMeshThatCannotBeReadIsNamed) {
  write_file_atomically(folder.path() / "grid.obj", "nothing");
  EXPECT_THROW(mib_of(1), InputError);
}

}  // namespace
}  // namespace throng::jobs
