// JSON documents that extend another document: they contain only the differences (RFC 7396).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"

namespace throng::world {

/// A document, the document that it extends, and the result of merging both.
struct ExtendedDocument {
  /// The merged document, without "extends".
  nlohmann::json whole;
  nlohmann::json own;   ///< content of the file itself; equal to `whole` if it extends nothing
  nlohmann::json base;  ///< content of the extended file; null if there is none
  std::string file, base_file;  ///< names in messages

  /// Sets the source of each problem in `whole`: `base_file` if only the base has the value that
  /// the problem points to, else `file`.
  std::vector<Problem> in_their_files(std::vector<Problem> problems) const;
};

/// Reads a file and the file in the same folder that its key "extends" names. `source` names the
/// file in messages. Throws InputError, also if the extended file extends another one, and
/// EnvironmentError if a file cannot be read.
ExtendedDocument read_extended(const std::filesystem::path& file, const std::string& source);

/// Returns the result of `read`; an InputError of `read` is rethrown with the sources of
/// in_their_files().
template <typename Read>
auto read_with_files(const ExtendedDocument& document, Read read) {
  try {
    return read();
  } catch (const InputError& error) {
    throw InputError(document.in_their_files(error.problems()));
  }
}

}  // namespace throng::world
