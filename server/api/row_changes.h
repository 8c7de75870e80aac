// Changes of an existing job or study: priority, labels, keep.
#pragma once

#include <string>
#include <vector>

#include "jobs/queue/store/store.h"
#include "server/api/service_parts.h"
#include "server/http/http_fwd.h"

namespace throng::server {

inline constexpr std::size_t kMaxLabels = 20;
inline constexpr std::size_t kMaxLabelLength = 60;

/// Throws HttpError 400 for too many labels, or a label that is empty, too long or not printable.
/// `pointer` is their JSON pointer.
void check_labels(const std::vector<std::string>& labels, const std::string& pointer);

/// Throws HttpError 403 for a priority that the caller may not use. `pointer` is its JSON pointer.
void require_priority(const Caller& caller, int priority, const std::string& pointer);

/// The row's properties, changed by the body of a PATCH request with some of {"priority", "labels",
/// "keep"}. Throws HttpError 400, 403 and 415.
jobs::JobChange read_change(const Caller& caller, const httplib::Request& request,
                            const jobs::JobRow& row);

}  // namespace throng::server
