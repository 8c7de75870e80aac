// Housekeeping: retention, pause of the queue when disk space runs out, removal of files.
#pragma once

#include <cstdint>
#include <stop_token>
#include <string>
#include <thread>

#include "jobs/queue/store/store.h"
#include "server/catalog/queue_state.h"
#include "server/catalog/retention.h"
#include "server/catalog/service_folders.h"
#include "server/catalog/uploads.h"
#include "server/jobs/disk_reserve.h"
#include "server/jobs/disk_watch.h"

namespace throng::server {

struct HousekeepingOptions {
  Retention retention = {};
  std::int64_t min_free_bytes = 512LL << 20;  ///< the queue is paused below this free space
  DiskWatch::Look disk = {};                  ///< default: measures the data folder's disk
};

/// Safe to use from many threads.
class Housekeeping {
 public:
  /// Tidies the data folder (server/catalog/data_folder.h). All references must outlive this
  /// object.
  Housekeeping(const ServiceFolders& folders, jobs::Store& store, QueueState& state,
               Uploads& uploads, DiskReserve& reserve, HousekeepingOptions options);
  Housekeeping(const Housekeeping&) = delete;
  Housekeeping& operator=(const Housekeeping&) = delete;
  ~Housekeeping() = default;

  const Retention& retention() const { return options_.retention; }

  /// Stops the job if it is active and removes it with all its files. Returns false if there is
  /// none.
  bool remove(const std::string& id);
  /// Removes expired jobs; called automatically once a minute.
  void remove_expired();

  /// Checks the disk now (DiskWatch::look()).
  std::string look_at_disk() { return disk_.look(); }

 private:
  void sweep(const std::stop_token& stop);

  const ServiceFolders& folders_;
  jobs::Store& store_;
  QueueState& state_;
  Uploads& uploads_;
  DiskReserve& reserve_;
  HousekeepingOptions options_;
  DiskWatch disk_;
  std::jthread sweeper_;  ///< last member: joined before the others end
};

}  // namespace throng::server
