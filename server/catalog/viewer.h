// Which jobs, calibrations and studies a caller sees.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "jobs/queue/store/store.h"

namespace throng::server {

/// The id of the key of somebody who sees their own rows and shared ones; std::nullopt: sees all.
using Viewer = std::optional<std::string>;

/// Whether the viewer sees a job, calibration or study.
inline bool is_visible(const Viewer& viewer, const jobs::JobRow& row) {
  return !viewer || row.owner == *viewer ||
         std::find(row.labels.begin(), row.labels.end(), jobs::kSharedLabel) != row.labels.end();
}

}  // namespace throng::server
