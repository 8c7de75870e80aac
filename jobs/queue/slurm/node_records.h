// Which nodes of a cluster did what: totals of a job, kept in its folder, and of this process.
//
// logs/nodes.jsonl has a line per attempt that ended:
//   {"task":"run000/shard0003","attempt":1,"node":"n2","slurm_job":"17_3","outcome":"succeeded",
//    "seconds":12.5,"message":""}
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "jobs/queue/dataset/folder.h"
#include "jobs/queue/workers/executor.h"

namespace throng::jobs {

/// An attempt that ended on a node.
struct NodeRecord {
  std::string task;
  int attempt = 1;
  std::string node;
  std::string slurm_job;  ///< "17_3"
  std::string outcome;    ///< "succeeded", "lost", or to_string(Outcome)
  double seconds = 0;     ///< by its worker, or from when it was first seen running
  std::string message = {};
};

/// "succeeded", "out_of_memory"
std::string to_string(Outcome outcome);

/// Safe to use from many threads.
class NodeRecords {
 public:
  void begin(const JobFolder& folder, const std::string& node);
  /// Also appends the line. That it cannot be written is no reason to fail.
  void end(const JobFolder& folder, const NodeRecord& record);
  /// It goes on without us, or is given up before it ended: one less runs.
  void leave(const JobFolder& folder, const std::string& node);

  /// The work of each node for a job, sorted by name: noted by earlier processes, and running now.
  std::vector<NodeWork> of(const JobFolder& folder) const;
  /// Tasks of all jobs that run now.
  int running() const;
  /// The work of each node for all jobs since this process began.
  std::vector<NodeWork> all() const;

 private:
  using Totals = std::map<std::string, NodeWork>;

  Totals& job_totals(const JobFolder& folder) const;

  mutable std::mutex mutex_;
  mutable std::map<std::filesystem::path, Totals> jobs_;
  Totals all_;
};

}  // namespace throng::jobs
