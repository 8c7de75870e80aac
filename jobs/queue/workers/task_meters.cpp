#include "jobs/queue/workers/task_meters.h"

#include <string_view>

namespace throng::jobs {

namespace {

/// Name of a kind of task: that of the task without the numbers of run and shard.
std::string kind_name(const Task& task) {
  if (task.kind == Task::Kind::study_run) return kStudyRunName;
  std::string name = to_string(task);
  name = name.substr(name.rfind('/') + 1);
  return name.substr(0, name.find_last_not_of("0123456789") + 1);
}

}  // namespace

std::string to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::succeeded:
      return "succeeded";
    case Outcome::input_error:
      return "input_error";
    case Outcome::environment_error:
      return "environment_error";
    case Outcome::crashed:
      return "crashed";
    case Outcome::timed_out:
      return "timed_out";
    case Outcome::out_of_memory:
      return "out_of_memory";
    case Outcome::cancelled:
      break;
  }
  return "cancelled";
}

void TaskMeters::note(const Task& task, const std::string& outcome, double seconds) {
  const std::string kind = kind_name(task);
  if (outcome == to_string(Outcome::succeeded)) {
    seconds_.add(prometheus_labels({{"kind", kind}}), seconds);
  }
  attempts_.add(prometheus_labels({{"kind", kind}, {"outcome", outcome}}));
}

}  // namespace throng::jobs
