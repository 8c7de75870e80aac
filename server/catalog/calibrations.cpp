#include "server/catalog/calibrations.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_describe.h"
#include "base/json/json_text.h"
#include "base/text/control_characters.h"
#include "jobs/queue/store/job_id.h"
#include "server/catalog/api_json.h"
#include "server/catalog/service_errors.h"
#include "spec/calibration/request_files.h"
#include "spec/estimates/task_memory.h"

namespace throng::server {

namespace fs = std::filesystem;
using jobs::JobRow;
using jobs::JobState;
using nlohmann::json;

namespace {

constexpr const char* kMemoryName = "memory_mib";
constexpr std::size_t kMaxFileName = 200;  // a temporary name is longer, and may have 255 bytes

}  // namespace

JobRow Calibrations::submit(std::string_view request_json, const std::vector<Upload>& files,
                            const Quota& quota) {
  const json request = parse_json(request_json, "", kRequestJsonLimits);
  if (!request.is_object()) {
    throw InputError(Problem{"", "", "no JSON object", "a request: see docs/calibration.md"});
  }
  if (const json name = request.value("name", json(""));
      !name.is_string() || has_control_characters(name.get_ref<const std::string&>())) {
    throw InputError(Problem{"", "/name", describe(name), "a text without control characters"});
  }
  StagingFolder staging(folders_.calibrations() / "next");
  for (const Upload& file : files) {
    if (fs::path(file.name).filename() != file.name || file.name.empty() || file.name == "." ||
        file.name == ".." || file.name.size() > kMaxFileName) {
      throw InputError(
          Problem{"", "/files", file.name.substr(0, kMaxFileName),
                  fmt::format("plain names of files of at most {} bytes", kMaxFileName)});
    }
    write_file_atomically(staging.path() / "files" / file.name, file.bytes);
  }
  const std::int64_t memory_mib = confined_.calibration(request, staging.path() / "files");
  write_file_atomically(staging.path() / kMemoryName, std::to_string(memory_mib));
  write_file_atomically(staging.path() / "request.json", dump_text(request));
  JobRow row;
  {
    // Under the lock, so that it is not begun before its files are in their place.
    const auto lock = state_.hold();
    const jobs::Added added = store_.add({.name = request.value("name", ""),
                                          .spec_json = dump_text(request),
                                          .kind = jobs::JobKind::calibration,
                                          .owner = quota.owner,
                                          .limits = {quota.max_active, quota.max_bytes}});
    if (!added.over_quota.empty()) throw QuotaError(added.over_quota);
    row = added.row;
    fs::rename(staging.path(), folders_.ground_truth_folder(row));
  }
  spdlog::info("calibration {} queued", row.id);
  state_.notify_queued();
  state_.notify_event();
  return row;
}

std::int64_t Calibrations::estimate_memory_mib(const fs::path& folder) {
  try {
    return std::stoll(read_file(folder / kMemoryName));
  } catch (const std::exception&) {  // of an earlier version
    return jobs::calibration_memory_mib(0);
  }
}

json Calibrations::image_camera(const std::string& id, const Viewer& viewer) const {
  const std::optional<JobRow> row = jobs::is_job_id(id) ? store_.get(id) : std::nullopt;
  if (!row || row->kind != jobs::JobKind::calibration || !is_visible(viewer, *row)) {
    throw EnvironmentError("there is no calibration of this id");
  }
  if (row->state != JobState::succeeded) {
    throw EnvironmentError(fmt::format("the calibration is {}", to_string(row->state)));
  }
  return parse_own_json(read_file(folders_.ground_truth_folder(*row) / calibrate::kCameraName),
                        calibrate::kCameraName);
}

}  // namespace throng::server
