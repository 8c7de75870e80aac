// Files that are given where another kind is expected, recognized by what is in them.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace throng::cli {

/// Throws InputError unless the file is HDF5, as traces are: what it is instead ("a job") and what
/// makes or takes such a file. Of a folder it says where its traces are.
void require_trace(const std::filesystem::path& file);

/// Throws InputError if a file of trajectories is a trace, or a job and the like.
void refuse_as_trajectory(const std::filesystem::path& file);

/// Throws InputError unless the name of a file to write ends as its contents do. Devices have any
/// name.
void check_ending(const std::string& option, const std::filesystem::path& file,
                  std::initializer_list<std::string_view> endings);

}  // namespace throng::cli
