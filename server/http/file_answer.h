// Answers that are files, or parts of something as long as a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "server/http/http_fwd.h"

namespace throng::server {

/// The whole of an answer is sent, whatever range is asked for: the library would cut any, also a
/// file that reports an error.
void forget_ranges(const httplib::Request& request);

/// Puts the one range that the client may have into the request, where the library looks for it: it
/// would itself answer ranges past the end, several at once, and ignore If-Range. Sets ETag and
/// Accept-Ranges. Throws HttpError 416.
void settle_range(const httplib::Request& request, httplib::Response& response,
                  const std::string& etag, std::int64_t size);

/// Answers with a file or the part of it that is asked for, in constant memory; 304 to clients that
/// have it already. `etag` is with its quotes. Throws EnvironmentError when it cannot be read.
void answer_with_file(const httplib::Request& request, httplib::Response& response,
                      const std::filesystem::path& file, const std::string& type,
                      const std::string& etag);

/// A file that may still grow, as it is now.
void answer_with_growing_file(const httplib::Request& request, httplib::Response& response,
                              const std::filesystem::path& file, const std::string& type);

/// The media type of a file of a dataset, by its name.
std::string media_type(const std::filesystem::path& file);

}  // namespace throng::server
