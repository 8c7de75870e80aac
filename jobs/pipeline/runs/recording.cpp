#include "jobs/pipeline/runs/recording.h"

#include <fmt/core.h>

#include <filesystem>
#include <utility>

#include "base/files/hash.h"
#include "metrics/trajectories/recorded_findings.h"
#include "metrics/trajectories/trajectory_file.h"

namespace throng::jobs {

void identify_recording(RecordedSpec& recorded, std::vector<Problem>& problems) {
  const std::string expected = std::exchange(recorded.sha256, "");
  if (!std::filesystem::is_regular_file(recorded.file)) {
    problems.push_back(
        {"", "/crowd/recorded/file",
         fmt::format("\"{}\", which does not exist", recorded.file.filename().string()),
         "the name of a trajectory file, from the job's folder"});
    return;
  }
  recorded.sha256 = sha256_hex_of_file(recorded.file);
  if (expected.empty() || recorded.sha256 == expected) return;
  problems.push_back(
      {"", "/crowd/recorded/sha256", fmt::format("a file with {}", recorded.sha256), expected});
}

world::Trace read_recording(const RecordedSpec& recorded, std::vector<Problem>* notes) {
  return metrics::read_trajectory(recorded.file, recorded.walkers, recorded.format, notes);
}

std::vector<Problem> recording_warnings(std::vector<Problem> notes, const world::Trace& recording,
                                        const world::Scenario& scenario) {
  for (Problem& finding : metrics::find_people_in_buildings(recording, scenario)) {
    notes.push_back(std::move(finding));
  }
  for (Problem& note : notes) note.where = "/crowd/recorded/file";
  return notes;
}

}  // namespace throng::jobs
