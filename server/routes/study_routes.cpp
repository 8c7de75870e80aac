#include "server/api/events_api.h"
#include "server/api/studies_api.h"
#include "server/routes/parameters.h"
#include "server/routes/resources.h"

namespace throng::server {

std::vector<Route> study_routes() {
  return tagged(
      "studies",
      {begins_work(on_post(
           "/v1/studies", Scope::submit, &submit_study,
           {.summary = "Queue a study: cases times policies times paired runs (docs/study.md)",
            .help =
                "Every mistake is named with its pointer (400). A study counts as a job for the "
                "key's limits (429).",
            .parameters = {dry_run("Whether the study is only checked.")},
            .body = json_body("object",
                              "A study as `throng study` takes it; at most 20 000 simulations."),
            .answers = {ok("With dry_run, the plan of the study: cases, policies, number of "
                           "simulations, memory.",
                           "StudyPlan"),
                        created("The study is queued and will survive a crash.", "Study")}})),
       on_get("/v1/studies", Scope::read, &list_studies,
              {.summary = "List studies",
               .parameters = page_parameters(),
               .answers = {ok("A page of the list, newest first.", "StudyList")}}),
       on_get(
           "/v1/studies/{id}", Scope::read, &send_study,
           {.summary = "A study with its plan, its progress, and the summary of the runs that are "
                       "there so far",
            .answers = {ok("The study.", intersection({"Study", object({{"plan", "any"},
                                                                        {"summary", "any"}})}))}}),
       on_patch(
           "/v1/studies/{id}", Scope::submit, &change_study,
           {.summary = "Change priority, labels, or whether the study is never removed for its age",
            .body = json_body("JobChange"),
            .answers = {ok("The study.", "Study")}}),
       on_delete("/v1/studies/{id}", Scope::submit, &remove_study,
                 {.summary = "End a study and remove its files",
                  .help = "An active study is ended first.",
                  .answers = {done("It has been removed.")}}),
       on_post("/v1/studies/{id}/cancel", Scope::submit, &cancel_study,
               {.summary = "Cancel a study; finished runs are kept for a retry",
                .answers = {ok("The study.", "Study")},
                .problems = {409}}),
       begins_work(on_post(
           "/v1/studies/{id}/retry", Scope::submit, &retry_study,
           {.summary = "Queue a failed or cancelled study again; finished runs are not repeated",
            .answers = {ok("The study.", "Study")},
            .problems = {409}})),
       on_get(
           "/v1/studies/{id}/events", Scope::read, &send_study_events,
           {.summary = "Past and future events of a study, with its progress",
            .parameters = event_stream_parameters(),
            .answers = {content("Events; as Server-Sent Events for clients that accept them, until "
                                "the study has ended.",
                                {{"application/json", "EventList"}, {"text/event-stream"}})}}),
       with_scripts(
           on_get("/v1/studies/{id}/report", Scope::read, &send_study_report,
                  {.summary = "The report as one HTML page",
                   .help = "The answer is 409 until the study has succeeded.",
                   .answers = {file("The page, complete in one file.", {{"text/html", "string"}})},
                   .problems = {409}})),
       on_get(
           "/v1/studies/{id}/files/{path}", Scope::read, &send_study_file,
           {.summary =
                "summary.json, summary.csv, summary.md, values.json (the figures of each run) "
                "or runs/CASE/POLICY/000.json",
            .help = "values.json and results of runs are there while the study runs, too.",
            .parameters = {path_part("path", "Path of the file, which may contain slashes.")},
            .answers = {file("The file.",
                             {{"application/json", "object",
                               "The content of the file; values.json has the form of StudyValues."},
                              {"text/csv"},
                              {"text/markdown"}})},
            .problems = {409}})});
}

}  // namespace throng::server
