#include "server/file_answer.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

#include "base/error.h"
#include "server/byte_range.h"
#include "server/http.h"
#include "server/http_error.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
namespace fs = std::filesystem;

namespace {

class OpenFile {
 public:
  explicit OpenFile(const fs::path& file)
      : descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
    struct stat status {};
    if (descriptor_ < 0 || ::fstat(descriptor_, &status) != 0) {
      throw EnvironmentError(
          fmt::format("cannot read {}: {}", file.string(), std::strerror(errno)));
    }
    size_ = status.st_size;
    changed_ns_ = status.st_mtim.tv_sec * 1'000'000'000LL + status.st_mtim.tv_nsec;
  }
  ~OpenFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  std::int64_t size() const { return size_; }
  std::int64_t changed_ns() const { return changed_ns_; }
  ssize_t read(std::span<char> buffer, std::int64_t offset) const {
    return ::pread(descriptor_, buffer.data(), buffer.size(), offset);
  }

 private:
  int descriptor_;
  std::int64_t size_ = 0;
  std::int64_t changed_ns_ = 0;
};

void answer_with(const Request& request, Response& response, std::shared_ptr<const OpenFile> file,
                 const std::string& type, const std::string& etag) {
  if (request.get_header_value("If-None-Match") == etag) {
    response.set_header("ETag", etag);
    response.status = 304;
    return;
  }
  settle_range(request, response, etag, file->size());
  const auto size = static_cast<std::size_t>(file->size());
  if (size == 0) return response.set_content("", type);
  response.set_content_provider(
      size, type,
      [file = std::move(file), buffer = std::vector<char>()](std::size_t offset, std::size_t length,
                                                             httplib::DataSink& sink) mutable {
        constexpr std::size_t kBlock = 1 << 20;
        buffer.resize(std::min(length, kBlock));
        const ssize_t count = file->read(buffer, static_cast<std::int64_t>(offset));
        // The length has been promised: all that is left is to break off.
        return count > 0 && sink.write(buffer.data(), static_cast<std::size_t>(count));
      });
}

}  // namespace

void settle_range(const Request& request, Response& response, const std::string& etag,
                  std::int64_t size) {
  const RangeAnswer answer = range_answer(request.get_header_value("Range"),
                                          request.get_header_value("If-Range"), etag, size);
  // The library owns the request and made it non-const.
  auto& ranges =
      const_cast<Request&>(request).ranges;  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  ranges.clear();
  if (answer.kind == RangeAnswer::Kind::unsatisfiable) {
    response.set_header("Content-Range", fmt::format("bytes */{}", size));
    throw HttpError{416, fmt::format("there are {} bytes", size)};
  }
  if (answer.kind == RangeAnswer::Kind::part) {
    ranges.emplace_back(answer.part.first, answer.part.last);
  }
  response.set_header("ETag", etag);
  response.set_header("Accept-Ranges", "bytes");
}

void answer_with_file(const Request& request, Response& response, const fs::path& file,
                      const std::string& type, const std::string& etag) {
  answer_with(request, response, std::make_shared<const OpenFile>(file), type, etag);
}

void answer_with_growing_file(const Request& request, Response& response, const fs::path& file,
                              const std::string& type) {
  auto open = std::make_shared<const OpenFile>(file);
  const std::string etag = fmt::format("\"{}-{}\"", open->size(), open->changed_ns());
  answer_with(request, response, std::move(open), type, etag);
}

std::string media_type_of(const fs::path& file) {
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
