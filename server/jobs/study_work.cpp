#include "server/jobs/study_work.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "base/version.h"
#include "jobs/queue/dataset/folder.h"
#include "jobs/queue/workers/attempts.h"
#include "spec/estimates/task_memory.h"
#include "spec/study/study_files.h"

namespace throng::server {

namespace fs = std::filesystem;
using jobs::Outcome;
using jobs::Task;
using jobs::TaskResult;
using nlohmann::json;
using study::StudyRun;

namespace {

using Clock = std::chrono::steady_clock;

class StudyWork {
 public:
  StudyWork(const fs::path& folder, jobs::Executor& executor, jobs::Share share,
            const OnStudyProgress& on_progress, const std::stop_token& stop)
      : folder_(folder),
        executor_(executor),
        share_(std::move(share)),
        on_progress_(on_progress),
        stop_(stop),
        plan_(parse_own_json(read_file(folder / study::kPlanName), study::kPlanName)),
        size_{plan_.at("cases").size(), plan_.at("policies").size(), plan_.at("runs")},
        cells_(size_.cases, std::vector<int>(size_.policies)) {
    share_.memory_mib = [mib = plan_.at("memory_mib").get<std::int64_t>()](const Task& task) {
      return task.kind == Task::Kind::study_run ? mib : std::max(mib, jobs::kReportMemoryMib);
    };
  }

  void run() {
    drop_results_of_others();
    drop_leftovers();
    constexpr Task kReport{Task::Kind::study_report};
    if (!folder_.is_done(kReport)) {
      const std::vector<Task> tasks = missing_runs();
      report("simulating");
      share_.later_tasks = 1;
      carry_out(tasks);
      report("summing up");
      share_.later_tasks = 0;
      carry_out({kReport});
    }
    for (auto& policies : cells_) std::fill(policies.begin(), policies.end(), size_.runs);
    done_ = size_.count();
    jobs::end_all_attempts(folder_);
    report("finished");
  }

 private:
  fs::path result_path(const StudyRun& run) const {
    return folder_.path() / study::result_file(plan_.at("cases")[run.one_case].at("id"),
                                               plan_.at("policies")[run.policy].at("id"), run.run);
  }

  void drop_results_of_others() const {
    const fs::path file = folder_.path() / study::kGeneratorName;
    if (fs::exists(file) && read_file(file) == kGenerator) return;
    fs::remove_all(folder_.path() / "runs");
    for (const char* name : {study::kSummaryName, study::kSummarySoFarName, study::kValuesName}) {
      fs::remove(folder_.path() / name);
    }
    write_file_atomically(file, kGenerator);
  }

  // Removes what workers left that died while they wrote.
  void drop_leftovers() const {
    folder_.remove_leftovers();
    for (const json& one : plan_.at("cases")) {
      for (const json& policy : plan_.at("policies")) {
        remove_temporaries(
            (folder_.path() / study::result_file(one.at("id"), policy.at("id"), 0)).parent_path());
      }
    }
  }

  std::vector<Task> missing_runs() {
    std::vector<Task> tasks;
    for (std::size_t number = 0; number < size_.count(); ++number) {
      const StudyRun run = size_.at(number);
      if (fs::exists(result_path(run))) {
        ++cells_[run.one_case][run.policy];
        ++done_;
      } else {
        // All of one run: when one has failed for good, the others are not begun.
        tasks.push_back({Task::Kind::study_run, 0, static_cast<int>(number)});
      }
    }
    done_before_ = done_;
    return tasks;
  }

  void carry_out(const std::vector<Task>& tasks) {
    const auto on_task = [&](const Task& task, const jobs::TaskProgress& progress) {
      if (task.kind != Task::Kind::study_run || progress.done < progress.total) return;
      if (!counted_.insert(task.shard).second) return;
      const StudyRun run = size_.at(static_cast<std::size_t>(task.shard));
      ++cells_[run.one_case][run.policy];
      ++done_;
      report("simulating");
    };
    const std::vector<TaskResult> results = executor_.run(folder_, tasks, on_task, stop_, share_);
    if (stop_.stop_requested()) throw Cancelled();
    require_success(tasks, results);
  }

  void require_success(const std::vector<Task>& tasks,
                       const std::vector<TaskResult>& results) const {
    // A task that was cancelled for the failure of another does not say why.
    for (std::size_t i = 0; i < results.size(); ++i) {
      const TaskResult& result = results[i];
      if (result.outcome == Outcome::succeeded || result.outcome == Outcome::cancelled) continue;
      if (result.outcome == Outcome::input_error && !result.problems.empty()) {
        throw InputError(result.problems);
      }
      throw EnvironmentError(fmt::format("{}: {}", subject_of(tasks[i]), result.message));
    }
  }

  std::string subject_of(const Task& task) const {
    if (task.kind != Task::Kind::study_run) return "the report";
    const StudyRun run = size_.at(static_cast<std::size_t>(task.shard));
    return fmt::format("run {} of case \"{}\" and policy \"{}\"", run.run,
                       plan_.at("cases")[run.one_case].at("id").get<std::string>(),
                       plan_.at("policies")[run.policy].at("id").get<std::string>());
  }

  void report(const char* stage) const {
    const std::size_t here = done_ - done_before_;
    const std::size_t left = size_.count() - done_;
    const double took_s = std::chrono::duration<double>(Clock::now() - begun_).count();
    const bool is_known = here > 0 || left == 0;
    on_progress_({{"stage", stage},
                  {"runs_done", done_},
                  {"runs_total", size_.count()},
                  {"cells", cells_},
                  {"remaining_s", !is_known   ? json(nullptr)
                                  : left == 0 ? json(0)
                                              : json(took_s * static_cast<double>(left) /
                                                     static_cast<double>(here))}});
  }

  jobs::JobFolder folder_;
  jobs::Executor& executor_;
  jobs::Share share_;
  const OnStudyProgress& on_progress_;
  std::stop_token stop_;
  json plan_;
  study::StudySize size_;
  std::vector<std::vector<int>> cells_;  ///< finished runs, per case and policy
  std::size_t done_ = 0;
  std::size_t done_before_ = 0;  ///< by an earlier attempt
  std::set<int> counted_;        ///< runs that this attempt has counted
  Clock::time_point begun_ = Clock::now();
};

}  // namespace

void work_on_study(const fs::path& folder, jobs::Executor& executor, jobs::Share share,
                   const OnStudyProgress& on_progress, const std::stop_token& stop) {
  StudyWork(folder, executor, std::move(share), on_progress, stop).run();
}

}  // namespace throng::server
