// JSON values in responses of the API.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "jobs/queue/store/store.h"
#include "jobs/queue/supervisor.h"
#include "server/catalog/retention.h"

namespace throng::server {

/// A time by RFC 3339 in UTC with milliseconds; null for 0 ("not yet").
nlohmann::json time_json(std::int64_t unix_ms);

/// {"stage", "frames_done", "frames_total", "runs": [...]}, and "publishing" for a job that
/// publishes its dataset.
nlohmann::json progress_json(const jobs::JobProgress& progress);

/// The part of the progress whose changes are events: {"stage", "runs": {"run000": stage}}
nlohmann::json stages_json(const jobs::JobProgress& progress);

/// {"seq", "job", "at", "type", "data"}
nlohmann::json event_json(const jobs::EventRow& event);

/// A failed job's "error": {"kind", "message", "problems"}.
nlohmann::json error_json(const std::string& kind, const std::string& message,
                          const std::vector<Problem>& problems);

/// The "error" of a partial job: {"kind": "partial", "message", "problems": [], "runs": [...]}.
nlohmann::json partial_error_json(const std::vector<jobs::RunFailure>& failures);

/// [{"pointer", "found", "expected", "message"}]
nlohmann::json problems_json(const std::vector<Problem>& problems);

/// A calibration as in GET /v1/calibrations/{id}; with its camera once it has succeeded.
nlohmann::json calibration_json(const jobs::JobRow& row, const Retention& retention);

/// A study as in GET /v1/studies.
nlohmann::json study_json(const jobs::JobRow& row, const Retention& retention);

/// A job as in lists: without what was asked for.
nlohmann::json job_json(const jobs::JobRow& row, const Retention& retention);
/// The text of a job as in GET /v1/jobs/{id}; "job" is null if the row is damaged.
std::string job_text(const jobs::JobRow& row, const Retention& retention);

/// A problem document (RFC 9457).
nlohmann::json problem_document(int status, const std::string& detail,
                                const std::vector<Problem>& problems = {});

/// The text of a JSON value; invalid UTF-8 in its strings is replaced.
std::string dump_text(const nlohmann::json& value);

}  // namespace throng::server
