// Responses with files and byte ranges.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "server/http/http_fwd.h"

namespace throng::server {

/// Whether the client has the content with this ETag (If-None-Match: a list of ETags, or *); the
/// response is then 304. `etag` includes its quotes.
bool is_current(const httplib::Request& request, httplib::Response& response,
                const std::string& etag);

/// Makes the library send the range that the client gets (range_answer()). Sets ETag and
/// Accept-Ranges. `etag` includes its quotes. Throws HttpError 416.
void settle_range(const httplib::Request& request, httplib::Response& response,
                  const std::string& etag, std::int64_t size);

/// Responds with a file or the requested range of it, in constant memory, or with 304 to clients
/// that have it already. `etag` includes its quotes. Throws EnvironmentError if the file cannot be
/// read.
void answer_with_file(const httplib::Request& request, httplib::Response& response,
                      const std::filesystem::path& file, const std::string& type,
                      const std::string& etag);

/// Responds with the present content of a file that may still grow.
void answer_with_growing_file(const httplib::Request& request, httplib::Response& response,
                              const std::filesystem::path& file, const std::string& type);

/// The media type of a dataset's file, from its name.
std::string media_type(const std::filesystem::path& file);

}  // namespace throng::server
