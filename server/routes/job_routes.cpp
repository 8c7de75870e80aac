#include "server/api/events_api.h"
#include "server/api/jobs_api.h"
#include "server/api/row_changes.h"
#include "server/api/scenarios_api.h"
#include "server/routes/parameters.h"
#include "server/routes/resources.h"

namespace throng::server {

std::vector<Route> job_routes() {
  return tagged(
      "jobs",
      {begins_work(on_post(
           "/v1/jobs", Scope::submit, &submit_job,
           {.summary = "Queue a job",
            .help =
                "A job that cannot be done, or that needs more memory than the service has for a "
                "task (docs/service.md), is answered with 400.",
            .parameters =
                {dry_run(
                     "Whether the job is only checked: images, estimates of time, disk and "
                     "memory, views of the cameras and warnings, as `throng check` prints them."),
                 {"priority", fields::integers(-kMaxPriority, kMaxPriority),
                  "Jobs with higher values go first; a key has a maximum (403).", 0},
                 {"label", list(text_up_to(kMaxLabelLength)),
                  "Labels of the job; the parameter may be repeated."},
                 idempotency_key()},
            .body =
                Body{{{"application/json", "object", "The job; GET /v1/schema has its schema."},
                      {"multipart/form-data",
                       object({{"job", "string",
                                "The job as JSON; its scenario is bundle/NAME where a bundle comes "
                                "along."},
                               {"scenario?", "binary",
                                "A bundle of scenarios of the job's own: zip, tar or tar.gz."}})}}},
            .answers = {ok("With dry_run, the resolved job; else the job of an earlier submission "
                           "with this key.",
                           alternatives({"DryRun", "Job"})),
                        created("The job is queued and will survive a crash.", "Job")},
            .problems = {422, 507}})),
       on_get(
           "/v1/jobs", Scope::read, &list_jobs,
           {.summary = "List jobs",
            .help = "Pass `next` of an answer as `after` for the next page; it is null at the end.",
            .parameters =
                {{"state", list(enumeration(jobs::JobState::queued, jobs::JobState::cancelled)),
                  "The states of the jobs that are listed; the parameter may be repeated."},
                 {"label", "string", "The label of the jobs that are listed."},
                 {"name", "string", "Text that the names of the listed jobs contain."},
                 {"sort", words({"newest", "oldest"}), "Order of submission.", "newest"},
                 page_limit(),
                 after_id()},
            .answers = {ok("A page of the list.", "JobList")}}),
       on_get("/v1/jobs/{id}", Scope::read, &send_job,
              {.summary = "Get a job with its state and progress",
               .answers = {ok("The job.", "Job")}}),
       on_patch(
           "/v1/jobs/{id}", Scope::submit, &change_job,
           {.summary = "Change priority, labels, or whether the job is never removed for its age",
            .body = json_body("JobChange"),
            .answers = {ok("The job.", "Job")}}),
       on_delete("/v1/jobs/{id}", Scope::submit, &remove_job,
                 {.summary = "End a job and remove all its files",
                  .help = "An active job is ended first.",
                  .answers = {done("It has been removed.")}}),
       on_post(
           "/v1/jobs/{id}/cancel", Scope::submit, &cancel_job,
           {.summary = "Cancel a queued or running job; published output stays",
            .help =
                "The answer comes when nobody works on the job any more. A job that has ended is "
                "answered with 409.",
            .answers = {ok("The job; nobody works on it any more.", "Job")},
            .problems = {409}}),
       begins_work(on_post(
           "/v1/jobs/{id}/retry", Scope::submit, &retry_job,
           {.summary =
                "Queue a failed, partial or cancelled job again; published output is not repeated",
            .help = "It also works for a partial job; a job in another state is answered with 409.",
            .answers = {ok("The job.", "Job")},
            .problems = {409}})),
       begins_work(on_post(
           "/v1/jobs/{id}/clone", Scope::submit, &clone_job,
           {.summary = "Queue a new job like this one",
            .parameters = {idempotency_key()},
            .body = json_body("object", "A JSON merge patch (RFC 7396) for the job.", false),
            .answers = {ok("The job of an earlier submission with this key.", "Job"),
                        created("The job is queued and will survive a crash.", "Job")},
            .problems = {422}})),
       on_get(
           "/v1/jobs/{id}/events", Scope::read, &send_events,
           {.summary = "Past and future events of a job",
            .help = "As Server-Sent Events (Accept: text/event-stream), past events come first, in "
                    "order, then new ones; nothing follows the end.",
            .parameters = event_stream_parameters(),
            .answers = {content(
                "Events; as Server-Sent Events for clients that accept them, with the "
                "job's progress (`progress`) and the newest image with labels "
                "(`preview`: name, href) in between, until the job has ended.",
                {{"application/json", "EventList"}, {"text/event-stream"}})}}),
       on_get(
           "/v1/jobs/{id}/plan", Scope::read, &send_job_plan,
           {.summary = "The floor plan of the job's scenario with the planned paths of its drones",
            .answers = {content("The plan of the job's first run. Drones whose path depends on the "
                                "people that they see have a start only.",
                                {{"image/svg+xml"}})}})});
}

}  // namespace throng::server
