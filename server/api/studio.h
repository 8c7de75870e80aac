// Studio, the web page of the service (web/studio): its files are part of the program, compressed
// by the build. The page is public, as are its scripts; what they show is fetched from the API in
// the session of the person in front of it (server/api/session_api.h).
#pragma once

#include <span>
#include <string_view>

#include "server/api/request_context.h"
#include "server/api/routes.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// A file of the page.
struct StudioFile {
  std::string_view name;  ///< "index.html", or with a hash of its content: "main-4K2VXQ7A.js"
  std::string_view type;  ///< media type
  std::string_view etag;  ///< with its quotes
  std::string_view bytes;
  std::string_view gzip;  ///< the same, compressed
};

/// Paths of the page, apart from those of the API. Screens are paths too, so that they can be
/// linked; the scripts tell them apart.
std::span<const Route> studio_routes();

void send_studio(const RequestContext& context, const httplib::Request& request,
                 httplib::Response& response);
/// Throws HttpError 404.
void send_studio_asset(const RequestContext& context, const httplib::Request& request,
                       httplib::Response& response);

/// Whether a request for a path that does not exist comes from a person's browser, for which the
/// page says so.
bool is_for_studio(const httplib::Request& request);
/// The page, without changing the status of the answer.
void write_studio(const httplib::Request& request, httplib::Response& response);

}  // namespace throng::server
