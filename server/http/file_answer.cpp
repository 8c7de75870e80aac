#include "server/http/file_answer.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

#include "base/error.h"
#include "base/files/read_only_file.h"
#include "server/http/byte_range.h"
#include "server/http/http.h"
#include "server/http/http_error.h"
#include "server/http/request_head.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
namespace fs = std::filesystem;

namespace {

void answer_with(const Request& request, Response& response,
                 std::shared_ptr<const ReadOnlyFile> file, const std::string& type,
                 const std::string& etag) {
  if (is_current(request, response, etag)) return;
  settle_range(request, response, etag, file->size());
  const auto size = static_cast<std::size_t>(file->size());
  if (size == 0) return response.set_content("", type);
  response.set_content_provider(
      size, type,
      [file = std::move(file), buffer = std::vector<char>()](std::size_t offset, std::size_t length,
                                                             httplib::DataSink& sink) mutable {
        constexpr std::size_t kBlock = 1 << 20;
        buffer.resize(std::min(length, kBlock));
        try {
          const std::size_t count = file->read_at(static_cast<std::int64_t>(offset), buffer);
          if (count > 0) return sink.write(buffer.data(), count);
        } catch (const EnvironmentError& error) {
          spdlog::error("{}", error.what());
        }
        return false;  // the length has been promised: all that is left is to break off
      });
}

}  // namespace

bool is_current(const Request& request, Response& response, const std::string& etag) {
  const std::string known = request.get_header_value("If-None-Match");
  constexpr std::string_view kWeak = "W/";
  bool is_known = known == "*";
  for (std::string_view rest = known; !rest.empty() && !is_known;) {
    const auto comma = std::min(rest.find(','), rest.size());
    std::string_view tag = rest.substr(0, comma);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
    tag.remove_prefix(std::min(tag.find_first_not_of(" \t"), tag.size()));
    tag = tag.substr(0, tag.find_last_not_of(" \t") + 1);
    if (tag.starts_with(kWeak)) tag.remove_prefix(kWeak.size());
    is_known = tag == etag;
  }
  if (!is_known) return false;
  response.set_header("ETag", etag);
  response.status = 304;
  return true;
}

void settle_range(const Request& request, Response& response, const std::string& etag,
                  std::int64_t size) {
  const RangeAnswer answer = range_answer(request.get_header_value(kRangeField),
                                          request.get_header_value("If-Range"), etag, size);
  if (answer.kind == RangeAnswer::Kind::unsatisfiable) {
    response.set_header("Content-Range", fmt::format("bytes */{}", size));
    throw HttpError{416, fmt::format("there are {} bytes", size)};
  }
  if (answer.kind == RangeAnswer::Kind::part) {
    // The library owns the request, made it non-const, and sends the part.
    const_cast<Request&>(request)  // NOLINT(cppcoreguidelines-pro-type-const-cast)
        .ranges.emplace_back(answer.part.first, answer.part.last);
  }
  response.set_header("ETag", etag);
  response.set_header("Accept-Ranges", "bytes");
}

void answer_with_file(const Request& request, Response& response, const fs::path& file,
                      const std::string& type, const std::string& etag) {
  answer_with(request, response, std::make_shared<const ReadOnlyFile>(file), type, etag);
}

void answer_with_growing_file(const Request& request, Response& response, const fs::path& file,
                              const std::string& type) {
  auto open = std::make_shared<const ReadOnlyFile>(file);
  const std::string etag = fmt::format("\"{}-{}\"", open->size(), open->changed_ns());
  answer_with(request, response, std::move(open), type, etag);
}

std::string media_type(const fs::path& file) {
  struct Type {
    std::string_view extension;
    std::string_view type;
  };
  constexpr std::array kTypes = {
      Type{".jpg", "image/jpeg"},        Type{".png", "image/png"},
      Type{".svg", "image/svg+xml"},     Type{".json", "application/json"},
      Type{".csv", "text/csv"},          Type{".md", "text/markdown; charset=utf-8"},
      Type{".yaml", "application/yaml"}, Type{".txt", "text/plain; charset=utf-8"},
      Type{".xml", "application/xml"},   Type{".tar", "application/x-tar"}};
  const std::string extension = file.extension().string();
  const auto* found = std::find_if(kTypes.begin(), kTypes.end(),
                                   [&](const Type& type) { return type.extension == extension; });
  return std::string(found == kTypes.end() ? "application/octet-stream" : found->type);
}

}  // namespace throng::server
