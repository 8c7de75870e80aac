// Attempts at tasks by processes that are not children of their supervisor: the files through which
// both sides communicate, in the job's folder on a shared file system.
//
//   attempts/ARRAY/array.json      the tasks of one array job, in the order of their indices
//   attempts/ARRAY/slurm_job       the array job's number, once it is known
//   attempts/ARRAY/out/            output of Slurm itself, per index
//   attempts/ARRAY/INDEX/          one attempt at one task: the right to publish its output
//     claim                        node and process that started the attempt; no other may start it
//     messages                     lines of jobs/queue/workers/worker_messages.h, then AttemptEnd
//     ...                          output under construction (base/files/staging.h)
//
// ARRAY is a random word, so that an attempt's folder is a fencing token: it exists as long as the
// attempt may publish. The supervisor revokes the right by removing the folder.
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
  int number = 1;    ///< 1 for the first attempt at the task
};

/// The attempts of one array job.
struct AttemptArray {
  std::string name;               ///< of its folder
  std::vector<Attempt> attempts;  ///< by index
  /// Environment variables of its workers.
  std::vector<std::pair<std::string, std::string>> variables = {};
};

/// The folders attempts/, attempts/ARRAY/ and attempts/ARRAY/INDEX/ of a job.
std::filesystem::path attempts_folder(const JobFolder& folder);
std::filesystem::path array_folder(const JobFolder& folder, const std::string& array);
std::filesystem::path attempt_folder(const JobFolder& folder, const std::string& array,
                                     std::size_t index);

/// Creates the folders of an array under a new random name and sets `array.name` to it. Throws
/// EnvironmentError.
void create_attempts(const JobFolder& folder, AttemptArray& array);

/// Reads all arrays of a job, sorted by name. Removes those that cannot be read because their
/// creation was interrupted.
std::vector<AttemptArray> read_attempts(const JobFolder& folder);

/// Removes what a process that was killed has left of the arrays of a job that is done. Their tasks
/// in a queue find nothing to do. Throws EnvironmentError.
void end_all_attempts(const JobFolder& folder);

/// Write and read the number of the array job; "" if it is not known yet.
void note_array_job(const JobFolder& folder, const std::string& array, const std::string& number);
std::string noted_array_job(const JobFolder& folder, const std::string& array);

/// Revokes the right to publish: after the return, no output of the attempt can be published any
/// more. Throws EnvironmentError if the folder cannot be removed.
void revoke_attempt(const JobFolder& folder, const std::string& array, std::size_t index);

/// Revokes an attempt and creates a new one with the same index, for a task that Slurm restarts
/// under its number. Returns false if the new folder cannot be created. Throws as revoke_attempt().
bool renew_attempt(const JobFolder& folder, const std::string& array, std::size_t index);

/// Removes the array with all its attempts. Throws EnvironmentError.
void remove_attempts(const JobFolder& folder, const std::string& array);

/// The process that started an attempt.
struct AttemptClaim {
  std::string node;
  int pid = 0;
};

/// Reads the claim of an attempt; std::nullopt if no process has started it.
std::optional<AttemptClaim> find_claim(const JobFolder& folder, const std::string& array,
                                       std::size_t index);

/// The end of an attempt as its worker reports it.
struct AttemptEnd {
  int code = 0;                        ///< WorkerExit
  double seconds = 0;                  ///< duration
  std::vector<std::string> published;  ///< paths, relative to the job's folder
};

/// Conversion to and from a line of `messages`, without line break. Reading returns std::nullopt
/// for other lines.
std::string attempt_end_line(const AttemptEnd& end);
std::optional<AttemptEnd> read_attempt_end(const std::string& line);

}  // namespace throng::jobs
