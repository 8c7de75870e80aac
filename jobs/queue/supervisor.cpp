#include "jobs/queue/supervisor.h"
#include "jobs/queue/workers/attempts.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <set>
#include <span>

#include "jobs/queue/dataset/folder_lock.h"
#include "jobs/queue/delivery.h"
#include "jobs/queue/failed_runs.h"
#include "jobs/queue/machine_speed.h"
#include "jobs/queue/trace_seal.h"

namespace throng::jobs {

namespace {

using Clock = std::chrono::steady_clock;

// Counts images since it was made.
class Speedometer {
 public:
  explicit Speedometer(std::int64_t done) : done_before_(done) {}

  RenderRate pace(std::int64_t done, std::int64_t total) const {
    const double elapsed_s = std::chrono::duration<double>(Clock::now() - since_).count();
    if (done <= done_before_ || elapsed_s <= 0) return {};
    const double rate = static_cast<double>(done - done_before_) / elapsed_s;
    return {rate, static_cast<double>(total - done) / rate};
  }

 private:
  std::int64_t done_before_;
  Clock::time_point since_ = Clock::now();
};

class Supervision {
 public:
  Supervision(const JobFolder& folder, const JobSpec& job, Executor& executor,
              const OnJobProgress& on_progress, std::stop_token stop, Share share)
      : folder_(folder),
        job_(job),
        executor_(executor),
        on_progress_(on_progress),
        stop_(std::move(stop)),
        share_(std::move(share)) {
    const auto cameras = static_cast<std::int64_t>(job.drones.size());
    for (const RunPlan& run : plan_runs(job)) {
      progress_.runs.push_back({run.index,
                                run.seed,
                                Stage::waiting,
                                0,
                                job.capture.end_s(),
                                0,
                                job.frames_per_camera() * cameras,
                                {}});
    }
  }

  std::vector<RunFailure> run() {
    forget_failed_runs(folder_);
    const Task dataset{Task::Kind::collect};
    if (!folder_.is_done(dataset)) {
      folder_.remove_leftovers();
      share_.later_tasks = 1;  // the dataset
      for (const RunProgress& run : progress_.runs) {
        share_.later_tasks += tasks_of_frames(run.run).size();
      }
      simulate();
      share_.later_tasks = 1;
      make_frames();
      share_.later_tasks = 0;
      do_task(dataset);
      if (is_measured_) learn_machine_speed(share_.speed_file, folder_, job_, cpu_s_);
    }
    progress_.shards.clear();
    progress_.pace = {};
    if (!job_.outputs.publish.empty()) publish();
    end_all_attempts(folder_);
    finish_runs(Stage::finished);
    report();
    return std::move(failures_);
  }

 private:
  /// All runs but those that failed have everything done that is theirs.
  void finish_runs(Stage stage) {
    for (RunProgress& run : progress_.runs) {
      if (run.stage == Stage::failed) continue;
      run.stage = stage;
      run.simulated_s = run.duration_s;
      run.images_done = run.images_total;
      run.pace = {};
    }
  }

  void publish() {
    const Task task{Task::Kind::publish};
    DeliveryProgress& delivery = progress_.delivery.emplace();
    delivery.address = job_.outputs.publish;
    if (!folder_.is_done(task)) {
      finish_runs(Stage::publishing);
      report();
      do_task(task, [&](const Task&, const TaskProgress& progress) {
        delivery.bytes_done = std::llround(progress.done);
        delivery.bytes_total = std::llround(progress.total);
        report();
      });
    }
    const std::optional<Delivery> done = read_delivery(folder_);
    check(done.has_value(), "what is done has its output");
    delivery.bytes_done = delivery.bytes_total = done->bytes;
    delivery.objects = done->objects;
  }

  template <typename TasksOf>
  std::vector<Task> tasks_of_all_runs(const TasksOf& tasks_of) const {
    std::vector<Task> tasks;
    for (const RunProgress& run : progress_.runs) {
      if (run.stage == Stage::failed) continue;
      for (const Task& task : tasks_of(run.run)) tasks.push_back(task);
    }
    return tasks;
  }

  std::vector<Task> tasks_of_frames(int run) const {
    std::vector<Task> tasks = {{Task::Kind::measure, run}};
    for (const Shard& shard : plan_shards(job_, run)) {
      tasks.push_back({Task::Kind::render, run, shard.index});
    }
    return tasks;
  }

  void simulate() {
    for (const RunProgress& run : progress_.runs) {
      const std::vector<Task> frames = tasks_of_frames(run.run);
      const bool is_needed = std::any_of(frames.begin(), frames.end(), [this](const Task& task) {
        return !folder_.is_done(task);
      });
      if (is_needed) remove_if_damaged(folder_.output_of({Task::Kind::simulate, run.run}));
    }
    do_tasks(tasks_of_all_runs([](int run) {
      return std::vector<Task>{{Task::Kind::simulate, run}};
    }));
  }

