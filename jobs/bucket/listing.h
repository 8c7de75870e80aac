// The XML answers of an object store.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/bucket/url_text.h"

namespace throng::bucket {

struct ListedObject {
  std::string key;
  std::int64_t bytes = 0;
  std::string tag;  ///< ETag without quotes
};

struct ListedUpload {
  std::string key;
  std::string id;
};

struct ListedPart {
  int number = 0;
  std::int64_t bytes = 0;
  std::string tag;
};

/// A page of a listing; with the query parameters that ask for the next one, if there is one.
template <typename Entry>
struct Page {
  std::vector<Entry> entries;
  Pairs next;
};

/// Entries of an answer of ListObjectsV2, ListMultipartUploads and ListParts. Throw
/// EnvironmentError when it is no such XML.
Page<ListedObject> read_objects(const std::string& xml);
Page<ListedUpload> read_uploads(const std::string& xml);
Page<ListedPart> read_parts(const std::string& xml);

/// The text of a child of the root, for example "UploadId"; "" if there is none.
std::string read_value(const std::string& xml, const char* name);

/// Why a store refuses a request.
struct StoreError {
  std::string code;  ///< "": the text is no error
  std::string message;
};

/// Only these two: others of its elements may hold key ids and what was signed.
StoreError read_error(const std::string& xml);

/// For people: "AccessDenied: Access Denied", or the status alone.
std::string error_text(const StoreError& error, long status);

/// The first line of text that a store has sent, of bounded length and without control characters.
std::string first_line(std::string_view text);

std::string without_quotes(std::string_view tag);

}  // namespace throng::bucket
