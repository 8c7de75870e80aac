#include "server/live/kept_messages.h"
#include "server/routes/resources.h"

namespace throng::server {

std::vector<NamedSchema> live_schemas() {
  return {
      {"LiveFlight",
       object({{"id", "string"},
               {"name", "string", "Name of the job."},
               {"state", enumeration(LiveState::starting, LiveState::failed)},
               {"time_s", "number", "Simulated time, s."},
               {"viewers", "integer", "Number of streams that are being read."},
               {"drones", "string[]"},
               {"recorded", "boolean", "Whether it was begun with \"record\"."},
               {"result?", "LiveResult?", "Result of a flight that has ended; lists leave it out."},
               {"error", nullable(object({{"kind", "string"}, {"message", "string"}}))},
               {"links", object({{"self", "string"},
                                 {"stream", "string"},
                                 {"recording", "string?",
                                  "Address of the recording once the flight has ended; null for a "
                                  "flight that is not recorded."}})}})},
      {"LiveResult",
       object(
           {{"duration_s", "number"},
            {"steps", "integer"},
            {"trace_sha256", "string",
             "SHA-256 of the flight's trace; the trace of the job's run000 has the same."},
            {"drones", list(object({{"id", "string"},
                                    {"csv", "string", "The pilot log (docs/guidance.md)."}}))},
            {"job", "object",
             "A job for POST /v1/jobs that flies the logs again, as set-points of the policy "
             "pilot_log."},
            {"warnings", "string[]"},
            {"recording",
             nullable(object({{"complete_until_s", "number",
                               "All messages before this simulated time are in the recording, s."},
                              {"problem", "string?",
                               "Why the recording ended before the flight, such as a full disk; "
                               "null if it did not."},
                              {"bytes", "integer", "Size of the file."}})),
             "How far the recording goes; null for a flight that was not recorded."}})},
      {"LiveCommands",
       closed(
           {{"sequence?", fields::integers(0, 4294967295),
             "Number that comes back with the states and images in which the commands are in "
             "force."},
            {"paused?", "boolean"},
            {"factor?", fields::numbers(0.1, 10),
             "Simulated seconds per second; default at the start: 1."},
            {"view?", "string",
             "Id of the drone whose camera is shown; default at the start: the first drone."},
            {"drones?",
             list(closed({{"id", "string"},
                          {"velocity_mps?", list(fields::numbers(-20, 20), 3, 3),
                           "Velocity [ahead, to the left, up]. Drones fly at most 10 m/s over the "
                           "ground and 3 m/s up or down."},
                          {"yaw_rate_deg_s?", fields::numbers(-360, 360),
                           "Rate of yaw, counter-clockwise; drones turn at most at 120."},
                          {"position_m?", list(fields::numbers(-10000, 10000), 3, 3),
                           "Point [x, y, z] in the world to fly to, after the waypoints if both "
                           "are given. The drone stays there."},
                          {"waypoints_m?", list(list(fields::numbers(-10000, 10000), 3, 3), 0, 50),
                           "Points [x, y, z] in the world to fly to one after another; an empty "
                           "list ends a flight to points."},
                          {"yaw_deg?", fields::numbers(-360, 360),
                           "Heading to turn to, counter-clockwise from +x. Without points, the "
                           "drone turns where it is."},
                          {"speed_mps?", fields::numbers(0.1, 20),
                           "Speed on the way to points given with it; default: 5."},
                          {"gimbal_deg?", list(fields::numbers(-180, 180), 2, 2),
                           "Direction to turn the camera to: [pitch from -90 to 30 above the "
                           "horizon, yaw from -180 to 180 to the left of the heading]. Gimbals "
                           "turn at most at 60 degrees/s; a rigid camera has none."},
                          {"beacon?", "boolean", "Whether people may follow the drone."},
                          {"return_home?", "boolean",
                           "Whether the drone returns to its start, until it is steered again."}}),
                  0, 100)}})}};
}

}  // namespace throng::server
