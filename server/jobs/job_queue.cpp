#include "server/jobs/job_queue.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/hash.h"
#include "base/json/json_text.h"
#include "jobs/queue/machine_speed.h"
#include "jobs/queue/pinned_library.h"
#include "server/catalog/api_json.h"
#include "server/jobs/disk_watch.h"
#include "server/jobs/report_maker.h"
#include "spec/calibration/calibrations.h"
#include "spec/estimates/job_cost.h"
#include "spec/job/scenario_mix.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::server {

using jobs::JobEvent;
using jobs::JobRow;
using nlohmann::json;

JobQueue::JobQueue(const ServiceFolders& folders, jobs::Store& store, QueueState& state,
                   Uploads& uploads, const Calibrations& calibrations,
                   const ConfinedChecks& confined, const PublishTargets& publish_to)
    : folders_(folders),
      store_(store),
      state_(state),
      uploads_(uploads),
      calibrations_(calibrations),
      confined_(confined),
      publish_to_(publish_to) {}

void JobQueue::put_cameras(json& job, const Viewer& viewer) const {
  jobs::put_calibrations(
      job, [&](const std::string& id) { return calibrations_.image_camera(id, viewer); });
}

jobs::ResolvedJob JobQueue::resolve(json job, const Viewer& viewer) const {
  put_cameras(job, viewer);
  return confined_.job(job, folders_.scenarios());
}

json JobQueue::dry_run(json job, const Viewer& viewer) const {
  put_cameras(job, viewer);
  json answer = confined_.dry_run(job, folders_.scenarios());
  require_disk(answer.at("estimate").at("disk_bytes").get<std::int64_t>());
  jobs::fit_to_machine(answer, folders_.speed_file());
  jobs::warn_of_full_disk(answer, static_cast<double>(measure_disk(folders_.data()).free_bytes),
                          "the service's disk");
  constexpr const char* kPublish = "/outputs/publish";
  publish_to_.require(job.value(json::json_pointer(kPublish), ""));
  return answer;
}

void JobQueue::require_disk(std::int64_t planned_bytes) const {
  const std::int64_t total_bytes = measure_disk(folders_.data()).total_bytes;
  if (planned_bytes <= total_bytes) return;
  throw InputError(jobs::too_large_for_disk(static_cast<double>(planned_bytes),
                                            static_cast<double>(total_bytes),
                                            "of the service's disk"));
}

jobs::Added JobQueue::submit(const Submission& submission) {
  const std::uint64_t uploads_before = uploads_.scenarios().publications();
  const jobs::ResolvedJob resolved = resolve(submission.job, submission.viewer);
  const jobs::JobSpec& job = resolved.spec();
  publish_to_.require(job.outputs.publish);
  const std::int64_t planned_bytes = jobs::estimate_cost(job, resolved.load()).disk_bytes;
  require_disk(planned_bytes);
  const auto lock = uploads_.hold();
  require_scenario(job);
  const json spec = to_json(job);
  const std::string sources = uploads_.sources_json(spec, jobs::JobKind::dataset, uploads_before);
  const json sent = {submission.job, submission.priority, submission.labels};
  const jobs::Added added = store_.add({.name = job.name,
                                        .spec_json = dump_text(spec),
                                        .priority = submission.priority,
                                        .labels = submission.labels,
                                        .owner = submission.owner,
                                        .key = submission.key,
                                        .hash = sha256_hex(dump_text(sent)),
                                        .limits = {submission.max_active, submission.max_bytes},
                                        .load = resolved.load(),
                                        .sources_json = sources,
                                        .planned_bytes = planned_bytes});
  if (!added.over_quota.empty()) throw QuotaError(added.over_quota);
  if (!added.is_new) return added;
  spdlog::info("job {} queued", added.row.id);
  state_.notify_queued();
  state_.notify_event();
  return added;
}

jobs::Added JobQueue::submit_with_bundle(const Submission& submission, std::string_view bundle) {
  Submission named = submission;
  name_bundle(bundle, named.job);
  Uploads::Pinned pinned(uploads_, bundle, submission.owner);
  jobs::Added added = submit(named);
  // A repeated submission's job may be another's, or be gone.
  if (added.is_new) pinned.keep();
  return added;
}

json JobQueue::dry_run_with_bundle(json job, std::string_view bundle, const Viewer& viewer) {
  name_bundle(bundle, job);
  const Uploads::Pinned pinned(uploads_, bundle, "");
  return dry_run(std::move(job), viewer);
}

void JobQueue::require_scenario(const jobs::JobSpec& job) const {
  for (const int run : jobs::first_runs(job)) {
    const jobs::JobSpec one = jobs::in_scenario_of_run(job, run);
    if (one.generate || world::has_scenario(folders_.scenarios(), one.scenario)) {
      continue;
    }
    throw InputError(Problem{"", "/scenario", fmt::format("scenario \"{}\"", one.scenario),
                             "one that has not been removed"});
  }
}

