// Parameters of a live flight, for the flight and for its process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/compute/steady_time.h"
#include "spec/live/commands.h"

namespace throng::server {

/// Parameters of a flight.
struct LiveFlightSpec {
  std::string id;
  std::string owner;  ///< id of the key
  std::string name;   ///< name of the job
  std::vector<live::FlownDrone> drones;
  std::string job_json;          ///< the resolved job
  std::int64_t memory_mib = 0;   ///< estimated memory; 0: not limited
  bool is_recorded = false;      ///< whether it is asked to record itself
  std::filesystem::path folder;  ///< folder in which the flight's temporary folder is created
  std::int64_t max_recorded_bytes = 0;  ///< a recording ends at this size; 0: unlimited
  std::int64_t min_free_mib = 0;        ///< a recording ends when the disk has less free space
  std::vector<std::string> command;  ///< the program; the flight's folder and options are appended
  SteadyNow now = &steady_now;       ///< clock of LiveAudience::last_seen
};

}  // namespace throng::server
