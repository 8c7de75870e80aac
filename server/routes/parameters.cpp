#include "server/routes/parameters.h"

#include "server/api/events_api.h"
#include "server/api/jobs_api.h"
#include "server/api/requests.h"

namespace throng::server {

Parameter dry_run(const char* help) { return {"dry_run", "boolean", help}; }

Parameter idempotency_key() {
  return {"Idempotency-Key", text_up_to(kMaxIdempotencyKeyLength),
          "A request with the same key again is the same submission: the answer is its job, with "
          "Idempotent-Replayed.",
          nullptr, Parameter::Location::header};
}

Parameter page_limit() {
  return {"limit", fields::integers(1, kMaxPageRows), "Maximum number of entries of a page.",
          kUsualPageRows};
}

Parameter after_id() {
  return {"after", "string", "Id after which the page begins: `next` of the last answer."};
}

std::vector<Parameter> page_parameters() { return {page_limit(), after_id()}; }

std::vector<Parameter> event_parameters() {
  return {
      {"after", at_least(0), "Number after which the events begin.", 0},
      {"wait_s", fields::integers(0, kMaxEventWaitS), "Time to wait for the first event, s.", 0},
      {"limit", fields::integers(1, kMaxEventsOfPage), "Maximum number of events.",
       kMaxEventsOfPage}};
}

std::vector<Parameter> event_stream_parameters() {
  std::vector<Parameter> all = event_parameters();
  all.push_back({"Last-Event-ID", "integer", "Position at which a stream is resumed.", nullptr,
                 Parameter::Location::header});
  return all;
}

}  // namespace throng::server
