#include "jobs/queue/slurm/node_records.h"

#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/untrusted_folders.h"
#include "base/json/json_text.h"

namespace throng::jobs {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

fs::path records_file(const JobFolder& folder) { return folder.path() / "logs" / "nodes.jsonl"; }

constexpr const char* kSucceeded = "succeeded";

void add(NodeWork& work, const std::string& outcome, double seconds) {
  ++(outcome == kSucceeded ? work.done : work.failed);
  work.busy_s += seconds;
}

NodeWork& work_at(std::map<std::string, NodeWork>& totals, const std::string& node) {
  NodeWork& work = totals[node];
  work.node = node;
  return work;
}

std::vector<NodeWork> sorted_nodes(const std::map<std::string, NodeWork>& totals) {
  std::vector<NodeWork> list;
  list.reserve(totals.size());
  for (const auto& [name, work] : totals) list.push_back(work);
  return list;
}

std::map<std::string, NodeWork> read_totals(const fs::path& path) {
  std::map<std::string, NodeWork> totals;
  std::istringstream file(exists_without_links(path) ? read_file(path) : std::string());
  for (std::string line; std::getline(file, line);) {
    try {
      const json value = parse_json(line, "");
      add(work_at(totals, value.at("node")), value.at("outcome"), value.at("seconds"));
    } catch (const InputError&) {
      continue;  // its writing was broken off
    } catch (const json::exception&) {
      continue;
    }
  }
  return totals;
}

}  // namespace

NodeRecords::Totals& NodeRecords::job_totals(const JobFolder& folder) const {
  const auto known = jobs_.find(folder.path());
  if (known != jobs_.end()) return known->second;
  return jobs_[folder.path()] = read_totals(records_file(folder));
}

void NodeRecords::begin(const JobFolder& folder, const std::string& node) {
  const std::lock_guard lock(mutex_);
  ++work_at(job_totals(folder), node).running;
  ++work_at(all_, node).running;
}

void NodeRecords::leave(const JobFolder& folder, const std::string& node) {
  const std::lock_guard lock(mutex_);
  --work_at(job_totals(folder), node).running;
  --work_at(all_, node).running;
}

void NodeRecords::end(const JobFolder& folder, const NodeRecord& record) {
  const std::lock_guard lock(mutex_);
  // Also where its beginning was not seen: begin() and end() need not pair.
  add(work_at(job_totals(folder), record.node), record.outcome, record.seconds);
  add(work_at(all_, record.node), record.outcome, record.seconds);
  std::error_code ignored;  // no worker has made the folder yet
  fs::create_directories(records_file(folder).parent_path(), ignored);
  const int file = open_for_appending(records_file(folder));
  if (file < 0) return;
  const std::string line = json{{"task", record.task},       {"attempt", record.attempt},
                                {"node", record.node},       {"slurm_job", record.slurm_job},
                                {"outcome", record.outcome}, {"seconds", record.seconds},
                                {"message", record.message}}
                               .dump(-1, ' ', false, json::error_handler_t::replace) +
                           '\n';
  static_cast<void>(::write(file, line.data(), line.size()));
  ::close(file);
}

std::vector<NodeWork> NodeRecords::of(const JobFolder& folder) const {
  const std::lock_guard lock(mutex_);
  return sorted_nodes(job_totals(folder));
}

int NodeRecords::running() const {
  const std::lock_guard lock(mutex_);
  int running = 0;
  for (const auto& [name, work] : all_) running += work.running;
  return running;
}

std::vector<NodeWork> NodeRecords::all() const {
  const std::lock_guard lock(mutex_);
  return sorted_nodes(all_);
}

}  // namespace throng::jobs