  void make_frames() {
    do_tasks(tasks_of_all_runs([this](int run) { return tasks_of_frames(run); }));
    note_failures();
  }

  // The tasks must not depend on each other.
  void do_tasks(const std::vector<Task>& tasks) {
    std::vector<Task> open;
    for (const Task& task : tasks) {
      if (!folder_.is_done(task)) {
        open.push_back(task);
      } else if (task.kind == Task::Kind::simulate) {
        at(task).simulated_s = at(task).duration_s;
      } else if (task.kind == Task::Kind::render) {
        images_[task] = count_images(task);
      }
    }
    for (RunProgress& run : progress_.runs) {
      if (folder_.is_done({Task::Kind::simulate, run.run})) simulated_.insert(run.run);
      set_stage(run);
    }
    speeds_.clear();
    total_speed_.reset();
    report();
    if (open.size() < tasks.size()) is_measured_ = false;
    if (open.empty()) return;
    const auto on_progress = [&](const Task& task, const TaskProgress& progress) {
      record_progress(task, progress);
    };
    const std::vector<TaskResult> results = execute(open, on_progress);
    for (std::size_t i = 0; i < open.size(); ++i) take_failure(open[i], results[i]);
    if (stop_.stop_requested()) throw Cancelled();
    for (const Task& task : open) {
      if (folder_.is_done(task) || at(task).stage == Stage::failed) continue;
      throw EnvironmentError(fmt::format(
          "{}: the worker reported success but its output is not there", to_string(task)));
    }
  }

  // A worker that was killed leaves what it had half-written; once all have ended nobody needs it.
  std::vector<TaskResult> execute(std::span<const Task> tasks,
                                  const Executor::OnProgress& on_progress) {
    std::vector<TaskResult> results = executor_.run(folder_, tasks, on_progress, stop_, share_);
    folder_.remove_leftovers();
    for (const TaskResult& result : results) {
      cpu_s_ += result.cpu_s;
      if (result.cpu_s <= 0 || result.attempts != 1) is_measured_ = false;
    }
    return results;
  }

  // A task of all runs together: its failure is the job's.
  void do_task(const Task& task, const Executor::OnProgress& on_progress = {}) {
    const std::array tasks = {task};
    TaskResult result = execute(tasks, on_progress)[0];
    if (stop_.stop_requested()) throw Cancelled();
    if (task.kind == Task::Kind::collect && result.outcome == Outcome::environment_error &&
        lacks_output()) {
      // It has removed output that was damaged.
      simulate();
      make_frames();
      result = execute(tasks, {})[0];
      if (stop_.stop_requested()) throw Cancelled();
    }
    throw_if_wrong(task, result);
    if (result.outcome != Outcome::succeeded) throw EnvironmentError(text_of(task, result));
    if (!folder_.is_done(task)) {
      throw EnvironmentError(fmt::format(
          "{}: the worker reported success but its output is not there", to_string(task)));
    }
  }

  bool lacks_output() const {
    const auto tasks = tasks_of_all_runs([this](int run) { return tasks_of_frames(run); });
    return std::any_of(tasks.begin(), tasks.end(),
                       [this](const Task& task) { return !folder_.is_done(task); });
  }

  static void throw_if_wrong(const Task& task, const TaskResult& result) {
    if (result.outcome != Outcome::input_error) return;
    if (!result.problems.empty()) throw InputError(result.problems);
    throw InputError(Problem{"", to_string(task), result.message, "a job that can be run"});
  }

  static std::string text_of(const Task& task, const TaskResult& result) {
    const std::string message = fmt::format("{}: {}", to_string(task), result.message);
    return result.attempts > 1 ? fmt::format("{} (after {} attempts)", message, result.attempts)
                               : message;
  }

  void take_failure(const Task& task, const TaskResult& result) {
    if (result.outcome == Outcome::succeeded || result.outcome == Outcome::cancelled) return;
    throw_if_wrong(task, result);
    RunProgress& run = at(task);
    if (run.stage == Stage::failed) return;
    run.stage = Stage::failed;
    run.pace = {};
    failures_.push_back({run.run, to_string(task), text_of(task, result), result.attempts});
    report();
  }

  // Throws EnvironmentError when there is nothing to gather.
  void note_failures() const {
    if (failures_.empty()) return;
    if (failures_.size() == progress_.runs.size()) {
      const std::string& first = failures_.front().message;
      throw EnvironmentError(failures_.size() == 1
                                 ? first
                                 : fmt::format("all {} runs failed; {}", failures_.size(), first));
    }
    std::vector<FailedRun> runs;
    for (const RunFailure& failure : failures_) runs.push_back({failure.run, failure.task});
    std::sort(runs.begin(), runs.end(),
              [](const FailedRun& a, const FailedRun& b) { return a.run < b.run; });
    write_failed_runs(folder_, runs);
  }

