#include "spec/job/plan.h"

#include <gtest/gtest.h>

#include <set>

#include "base/error.h"

namespace throng::jobs {
namespace {

JobSpec job_with(double to_s, double rate_hz, int cameras, int runs) {
  JobSpec job;
  job.capture = {rate_hz, 0, to_s, {}};
  job.drones.resize(static_cast<std::size_t>(cameras));
  job.runs = runs;
  return job;
}

TEST(Plan, FramesIncludeBothEnds) {
  EXPECT_EQ(job_with(60, 1, 1, 1).frames_per_camera(), 61);
  EXPECT_EQ(job_with(0.3, 10, 1, 1).frames_per_camera(), 4);
  JobSpec one_instant = job_with(5, 2, 1, 1);
  one_instant.capture.from_s = 5;
  EXPECT_EQ(one_instant.frames_per_camera(), 1);
  EXPECT_DOUBLE_EQ(one_instant.frame_time_s(0), 5);
}

TEST(Plan, ShardsPartitionTheFramesInOrder) {
  for (const double to_s : {0.5, 1.0, 2.0, 29.0, 30.0, 119.0, 120.0, 121.0, 1000.0}) {
    const JobSpec job = job_with(to_s, 1, 2, 1);
    std::int64_t next = 0;
    int index = 0;
    for (const Shard& shard : plan_shards(job, 0)) {
      EXPECT_EQ(shard.index, index++);
      EXPECT_EQ(shard.first_frame, next);
      EXPECT_GT(shard.end_frame, shard.first_frame);
      EXPECT_LE(shard.end_frame - shard.first_frame, 30);
      next = shard.end_frame;
    }
    EXPECT_EQ(next, job.frames_per_camera());
  }
}

TEST(Plan, AShortRunUsesSeveralCoresIfItsImagesTakeLong) {
  JobSpec job = job_with(19, 1, 1, 1);
  job.quality = render::Quality::high;
  job.drones[0].camera.width = 3840;
  job.drones[0].camera.height = 2160;
  EXPECT_EQ(plan_shards(job, 0).size(), 4U);
}

TEST(Plan, AShortRunOfQuickImagesStartsOneWorker) {
  JobSpec job = job_with(19, 1, 1, 1);
  job.quality = render::Quality::draft;
  job.drones[0].camera.width = 320;
  job.drones[0].camera.height = 240;
  EXPECT_EQ(plan_shards(job, 0).size(), 1U);
  job.agents = 60000;  // take longer than the pixels
  EXPECT_EQ(plan_shards(job, 0).size(), 4U);
}

TEST(Plan, RunSeedsDifferAndDoNotDependOnTheirNumber) {
  JobSpec few = job_with(1, 1, 1, 3);
  JobSpec many = job_with(1, 1, 1, 50);
  std::set<std::uint64_t> seeds;
  for (const RunPlan& run : plan_runs(many)) seeds.insert(run.seed);
  EXPECT_EQ(seeds.size(), 50U);
  for (const RunPlan& run : plan_runs(few)) {
    EXPECT_EQ(run.seed, plan_runs(many)[static_cast<std::size_t>(run.index)].seed);
  }
  many.seed = 2;
  EXPECT_NE(plan_runs(many)[0].seed, plan_runs(few)[0].seed);
}

TEST(Plan, ImageIdsAreUniqueOverTheJob) {
  const JobSpec job = job_with(6, 1, 3, 4);
  std::set<std::int64_t> ids;
  for (int run = 0; run < 4; ++run) {
    for (std::size_t camera = 0; camera < 3; ++camera) {
      for (std::int64_t frame = 0; frame < 7; ++frame) {
        ids.insert(image_id(job, run, camera, frame));
      }
    }
  }
  EXPECT_EQ(ids.size(), 4U * 3U * 7U);
  EXPECT_EQ(*ids.begin(), 1);
}

TEST(Plan, AsManyPreviewsAsAskedForOrAsThereAreFrames) {
  for (const int wanted : {0, 1, 3, 4, 100}) {
    for (int frames = 1; frames < 40; ++frames) {
      JobSpec job = job_with(frames - 1, 1, 1, 1);
      if (frames == 1) job.capture = {1, 0, 0.5, {}};
      job.outputs.previews = wanted;
      int previews = 0;
      for (std::int64_t frame = 0; frame < frames; ++frame) previews += has_preview(job, frame);
      EXPECT_EQ(previews, std::min(wanted, frames)) << frames;
    }
  }
}

TEST(Plan, TaskNamesAreUniqueAndReadBack) {
  const JobSpec job = job_with(100, 1, 1, 2);
  std::vector<Task> tasks = {{Task::Kind::collect}, {Task::Kind::publish}};
  for (int run = 0; run < 2; ++run) {
    tasks.push_back({Task::Kind::simulate, run});
    tasks.push_back({Task::Kind::measure, run});
    for (const Shard& shard : plan_shards(job, run)) {
      tasks.push_back({Task::Kind::render, run, shard.index});
    }
  }
  std::set<std::string> names;
  for (const Task& task : tasks) {
    names.insert(to_string(task));
    EXPECT_EQ(task_named(job, to_string(task)), task);
  }
  EXPECT_EQ(names.size(), tasks.size());
  for (const char* unknown : {"", "run002/trace", "run000/shard0099", "../dataset", "run000"}) {
    EXPECT_THROW(task_named(job, unknown), InputError) << unknown;
  }
}

}  // namespace
}  // namespace throng::jobs
