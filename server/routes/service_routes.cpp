#include "server/api/events_api.h"
#include "server/api/service_api.h"
#include "server/api/session_api.h"
#include "server/routes/parameters.h"
#include "server/routes/resources.h"
#include "server/routes/route_table.h"

namespace throng::server {

std::vector<Route> service_routes() {
  return tagged(
      "service",
      {on_get("/v1/events", Scope::read, &send_events,
              {.summary = "Events of all jobs, calibrations and studies",
               .parameters = event_parameters(),
               .answers = {content("Like a job's events; a stream does not end.",
                                   {{"application/json", "EventList"}, {"text/event-stream"}})}}),
       on_post("/v1/session", Scope::anybody, &open_session,
               {.summary = "Sign a browser in: a key becomes a cookie that scripts cannot read",
                .body = json_body(object({{"key", "string"}})),
                .answers = {json_answer(
                    200,
                    "The session, with a cookie, which browsers send with requests of "
                    "this service's pages.",
                    "Session", "Set-Cookie")},
                .problems = {401, 403, 503}}),
       on_get("/v1/session", Scope::anybody, &send_session,
              {.summary = "Whether a key is needed, and the caller's scope",
               .answers = {ok("The session of the request's key or cookie.", "Session")},
               .problems = {503}}),
       on_delete("/v1/session", Scope::anybody, &close_session,
                 {.summary = "Sign a browser out",
                  .answers = {done("The session has ended.", "Set-Cookie")},
                  .problems = {403, 503}}),
       on_get("/v1/access/submit", Scope::submit, &confirm_access,
              {.summary = "Whether the caller's key may send jobs, for proxies that ask before "
                          "they read a body",
               .answers = {done("The key may send jobs.")}}),
       on_post(
           "/v1/service/drain", Scope::admin, &begin_drain,
           {.summary = "End the service when its running tasks have finished (administrators)",
            .help = "From now on requests that queue work get 503 with `Retry-After`, and so does "
                    "`/readyz`; no task is begun. The service ends when no task runs, or after "
                    "`throng serve --drain-timeout`. Queued and running jobs stay so, and go on at "
                    "its next start.",
            .answers = {json_answer(202, "The service is draining.",
                                    object({{"status", constant("draining")}}))}}),
       on_get("/v1/version", Scope::anybody, &send_version,
              {.summary = "Get the name and version of the program",
               .answers = {ok("Name and version.", object({{"name", constant("throng")},
                                                           {"version", "string"},
                                                           {"api", constant("v1")}}))}}),
       on_get("/openapi.json", Scope::anybody, &send_openapi,
              {.summary = "Get this document",
               .answers = {ok("The document (OpenAPI 3.1).", "object")}}),
       on_get("/metrics", Scope::read, &send_service_metrics,
              {.summary = "Figures of the service for Prometheus",
               .answers = {content("The figures in the text format of Prometheus.",
                                   {{"text/plain"}})}}),
       on_get("/healthz", Scope::anybody, &send_health,
              {.summary = "Whether the service is alive",
               .answers = {ok("The service is alive.", object({{"status", constant("ok")}}))}}),
       on_get(
           "/readyz", Scope::anybody, &send_readiness,
           {.summary = "Whether jobs can be taken in and worked on",
            .help = "The answer is 503 when the disk is full or read-only, and while the service "
                    "drains. Only callers with a key see the figures.",
            .answers = {ok("Jobs can be taken in and worked on.",
                           object({{"status", constant("ready")}, {"free_bytes", "integer"}}))},
            .problems = {503}})});
}

}  // namespace throng::server
