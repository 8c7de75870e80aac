// Work of a cluster's nodes: totals per job, from a log in its folder, and of this process.
//
// logs/nodes.jsonl has one line per attempt that ended:
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
  std::string slurm_job;  ///< array job and index: "17_3"
  std::string outcome;    ///< "succeeded", "lost", or to_string(Outcome)
  double seconds = 0;     ///< duration as reported by the worker, else since first seen running
  std::string message = {};
};

/// Safe to use from many threads.
class NodeRecords {
 public:
  /// Counts an attempt that starts on a node.
  void begin(const JobFolder& folder, const std::string& node);
  /// Counts an attempt that has ended and appends its line to the log; ignores errors of writing.
  void end(const JobFolder& folder, const NodeRecord& record);
  /// Stops counting an attempt as running without an end: it goes on without this process, or is
  /// given up.
  void leave(const JobFolder& folder, const std::string& node);

  /// Work of each node for a job, sorted by name, including what earlier processes have logged.
  std::vector<NodeWork> of(const JobFolder& folder) const;
  /// The number of running tasks of all jobs.
  int running() const;
  /// Work of each node for all jobs since this process started.
  std::vector<NodeWork> all() const;

 private:
  using Totals = std::map<std::string, NodeWork>;

  Totals& job_totals(const JobFolder& folder) const;

  mutable std::mutex mutex_;
  mutable std::map<std::filesystem::path, Totals> jobs_;
  Totals all_;
};

}  // namespace throng::jobs
