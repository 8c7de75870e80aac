#include "server/jobs/housekeeping.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "base/error.h"
#include "server/catalog/data_folder.h"

namespace throng::server {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using jobs::JobEvent;
using jobs::JobRow;

namespace {

constexpr auto kSweepInterval = 60s;
constexpr auto kMaxMemoryOfRemoved = std::chrono::hours(24 * 30);

}  // namespace

Housekeeping::Housekeeping(const ServiceFolders& folders, jobs::Store& store, QueueState& state,
                           Uploads& uploads, DiskReserve& reserve, HousekeepingOptions options)
    : folders_(folders),
      store_(store),
      state_(state),
      uploads_(uploads),
      reserve_(reserve),
      options_(std::move(options)),
      disk_(
          options_.disk ? options_.disk : [data = folders.data()] { return measure_disk(data); },
          options_.min_free_bytes, [this](const std::string& reason) { state_.pause(reason); }) {
  tidy_data_folder(folders_.data(), store_);
  sweeper_ = std::jthread([this](const std::stop_token& stop) { sweep(stop); });
}

bool Housekeeping::remove(const std::string& id) {
  const std::shared_ptr<void> room = reserve_.free();
  // The state may change between reading and cancelling; then look again.
  std::optional<JobRow> row = store_.get(id);
  while (row && is_active(row->state) && !state_.apply(*row, JobEvent::cancel))
    row = store_.get(id);
  if (!row) return false;
  state_.end_work_on(id);
  if (!store_.remove(id)) return false;
  state_.notify_event();
  uploads_.drop_bundle_of(*row);
  // Moved away first, so that a half-removed folder is never taken for a job's.
  const fs::path trash = folders_.data() / "trash";
  std::error_code error;
  fs::create_directories(trash, error);
  fs::rename(folders_.ground_truth_folder(*row), trash / id, error);
  fs::remove_all(trash / id, error);
  if (error) spdlog::warn("job {}: some files could not be removed: {}", id, error.message());
  spdlog::info("job {} removed", id);
  return true;
}

void Housekeeping::remove_expired() {
  constexpr int kMaxAtOnce = 1000;
  store_.save_service_clock();
  const Retention& retention = options_.retention;
  if (retention.max_wait_ms > 0 || retention.max_bytes > 0) {
    for (const std::string& id :
         expired(store_.ended(kMaxAtOnce), store_.total_bytes(), store_.service_ms(), retention)) {
      spdlog::info("job {}: has been kept for long enough", id);
      remove(id);
    }
  }
  store_.forget_events(
      store_.now_ms() -
      std::chrono::duration_cast<std::chrono::milliseconds>(kMaxMemoryOfRemoved).count());
}

void Housekeeping::sweep(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      const std::shared_ptr<void> room = reserve_.free();
      remove_expired();
    } catch (const std::exception& error) {
      spdlog::error("removal of old jobs: {}", error.what());
    }
    state_.wait(stop, kSweepInterval);
  }
}

}  // namespace throng::server
