#include "server/report_maker.h"

#include <fmt/core.h>
#include <poll.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "base/error.h"
#include "jobs/queue/child_process.h"

namespace throng::server {

namespace fs = std::filesystem;

namespace {

fs::path report_file(const fs::path& job) { return job / "report.html"; }

}  // namespace

Reporter reporter_in_child(std::vector<std::string> command) {
  return [command = std::move(command)](const fs::path& job, const fs::path& file,
                                        const std::stop_token& stop) {
    std::vector<std::string> words = command;
    words.insert(words.end(), {job.string(), "-o", file.string()});
    jobs::ChildProcess child(words, {}, job / "logs" / "report.log");
    while (!child.has_ended()) {
      if (stop.stop_requested()) throw Cancelled();  // the child ends with its object
      constexpr int kPollMs = 50;
      pollfd wait{child.output(), POLLIN, 0};
      ::poll(&wait, 1, kPollMs);
      child.read_lines();
    }
    const jobs::ExitStatus status = child.wait();
    if (status.signal != 0) {
      throw EnvironmentError(fmt::format("the report was ended by signal {}", status.signal));
    }
    if (status.code != 0) throw EnvironmentError("the report could not be made: see its log");
  };
}

ReportMaker::ReportMaker(Reporter reporter)
    : reporter_(std::move(reporter)),
      worker_([this](const std::stop_token& stop) { work(stop); }) {}

std::optional<fs::path> ReportMaker::report_of(const fs::path& job,
                                               std::chrono::milliseconds timeout) {
  const fs::path file = report_file(job);
  std::unique_lock lock(mutex_);
  const auto is_waited_for = [&] {
    return std::find(waiting_.begin(), waiting_.end(), job) != waiting_.end();
  };
  if (!is_waited_for() && failures_.count(job) == 0) {
    if (fs::exists(file)) return file;
    waiting_.push_back(job);
    changed_.notify_all();
  }
  changed_.wait_for(lock, timeout, [&] { return !is_waited_for(); });
  if (const auto failure = failures_.extract(job)) throw EnvironmentError(failure.mapped());
  return !is_waited_for() && fs::exists(file) ? std::optional(file) : std::nullopt;
}

void ReportMaker::forget(const fs::path& job) {
  std::error_code error;
  fs::remove(report_file(job), error);
}

void ReportMaker::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return !waiting_.empty(); })) {
    const fs::path job = waiting_.front();
    lock.unlock();
    const std::string failure = failure_of(job, stop);
    lock.lock();
    waiting_.pop_front();
    if (!failure.empty()) failures_[job] = failure;
    changed_.notify_all();
  }
}

std::string ReportMaker::failure_of(const fs::path& job, const std::stop_token& stop) const {
  try {
    reporter_(job, report_file(job), stop);
    return "";
  } catch (const Cancelled&) {
    return "the service ends";
  } catch (const std::exception& error) {
    spdlog::error("report of job {}: {}", job.filename().string(), error.what());
    return error.what();
  }
}

}  // namespace throng::server