  void record_progress(const Task& task, const TaskProgress& progress) {
    if (task.kind == Task::Kind::simulate) {
      at(task).simulated_s = progress.done;
    } else if (task.kind == Task::Kind::render) {
      images_[task] = std::min(count_images(task), std::llround(progress.done));
    } else {
      return;
    }
    set_stage(at(task));
    if (task.kind == Task::Kind::render) set_pace(task, progress.node);
    report();
  }

  void set_stage(RunProgress& run) {
    if (run.stage == Stage::failed) return;
    run.images_done = 0;
    for (auto shard = images_.lower_bound({Task::Kind::render, run.run});
         shard != images_.end() && shard->first.run == run.run; ++shard) {
      run.images_done += shard->second;
    }
    if (run.images_done == run.images_total) {
      run.stage = Stage::rendered;
    } else if (simulated_.contains(run.run)) {
      run.stage = Stage::rendering;
      run.simulated_s = run.duration_s;
    } else if (run.simulated_s > 0) {
      run.stage = Stage::simulating;
    }
  }

  // How fast the task, its run and the whole job are.
  void set_pace(const Task& task, const std::string& node) {
    RunProgress& run = at(task);
    const std::int64_t done = images_[task];
    const std::int64_t total = count_images(task);
    const auto speed = [&](const Task& of, std::int64_t already) -> const Speedometer& {
      return speeds_.try_emplace(of, already).first->second;
    };
    run.pace = speed({Task::Kind::simulate, run.run}, run.images_done)
                   .pace(run.images_done, run.images_total);
    auto shard = std::find_if(progress_.shards.begin(), progress_.shards.end(),
                              [&](const ShardProgress& entry) { return entry.task == task; });
    if (shard == progress_.shards.end()) {
      shard = progress_.shards.insert(shard, {task, 0, total, {}, {}});
    }
    shard->images_done = done;
    shard->node = node;
    shard->pace = speed(task, done).pace(done, total);
    if (done == total) progress_.shards.erase(shard);
    std::int64_t all_done = 0;
    std::int64_t all = 0;
    for (const RunProgress& entry : progress_.runs) {
      if (entry.stage == Stage::failed) continue;
      all_done += entry.images_done;
      all += entry.images_total;
    }
    if (!total_speed_) total_speed_.emplace(all_done);
    progress_.pace = total_speed_->pace(all_done, all);
  }

  long long count_images(const Task& task) const {
    const Shard shard = plan_shards(job_, task.run)[static_cast<std::size_t>(task.shard)];
    return (shard.end_frame - shard.first_frame) * static_cast<long long>(job_.drones.size());
  }

  RunProgress& at(const Task& task) { return progress_.runs[static_cast<std::size_t>(task.run)]; }

  void report() {
    progress_.nodes = executor_.nodes_of(folder_);
    if (on_progress_) on_progress_(progress_);
  }

  const JobFolder& folder_;
  const JobSpec& job_;
  Executor& executor_;
  const OnJobProgress& on_progress_;
  std::stop_token stop_;
  Share share_;
  JobProgress progress_;
  std::vector<RunFailure> failures_;
  double cpu_s_ = 0;                    ///< of the tasks so far
  bool is_measured_ = true;             ///< every task so far was done here, at once
  std::set<int> simulated_;             ///< runs whose simulation was there when a stage began
  std::map<Task, long long> images_;    ///< done, per shard
  std::map<Task, Speedometer> speeds_;  ///< of shards; of a run by the name of its simulation
  std::optional<Speedometer> total_speed_;
};

}  // namespace

std::string_view to_string(Stage stage) {
  switch (stage) {
    case Stage::waiting:
      return "waiting";
    case Stage::simulating:
      return "simulating";
    case Stage::rendering:
      return "rendering";
    case Stage::rendered:
      return "rendered";
    case Stage::publishing:
      return "publishing";
    case Stage::finished:
      return "finished";
    case Stage::failed:
      break;
  }
  return "failed";
}

std::vector<RunFailure> run_job(const JobFolder& folder, const ResolvedJob& job, Executor& executor,
                                const OnJobProgress& on_progress, std::stop_token stop,
                                const Share& share) {
  const FolderLock lock(folder.path(), ".lock", "job's folder");
  folder.remove_damaged();
  return Supervision(folder, job.spec(), executor, on_progress, std::move(stop), share).run();
}

}  // namespace throng::jobs
