#include "server/api/studio.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string>

#include "server/api/handler.h"
#include "server/http/file_answer.h"
#include "server/http/http.h"
#include "server/http/http_error.h"

namespace throng::embedded {
extern const std::span<const server::StudioFile> kStudio;
}  // namespace throng::embedded

namespace throng::server {

using httplib::Request;
using httplib::Response;

namespace {

constexpr const char* kAssetPath = "/assets/{name}";

// Scripts and styles are files of this service. Images are the API's, files that are chosen but not
// sent yet (blob:), and marks of the text editor (data:).
constexpr const char* kContentPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; "
    "connect-src 'self'; manifest-src 'self'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'";

const StudioFile* find_file(std::string_view name) {
  const auto files = embedded::kStudio;
  const auto found = std::find_if(files.begin(), files.end(),
                                  [&](const StudioFile& file) { return file.name == name; });
  return found == files.end() ? nullptr : &*found;
}

void send_bytes(const Request& request, Response& response, const StudioFile& file,
                const char* caching) {
  response.set_header("Cache-Control", caching);
  response.set_header("ETag", std::string(file.etag));
  response.set_header("Vary", "Accept-Encoding");
  if (response.status != 404 && is_current(request, response, std::string(file.etag))) return;
  const bool is_compressed = request.has_header("Accept-Encoding");  // gzip: RequestHead
  if (is_compressed) response.set_header("Content-Encoding", "gzip");
  const std::string_view bytes = is_compressed ? file.gzip : file.bytes;
  // Not as content: the library would compress that once more.
  response.set_content_provider(
      bytes.size(), std::string(file.type),
      [bytes](std::size_t at, std::size_t length, httplib::DataSink& sink) {
        return sink.write(bytes.data() + at, length);
      });
}

}  // namespace

std::span<const Route> studio_routes() {
  static const std::array kRoutes = {
      Route{Method::get, "/", Scope::anybody, handler(&send_studio)},
      Route{Method::get, "/new", Scope::anybody, handler(&send_studio)},
      Route{Method::get, "/compare", Scope::anybody, handler(&send_studio)},
      Route{Method::get, "/fly", Scope::anybody, handler(&send_studio)},
      Route{Method::get, "/jobs", Scope::anybody, handler(&send_studio)},
      Route{Method::get, "/jobs/{path}", Scope::anybody, handler(&send_studio)},
      Route{Method::get, "/calibrations", Scope::anybody, handler(&send_studio)},
      Route{Method::get, "/calibrations/{path}", Scope::anybody, handler(&send_studio)},
      Route{Method::get, "/studies", Scope::anybody, handler(&send_studio)},
      Route{Method::get, "/studies/{path}", Scope::anybody, handler(&send_studio)},
      Route{Method::get, "/blueprint", Scope::anybody, handler(&send_studio)},
      Route{Method::get, "/place", Scope::anybody, handler(&send_studio)},
      Route{Method::get, "/keys", Scope::anybody, handler(&send_studio)},
      Route{Method::get, "/api", Scope::anybody, handler(&send_studio)},
      Route{Method::get, kAssetPath, Scope::anybody, handler(&send_studio_asset)},
  };
  return kRoutes;
}

bool is_for_studio(const Request& request) {
  return (request.method == "GET" || request.method == "HEAD") &&
         !request.path.starts_with("/v1/") && !request.path.starts_with("/assets/") &&
         request.get_header_value("Accept").find("text/html") != std::string::npos;
}

void write_studio(const Request& request, Response& response) {
  response.set_header("Content-Security-Policy", kContentPolicy);
  response.set_header("Cross-Origin-Opener-Policy", "same-origin");
  // Its files are named relative to it: the service may lie below a path of a proxy.
  constexpr std::ptrdiff_t kMaxDepth = 7;
  const auto slashes = std::count(request.path.begin(), request.path.end(), '/');
  const auto depth = std::clamp<std::ptrdiff_t>(slashes - 1, 0, kMaxDepth);
  send_bytes(request, response, *find_file(fmt::format("index.{}.html", depth)), "no-cache");
}

void send_studio(const Request& request, Response& response) { write_studio(request, response); }

void send_studio_asset(const Request& request, Response& response) {
  const StudioFile* file = find_file(std::string(request.matches[1]));
  if (file == nullptr || file->name.ends_with(".html")) {
    throw HttpError{404, "the page has no such file; it may be of another version: reload"};
  }
  // Names hold a hash of the content, but for that of the licenses.
  const bool is_fixed = file->name == "notice.txt";
  send_bytes(request, response, *file,
             is_fixed ? "no-cache" : "public, max-age=31536000, immutable");
}

}  // namespace throng::server
