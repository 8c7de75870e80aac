// Attempts at tasks that were submitted as one array job of Slurm.
#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <future>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "base/compute/steady_time.h"
#include "jobs/queue/slurm/message_file_reader.h"
#include "jobs/queue/slurm/slurm_controller.h"

namespace throng::jobs {

/// An attempt that was submitted.
struct SlurmEntry {
  SlurmEntry(std::size_t its_task, std::size_t its_index,
             const std::filesystem::path& messages_file)
      : task(its_task), index(its_index), messages(messages_file) {}
  std::size_t task;   ///< index in SlurmCall::tasks
  std::size_t index;  ///< index in its array
  MessageFileReader messages;
  std::string node = {};                  ///< "" until it was seen running
  SteadyTime begun = {};                  ///< when it was first seen running
  SteadyTime heard = {};                  ///< time of the last message, or when suspended
  std::optional<SteadyTime> ended = {};   ///< since when Slurm reports its end
  std::optional<SteadyTime> absent = {};  ///< since when squeue does not list it
  bool is_in_accounting = false;          ///< sacct was asked for it
  bool is_open = true;
};

/// An array job.
struct SlurmArray {
  std::string name = {};
  std::string job = {};  ///< number of the array job; "" until it is known
  std::optional<std::future<SlurmAnswer>> submission = {};
  std::optional<std::future<SlurmAnswer>> accounting = {};  ///< answer of sacct, if asked
  std::vector<std::size_t> to_cancel = {};                  ///< indices, for the next scancel
  SteadyTime since = steady_now();  ///< earlier answers of squeue are ignored
  int looks_without = 0;            ///< number of looks that did not find its name
  SteadyTime last_look = {};
  int nice = 0;
  std::list<SlurmEntry> entries = {};

  bool is_open() const {
    return std::any_of(entries.begin(), entries.end(),
                       [](const SlurmEntry& entry) { return entry.is_open; });
  }
  /// Whether an attempt at this task is or was in it.
  bool holds(std::size_t task) const {
    return std::any_of(entries.begin(), entries.end(),
                       [task](const SlurmEntry& entry) { return entry.task == task; });
  }
};

}  // namespace throng::jobs
