#include "server/jobs/report_maker.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>

#include "base/error.h"
#include "jobs/queue/dataset/folder.h"

namespace throng::server {

namespace fs = std::filesystem;

namespace {

constexpr jobs::Task kReportTask{jobs::Task::Kind::report};

fs::path report_file(const fs::path& job) { return jobs::JobFolder(job).output_of(kReportTask); }

}  // namespace

ReportMaker::ReportMaker(jobs::Executor& executor, ReportMakerOptions options)
    : executor_(executor), options_(options) {
  for (int i = 0; i < options_.at_once; ++i) {
    workers_.emplace_back([this](const std::stop_token& stop) { work(stop); });
  }
}

std::deque<ReportMaker::Order>::iterator ReportMaker::find_order(const fs::path& job) {
  return std::find_if(orders_.begin(), orders_.end(),
                      [&](const Order& order) { return order.job == job; });
}

std::deque<ReportMaker::Order>::iterator ReportMaker::next_order() {
  return std::find_if(orders_.begin(), orders_.end(),
                      [](const Order& order) { return !order.is_begun; });
}

std::optional<fs::path> ReportMaker::report_of(const fs::path& job, const jobs::Share& share,
                                               std::chrono::milliseconds timeout) {
  const fs::path file = report_file(job);
  std::unique_lock lock(mutex_);
  const auto is_ordered = [&] { return find_order(job) != orders_.end(); };
  if (!is_ordered() && failures_.count(job) == 0) {
    if (fs::exists(file)) return file;
    if (orders_.size() >= options_.max_waiting) {
      throw EnvironmentError(
          fmt::format("{} reports wait to be made; try again later", orders_.size()));
    }
    orders_.push_back({job, share});
    changed_.notify_all();
  }
  changed_.wait_for(lock, timeout, [&] { return !is_ordered(); });
  if (const auto failure = failures_.extract(job)) throw EnvironmentError(failure.mapped());
  return !is_ordered() && fs::exists(file) ? std::optional(file) : std::nullopt;
}

void ReportMaker::forget(const fs::path& job) {
  std::error_code error;
  fs::remove(report_file(job), error);
}

void ReportMaker::work(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, stop, [this] { return next_order() != orders_.end(); })) {
    const auto next = next_order();
    next->is_begun = true;
    const Order order = *next;
    lock.unlock();
    const std::string failure = failure_of(order, stop);
    lock.lock();
    orders_.erase(find_order(order.job));
    if (!failure.empty()) failures_[order.job] = failure;
    changed_.notify_all();
  }
}

std::string ReportMaker::failure_of(const Order& order, const std::stop_token& stop) const {
  try {
    const std::array tasks = {kReportTask};
    const jobs::TaskResult result =
        executor_.run(jobs::JobFolder(order.job), tasks, {}, stop, order.share).at(0);
    if (result.outcome == jobs::Outcome::succeeded) return "";
    if (stop.stop_requested()) return "the service ends";
    spdlog::error("report of job {}: {}", order.job.filename().string(), result.message);
    return fmt::format("the report could not be made: {}", result.message);
  } catch (const std::exception& error) {
    spdlog::error("report of job {}: {}", order.job.filename().string(), error.what());
    return error.what();
  }
}

}  // namespace throng::server
