#include "server/api/live_api.h"
#include "server/routes/resources.h"

namespace throng::server {

std::vector<Route> live_routes() {
  return tagged(
      "live",
      {begins_work(on_post(
           "/v1/live", Scope::submit, &begin_live,
           {.summary = "Begin a live flight of a job's drones (docs/studio.md)",
            .help = "The answer is 503 when there are too many flights, or too little memory.",
            .body = json_body(closed({{"job", "object",
                                       "A job as for POST /v1/jobs. Its first run is flown; all of "
                                       "its drones take commands."},
                                      {"record?", with_default("boolean", false),
                                       "Record the flight: messages of ROS 2 as MCAP, for GET "
                                       "/v1/live/{id}/recording (docs/studio.md)."}})),
            .answers = {created("The flight has begun; time runs while a client reads its stream.",
                                "LiveFlight")}})),
       on_get("/v1/live", Scope::submit, &list_live,
              {.summary = "List one's own live flights",
               .answers = {ok("The flights that go on, and those whose outcome is still known.",
                              object({{"flights", "LiveFlight[]"}}))}}),
       on_get("/v1/live/{id}", Scope::submit, &send_live,
              {.summary = "Get a live flight",
               .answers = {ok("The state of the flight.", "LiveFlight")}}),
       on_get(
           "/v1/live/{id}/stream", Scope::submit, &stream_live,
           {.summary = "Positions and images of a live flight as they come",
            .help = "Time stands still while nobody reads a stream. A flight ends when nobody has "
                    "read its stream for 30 s.",
            .answers = {content(
                "Messages until the flight ends; docs/studio.md describes their bytes.",
                {{"application/octet-stream"}})}}),
       on_get("/v1/live/{id}/recording", Scope::submit, &send_live_recording,
              {.summary = "The recording of a live flight: messages of ROS 2 (MCAP)",
               .help =
                   "It is there once a flight that was begun with \"record\" has ended, as long as "
                   "its outcome: 404 for a flight without a recording, 409 for one that goes on.",
               .answers = {file("The recording (docs/studio.md), with Content-Length and ETag.",
                                {{"application/octet-stream"}})},
               .problems = {409}}),
       unaudited(on_post(
           "/v1/live/{id}/commands", Scope::submit, &command_live,
           {.summary = "Fly the drones",
            .help =
                "Fields that are left out keep their values. A velocity and a yaw rate hold for "
                "one "
                "simulated second after they were commanded, then the drone hovers, whatever other "
                "drones are commanded; drones that fly to points or to their start go on. A "
                "velocity "
                "other than 0 ends that.",
            .body = json_body("LiveCommands"),
            .answers = {done("The flight has received the commands.")},
            .problems = {409}})),
       on_post("/v1/live/{id}/stop", Scope::submit, &stop_live,
               {.summary = "End a live flight: pilot logs, and the job that repeats it",
                .help = "A flight before its first step is answered with 409.",
                .answers = {ok("The flight with its result.", "LiveFlight")},
                .problems = {409}}),
       on_delete("/v1/live/{id}", Scope::submit, &remove_live,
                 {.summary = "End a live flight without an outcome",
                  .answers = {done("It has been removed.")}})});
}

}  // namespace throng::server
