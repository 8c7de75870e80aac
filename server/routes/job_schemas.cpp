#include <array>

#include "jobs/queue/supervisor.h"
#include "server/access/keys.h"
#include "server/api/row_changes.h"
#include "server/routes/resources.h"

namespace throng::server {

namespace {

ValueType event_type() {
  std::vector<std::string_view> types = {"submitted", "stage", "changed", "removed"};
  types.reserve(types.size() + jobs::kJobEvents.size());
  for (const jobs::JobEvent event : jobs::kJobEvents) types.push_back(to_string(event));
  return words(types);
}

}  // namespace

ValueType links() {
  return ValueType(
      {{"type", "object"}, {"required", {"self"}}, {"additionalProperties", {{"type", "string"}}}});
}

ValueType row(ValueType state, ValueType progress, const std::vector<Member>& more) {
  std::vector<Member> members = {
      {"id", "string"},
      {"name", "string"},
      {"state", std::move(state)},
      {"attempt", "integer", "Number of times that work on it was begun or taken up."},
      {"priority", "integer"},
      {"labels", "string[]"},
      {"owner", "string?", "Id of the key that it came with."},
      {"created_at", "time?"},
      {"started_at", "time?"},
      {"ended_at", "time?"},
      {"expires_at", "time?",
       "Time when it will be removed for its age; it is removed earlier where all jobs together "
       "take too much disk."},
      {"keep", "boolean", "Whether it is never removed for its age."},
      {"bytes", "integer", "Disk space of its files, measured when it ended."},
      {"waiting_for", "string?", "Reason why nobody works on it although it is its turn."},
      {"progress", std::move(progress)},
      {"error", "JobError?"},
      {"links", links()}};
  members.insert(members.end(), more.begin(), more.end());
  return closed(members);
}

std::vector<NamedSchema> job_schemas() {
  return {
      {"Job", row(enumeration(jobs::JobState::queued, jobs::JobState::cancelled), "Progress",
                  {{"job?", "object", "The job with all defaults. Not in lists."}})},
      {"JobList", object({{"jobs", "Job[]"}, {"next", "string?"}})},
      {"JobChange", closed({{"priority?", fields::integers(-kMaxPriority, kMaxPriority)},
                            {"labels?", list(text_up_to(kMaxLabelLength), 0, kMaxLabels)},
                            {"keep?", "boolean"}})},
      {"JobError", object({{"kind", words({"input", "environment", "partial"})},
                           {"message", "string"},
                           {"problems", "Mistake[]"},
                           {"runs?",
                            list(object({{"run", "string"},
                                         {"task", "string"},
                                         {"message", "string"},
                                         {"attempts", "integer"}})),
                            "Failed runs of a partial job."}})},
      {"Progress",
       object(
           {{"stage?", enumeration(jobs::Stage::waiting, jobs::Stage::failed)},
            {"publishing?",
             object(
                 {{"address", "string",
                   "Address of the dataset in the object store, s3://BUCKET/PREFIX."},
                  {"bytes_done", "integer", "Bytes that are known to be there."},
                  {"bytes_total", "integer", "Bytes of the dataset; 0 while that is not known."},
                  {"objects", "integer?", "Number of the dataset's objects, once all are there."}}),
             "Publication of the dataset: only for a job with outputs.publish, once its dataset is "
             "finished (docs/publishing.md)."},
            {"frames_done?", "integer"},
            {"frames_total?", "integer"},
            {"runs?",
             list(object({{"run", "string"},
                          {"seed", "integer", "Seed of the run, of up to 64 bits."},
                          {"stage", enumeration(jobs::Stage::waiting, jobs::Stage::failed)},
                          {"simulated_s", "number"},
                          {"duration_s", "number"},
                          {"frames_done", "integer"},
                          {"frames_total", "integer"},
                          {"frames_per_s", "number"},
                          {"remaining_s", "number?"}}))},
            {"shards?",
             list(object(
                 {{"shard", "string"},
                  {"frames_done", "integer"},
                  {"frames_total", "integer"},
                  {"frames_per_s", "number"},
                  {"remaining_s", "number?"},
                  {"node?", "string",
                   "Node of the cluster; left out where workers run on the service's machine."}})),
             "The shards that are being rendered."},
            {"nodes?",
             list(object({{"node", "string"},
                          {"running", "integer", "Number of tasks that the node is working on."},
                          {"done", "integer", "Number of tasks that succeeded."},
                          {"failed", "integer",
                           "Number of failed attempts at tasks, including those that were lost "
                           "with the node."},
                          {"busy_s", "number", "Duration of all attempts that ended, s."}})),
             "The work of a cluster's nodes for the job; empty where workers run on the service's "
             "machine."},
            {"frames_per_s?", "number", "Frames per second; 0 before the first frame."},
            {"remaining_s?", "number?",
             "Remaining time at this rate, s; null before the first frame."}}),
       "Progress of a job; empty before the job has begun."},
      {"DryRun",
       closed(
           {{"valid", constant(true)},
            {"runs", "integer"},
            {"shards", "integer"},
            {"frames", "integer", "Number of frames of all cameras."},
            {"people", "integer", "Number of people in the first run, arrivals included."},
            {"estimate", "JobEstimate"},
            {"views", "CameraView[]",
             "Views of those cameras of the first run whose path does not depend on the people "
             "that they see."},
            {"warnings", "Mistake[]", "Parts of the job that work and are probably not intended."},
            {"job", "object"}})},
      {"JobEstimate", closed({{"cpu_s", "number", "CPU time of all processes of the job, s."},
                              {"disk_bytes", "integer"},
                              {"memory_mib", "integer", "Memory of the largest task, MiB."},
                              {"basis", words({"this machine", "reference machine"}),
                               "The machine that takes cpu_s: this one, as its last jobs took, or "
                               "before its first job the one that the estimates were made on."}})},
      {"CameraView", closed({{"drone", "string"},
                             {"max_area_share", "number",
                              "Largest share of the scenario's area in one image, 0 to 1."},
                             {"max_person_px", "number",
                              "Largest height of a person in an image; 0: nobody is in any."}})},
      {"Event", closed({{"seq", "integer"},
                        {"job", "string"},
                        {"at", "time"},
                        {"type", event_type()},
                        {"data", "object"}})},
      {"EventList", object({{"events", "Event[]"},
                            {"next", "integer", "The value of `after` for the next request."}})}};
}

}  // namespace throng::server
