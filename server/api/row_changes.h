// Changes of a job or a study that is there: priority, labels, keep.
#pragma once

#include <string>
#include <vector>

#include "jobs/queue/store/store.h"
#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// Throws HttpError 400 for too many labels, or one that is empty, long or not printable; `pointer`
/// says where they are.
void check_labels(const std::vector<std::string>& labels, const std::string& pointer);

/// Throws HttpError 403 for a priority that the caller may not give; `pointer` says where it is.
void require_priority(const RequestContext& context, int priority, const std::string& pointer);

/// The row's values with those in the body of a PATCH: {"priority", "labels", "keep"} or some of
/// them. Throws HttpError 400, 403 and 415.
jobs::JobChange describe_change(const RequestContext& context, const httplib::Request& request,
                                const jobs::JobRow& row);

}  // namespace throng::server
