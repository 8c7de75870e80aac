// Documents that extend another one: a scenario or blueprint that says what differs (RFC 7396).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::world {

/// A document as its file says it, and the one that it extends with the changes made.
struct ExtendedDocument {
  nlohmann::json whole;
  nlohmann::json own;           ///< the file's; the same as `whole` if it extends nothing
  nlohmann::json base;          ///< null if it extends nothing
  std::string file, base_file;  ///< names for messages

  /// Problems of the whole with the file of each: the base's name if the place is only there.
  std::vector<Problem> in_their_files(std::vector<Problem> problems) const;
};

/// Reads a file, and the one in the same folder that its "extends" names. Throws InputError.
ExtendedDocument read_extended(const std::filesystem::path& file, const std::string& source);

/// The result of `read`, with the names of the files in its InputError.
template <typename Read>
auto read_with_files(const ExtendedDocument& document, Read read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError(document.in_their_files(error.problems()));
  }
}

}  // namespace throng::world
