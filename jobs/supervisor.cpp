#include "jobs/supervisor.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace throng::jobs {

namespace {

class Supervision {
 public:
  Supervision(const JobFolder& folder, const JobSpec& job, Executor& executor,
              const OnJobProgress& on_progress, std::stop_token stop)
      : folder_(folder),
        job_(job),
        executor_(executor),
        on_progress_(on_progress),
        stop_(std::move(stop)) {
    const auto cameras = static_cast<std::int64_t>(job.drones.size());
    for (const RunPlan& run : plan_runs(job)) {
      progress_.push_back({run.index, run.seed, Stage::waiting, 0, job.capture.to_s, 0,
                           job.frames_per_camera() * cameras});
    }
  }

  void run() {
    std::vector<Task> simulations;
    std::vector<Task> frames;
    for (int run = 0; run < job_.runs; ++run) {
      simulations.push_back({Task::Kind::simulate, run});
      frames.push_back({Task::Kind::measure, run});
      for (const Shard& shard : plan_shards(job_, run)) {
        frames.push_back({Task::Kind::render, run, shard.index});
      }
    }
    const std::vector<Task> dataset = {{Task::Kind::collect}};
    if (!folder_.is_done(dataset[0])) {
      folder_.remove_leftovers();
      do_tasks(simulations);
      do_tasks(frames);
      do_tasks(dataset);
    }
    for (RunProgress& run : progress_) {
      run.stage = Stage::finished;
      run.simulated_s = run.duration_s;
      run.images_done = run.images_total;
    }
    report();
  }

 private:
  // The tasks must not depend on each other.
  void do_tasks(const std::vector<Task>& tasks) {
    std::vector<Task> open;
    for (const Task& task : tasks) {
      if (!folder_.is_done(task)) {
        open.push_back(task);
      } else if (task.kind == Task::Kind::simulate) {
        at(task).simulated_s = at(task).duration_s;
      } else if (task.kind == Task::Kind::render) {
        images_[task] = images_of(task);
      }
    }
    for (RunProgress& run : progress_) set_stage(run);
    report();
    if (open.empty()) return;
    const auto on_progress = [&](const Task& task, const TaskProgress& progress) {
      note(task, progress);
    };
    const std::vector<TaskResult> results = executor_.run(folder_, open, on_progress, stop_);
    for (std::size_t i = 0; i < open.size(); ++i) throw_if_failed(open[i], results[i]);
    if (stop_.stop_requested()) throw Cancelled();
    for (std::size_t i = 0; i < open.size(); ++i) {
      check(results[i].outcome == Outcome::succeeded, "an executor ends all tasks or says why not");
      if (!folder_.is_done(open[i])) {
        throw EnvironmentError(fmt::format(
            "{}: the worker reported success but its output is not there", name_of(open[i])));
      }
    }
  }

  static void throw_if_failed(const Task& task, const TaskResult& result) {
    if (result.outcome == Outcome::succeeded || result.outcome == Outcome::cancelled) return;
    if (result.outcome == Outcome::input_error && !result.problems.empty()) {
      throw InputError(result.problems);
    }
    const std::string message = fmt::format("{}: {}", name_of(task), result.message);
    if (result.outcome == Outcome::input_error) {
      throw InputError(Problem{"", name_of(task), result.message, "a job that can be run"});
    }
    throw EnvironmentError(result.attempts > 1
                               ? fmt::format("{} (after {} attempts)", message, result.attempts)
                               : message);
  }

  void note(const Task& task, const TaskProgress& progress) {
    if (task.kind == Task::Kind::simulate) {
      at(task).simulated_s = progress.done;
    } else if (task.kind == Task::Kind::render) {
      images_[task] = std::min(images_of(task), std::llround(progress.done));
    } else {
      return;
    }
    set_stage(at(task));
    report();
  }

  void set_stage(RunProgress& run) {
    run.images_done = 0;
    for (const auto& [task, images] : images_) {
      if (task.run == run.run) run.images_done += images;
    }
    if (run.images_done == run.images_total) {
      run.stage = Stage::rendered;
    } else if (folder_.is_done({Task::Kind::simulate, run.run})) {
      run.stage = Stage::rendering;
      run.simulated_s = run.duration_s;
    } else if (run.simulated_s > 0) {
      run.stage = Stage::simulating;
    }
  }

  long long images_of(const Task& task) const {
    const Shard shard = plan_shards(job_, task.run)[static_cast<std::size_t>(task.shard)];
    return (shard.end_frame - shard.first_frame) * static_cast<long long>(job_.drones.size());
  }

  RunProgress& at(const Task& task) { return progress_[static_cast<std::size_t>(task.run)]; }

  void report() const {
    if (on_progress_) on_progress_(progress_);
  }

  const JobFolder& folder_;
  const JobSpec& job_;
  Executor& executor_;
  const OnJobProgress& on_progress_;
  std::stop_token stop_;
  JobProgress progress_;
  std::map<Task, long long> images_;  ///< done, per shard
};

}  // namespace

std::string_view name_of(Stage stage) {
  switch (stage) {
    case Stage::waiting:
      return "waiting";
    case Stage::simulating:
      return "simulating";
    case Stage::rendering:
      return "rendering";
    case Stage::rendered:
      return "rendered";
    case Stage::finished:
      break;
  }
  return "finished";
}

void run_job(const JobFolder& folder, const JobSpec& job, Executor& executor,
             const OnJobProgress& on_progress, std::stop_token stop) {
  Supervision(folder, job, executor, on_progress, std::move(stop)).run();
}

}  // namespace throng::jobs
