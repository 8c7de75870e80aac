// A job service with an executor that pretends, in folders of its own.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <thread>

#include "base/files/files.h"
#include "jobs/queue/workers/local_processes.h"
#include "server/api/service.h"
#include "tests/base/wait_until.h"
#include "tests/jobs/queue/fake_executor.h"
#include "tests/jobs/yard.h"
#include "tests/server/test_checks.h"

namespace throng::server {

inline constexpr const char* kJob = R"({"scenario": "yard", "capture": {"to_s": 2}})";
inline nlohmann::json job_document() { return nlohmann::json::parse(kJob); }

class ServiceFixture : public ::testing::Test {
 protected:
  ServiceFixture() {
    jobs::write_yard(scenarios.path());
    executor.other = [this](const jobs::JobFolder& folder, const jobs::Task& task,
                            const jobs::Executor::OnProgress& on_progress,
                            const std::stop_token& stop) {
      if (task.kind != jobs::Task::Kind::report) {
        return real.run(folder, std::array{task}, on_progress, stop).at(0);
      }
      try {
        reporter(folder.path(), folder.output_of(task), stop);
        return jobs::TaskResult{};
      } catch (const std::exception& error) {
        return jobs::TaskResult{jobs::Outcome::environment_error, 3, error.what(), {}};
      }
    };
  }

  ServiceOptions options() const {
    return {.data = data.path(),
            .scenarios = scenarios.path(),
            .confined = test_checks(),
            .max_active_jobs = 1,
            .live = {.command = {"/bin/true"}}};
  }

  /// Writes the report of the job in a folder to a file.
  std::function<void(const std::filesystem::path& job, const std::filesystem::path& file,
                     const std::stop_token&)>
      reporter = [](const auto&, const std::filesystem::path& file, const std::stop_token&) {
        write_file_atomically(file, "<!doctype html>");
      };

  jobs::TemporaryFolder scenarios;
  jobs::TemporaryFolder data;
  jobs::LocalProcesses real{
      {.command = {kProgram, "worker"}, .workers = 2, .rest_s = 0.05, .grace_s = 0.2}};
  jobs::FakeExecutor executor;
};

/// Makes an executor's tasks wait until open() is called, or the gate is gone.
class Gate {
 public:
  explicit Gate(jobs::FakeExecutor& executor) {
    executor.before = [state = state_](const jobs::Task&) {
      state->waiting = true;
      while (!state->open) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      return jobs::TaskResult{};
    };
  }
  ~Gate() { open(); }
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;

  void open() { state_->open = true; }
  bool somebody_waits() const { return state_->waiting; }

 private:
  struct State {
    std::atomic<bool> open = false;
    std::atomic<bool> waiting = false;
  };
  // Shared, since tasks may look at it when the test has ended.
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

/// Whether a job gets into a state soon.
inline bool reaches(const Service& service, const std::string& id, jobs::JobState state) {
  return wait_until([&] { return service.queue().get(id)->state == state; });
}

}  // namespace throng::server
