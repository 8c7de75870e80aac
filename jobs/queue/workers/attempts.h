// Attempts at tasks by processes that are no children of their supervisor: what both sides keep in
// the job's folder, which is on a file system that they share.
//
//   attempts/ARRAY/array.json      the tasks of one array job, in the order of their indices
//   attempts/ARRAY/slurm_job       the array job's number, once it is known
//   attempts/ARRAY/out/            what Slurm itself prints, per index
//   attempts/ARRAY/INDEX/          one attempt at one task: the right to publish its output
//     claim                        who began it: exists from then on; nobody begins it again
//     messages                     lines of jobs/queue/workers/worker_messages.h, and how it ended
//     ...                          output under construction (base/files/staging.h)
//
// ARRAY is a random word, so that an attempt's folder is a fencing token: it exists as long as the
// attempt may publish. Its supervisor takes the right away by removing it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "jobs/queue/dataset/folder.h"

namespace throng::jobs {

/// One attempt at a task.
struct Attempt {
  std::string task;  ///< to_string(Task)
  int number = 1;    ///< how often the task has been begun, this time included
};

struct AttemptArray {
  std::string name;  ///< of its folder
  std::vector<Attempt> attempts;
  /// Environment variables of its workers.
  std::vector<std::pair<std::string, std::string>> variables = {};
};

/// attempts/ of a job.
std::filesystem::path attempts_folder(const JobFolder& folder);
std::filesystem::path array_folder(const JobFolder& folder, const std::string& array);
std::filesystem::path attempt_folder(const JobFolder& folder, const std::string& array,
                                     std::size_t index);

/// Makes the folders of an array under a new name, which is filled in. Throws EnvironmentError.
void create_attempts(const JobFolder& folder, AttemptArray& array);

/// Arrays that are there. One that cannot be read (its making was broken off) is removed.
std::vector<AttemptArray> read_attempts(const JobFolder& folder);

/// Notes the number of the array job, or reads it: "" when it is not known.
void note_array_job(const JobFolder& folder, const std::string& array, const std::string& number);
std::string noted_array_job(const JobFolder& folder, const std::string& array);

/// Takes the right to publish away: when it returns nothing of the attempt can be published any
/// more. Throws EnvironmentError when the folder cannot be removed.
void revoke_attempt(const JobFolder& folder, const std::string& array, std::size_t index);

/// Takes the right of an attempt away and makes a new one of the same index, for a task that
/// Slurm begins again under its number. False when there is no room for it. Throws as
/// revoke_attempt().
bool renew_attempt(const JobFolder& folder, const std::string& array, std::size_t index);

/// Removes the array with all its attempts. Throws EnvironmentError.
void remove_attempts(const JobFolder& folder, const std::string& array);

/// The process that began an attempt.
struct AttemptClaim {
  std::string node;
  int pid = 0;
};

/// Nothing as long as nobody has.
std::optional<AttemptClaim> find_claim(const JobFolder& folder, const std::string& array,
                                       std::size_t index);

/// How an attempt ended, as its worker says.
struct AttemptEnd {
  int code = 0;                        ///< WorkerExit
  double seconds = 0;                  ///< that it took
  std::vector<std::string> published;  ///< paths, relative to the job's folder
};

/// A line of `messages`.
std::string attempt_end_line(const AttemptEnd& end);
std::optional<AttemptEnd> read_attempt_end(const std::string& line);

}  // namespace throng::jobs
