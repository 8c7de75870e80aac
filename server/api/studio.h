// Studio, the web page of the service (web/studio). Its files are embedded in the program,
// compressed by the build. Page and scripts are public; they fetch their data from the API with the
// user's session (server/api/session_api.h).
#pragma once

#include <span>
#include <string_view>

#include "server/api/service_parts.h"
#include "server/description/routes.h"
#include "server/http/http_fwd.h"
#include "server/http/studio_file.h"

namespace throng::server {

/// Routes of the page. Its screens have paths of their own, so that they can be linked; all of them
/// get the same page, whose scripts show the screen.
std::span<const Route> studio_routes();

void send_studio(const httplib::Request& request, httplib::Response& response);
/// Sends a script or another file of the page. Throws HttpError 404.
void send_studio_asset(const httplib::Request& request, httplib::Response& response);

/// Whether a request for an unknown path comes from browser navigation and should be answered with
/// the page.
bool is_for_studio(const httplib::Request& request);
/// Sets the page as the response's body without changing its status.
void write_studio(const httplib::Request& request, httplib::Response& response);

}  // namespace throng::server
