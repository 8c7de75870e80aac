// Scenarios over HTTP: those that come with throng and those that users send.
#pragma once

#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// POST a bundle (zip, tar, tar.gz) or a blueprint (JSON) with ?name=; with ?dry_run it is only
/// checked.
void upload_scenarios(const RequestContext& context, const httplib::Request& request,
                      httplib::Response& response);
void list_scenarios(const RequestContext& context, const httplib::Request& request,
                    httplib::Response& response);
/// One scenario by its id; its floor plan with ?format=svg, what it was made from with
/// ?format=blueprint.
void send_scenario(const RequestContext& context, const httplib::Request& request,
                   httplib::Response& response);
/// The floor plan of a job's scenario, with the planned paths of its drones.
void send_job_plan(const RequestContext& context, const httplib::Request& request,
                   httplib::Response& response);
/// DELETE an upload by its name.
void remove_scenarios(const RequestContext& context, const httplib::Request& request,
                      httplib::Response& response);

}  // namespace throng::server