std::vector<jobs::EventRow> JobQueue::events(const std::string& job, std::int64_t after, int limit,
                                             std::chrono::milliseconds timeout) const {
  const auto end = std::chrono::steady_clock::now() + timeout;
  while (true) {
    const std::uint64_t count = state_.event_counter().count();
    std::vector<jobs::EventRow> rows = store_.events(job, after, limit);
    if (!rows.empty() || !state_.event_counter().wait(count, end)) return rows;
  }
}

std::optional<JobRow> JobQueue::get(const std::string& id) const {
  std::optional<JobRow> row = store_.get(id);
  if (row) state_.complete(*row);
  return row;
}

std::shared_ptr<const std::string> JobQueue::text_of_job(
    const std::string& id, const std::function<std::string(const JobRow&)>& write) const {
  // Taken before looking: what changes in between makes the text one of the past.
  const std::uint64_t revision = state_.revision();
  if (auto text = texts_.find(revision, id)) return text;
  const std::optional<JobRow> row = get(id);
  if (!row || row->kind != jobs::JobKind::dataset) return nullptr;
  auto text = std::make_shared<const std::string>(write(*row));
  texts_.put(revision, id, text);
  return text;
}

std::vector<JobRow> JobQueue::list(const jobs::JobFilter& filter) const {
  std::vector<JobRow> rows = store_.list(filter);
  for (JobRow& row : rows) state_.complete(row);
  return rows;
}

std::optional<JobRow> JobQueue::change(const std::string& id, const jobs::JobChange& change) {
  std::optional<JobRow> row = store_.change(id, change);
  if (row) {
    state_.set_priority(id, change.priority);
    state_.notify_queued();  // it may be ahead of others now
    state_.notify_event();
  }
  return row;
}

std::optional<JobRow> JobQueue::cancel(const std::string& id) {
  // The state may change between reading and cancelling; then look again.
  for (std::optional<JobRow> row = store_.get(id); row; row = store_.get(id)) {
    if (!is_active(row->state)) {
      throw ConflictError(
          fmt::format("the job is {}: there is nothing to cancel", to_string(row->state)));
    }
    if (!state_.apply(*row, JobEvent::cancel)) continue;
    state_.end_work_on(id);
    spdlog::info("job {} cancelled", id);
    return get(id);
  }
  return std::nullopt;
}

int JobQueue::cancel_all_of(const std::set<std::string>& owners) {
  int cancelled = 0;
  for (const jobs::JobKind kind :
       {jobs::JobKind::dataset, jobs::JobKind::calibration, jobs::JobKind::study}) {
    const jobs::JobFilter active{.kind = kind,
                                 .states = {jobs::JobState::queued, jobs::JobState::running},
                                 .limit = std::numeric_limits<int>::max(),
                                 .with_spec = false};
    for (const JobRow& listed : store_.list(active)) {
      if (!owners.contains(listed.owner)) continue;
      // The state may change between reading and cancelling; then look again.
      std::optional<JobRow> row = listed;
      while (row && is_active(row->state) && !state_.apply(*row, JobEvent::cancel)) {
        row = store_.get(listed.id);
      }
      if (!row || !is_active(row->state)) continue;
      state_.stop_work_on(listed.id);
      spdlog::info("job {} cancelled: its key was revoked", listed.id);
      ++cancelled;
    }
  }
  return cancelled;
}

std::optional<JobRow> JobQueue::retry(const std::string& id, const jobs::OwnerLimits& limits) {
  for (std::optional<JobRow> row = store_.get(id); row; row = store_.get(id)) {
    if (row->is_damaged) {
      throw ConflictError("the job's row in the store is damaged: it can only be removed");
    }
    if (!next_state(row->state, JobEvent::retry)) {
      throw ConflictError(
          fmt::format("the job is {}: only one that failed or was cancelled can be "
                      "tried again",
                      to_string(row->state)));
    }
    const auto lock = uploads_.hold();
    try {
      uploads_.require_same_sources(*row);
    } catch (const InputError& error) {
      throw ConflictError(error.what());
    }
    const jobs::Retried retried = state_.retry(*row, limits);
    if (!retried.over_quota.empty()) throw QuotaError(retried.over_quota);
    if (!retried.row) continue;
    if (row->kind == jobs::JobKind::dataset) {
      jobs::heal_library_pin(jobs::JobFolder(folders_.job_folder(id)));
    }
    ReportMaker::forget(folders_.ground_truth_folder(*row));
    spdlog::info("job {} queued again", id);
    state_.notify_queued();
    return retried.row;
  }
  return std::nullopt;
}

}  // namespace throng::server
