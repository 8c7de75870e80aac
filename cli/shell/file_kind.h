// Checks of the kind of a file by its content, with helpful messages for a wrong kind.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace throng::cli {

/// Throws InputError unless the file is HDF5, the format of traces. The message names the kind of
/// the file ("a job") and the command for it; for a folder, the traces in it.
void require_trace(const std::filesystem::path& file);

/// Throws InputError if a file given as trajectories is a job or another known kind of JSON.
void refuse_as_trajectory(const std::filesystem::path& file);

/// Throws InputError unless the name of a file to write ends with one of `endings`; devices are
/// accepted. `option` names the option in the message.
void check_ending(const std::string& option, const std::filesystem::path& file,
                  std::initializer_list<std::string_view> endings);

}  // namespace throng::cli
