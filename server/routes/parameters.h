// Parameters that several routes have.
#pragma once

#include <vector>

#include "server/description/operation.h"

namespace throng::server {

Parameter dry_run(const char* help);
Parameter idempotency_key();
/// ?limit= and ?after= of a list, and both.
Parameter page_limit();
Parameter after_id();
std::vector<Parameter> page_parameters();
/// ?after=, ?wait_s= and ?limit= of events.
std::vector<Parameter> event_parameters();
/// Those, and the position at which a browser resumes a stream.
std::vector<Parameter> event_stream_parameters();

}  // namespace throng::server
