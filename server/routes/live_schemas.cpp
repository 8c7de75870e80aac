#include "server/live/kept_messages.h"
#include "server/routes/resources.h"
#include "spec/live/commands.h"

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
      {"LiveCommands", ValueType(live::commands_schema())}};
}

}  // namespace throng::server
