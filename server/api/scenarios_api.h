// Routes of scenarios, both shipped and uploaded.
#pragma once

#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// POST of a bundle (zip, tar, tar.gz) or a blueprint (JSON) with ?name=; ?dry_run only checks it.
void upload_scenarios(const RequestContext& context, const httplib::Request& request,
                      httplib::Response& response);
void list_scenarios(const RequestContext& context, const httplib::Request& request,
                    httplib::Response& response);
/// Sends a scenario by its id; its floor plan with ?format=svg, its blueprint with
/// ?format=blueprint.
void send_scenario(const RequestContext& context, const httplib::Request& request,
                   httplib::Response& response);
/// Sends the floor plan of a job's scenario with the planned paths of its drones.
void send_job_plan(const RequestContext& context, const httplib::Request& request,
                   httplib::Response& response);
/// DELETE of an upload by its name.
void remove_scenarios(const RequestContext& context, const httplib::Request& request,
                      httplib::Response& response);

}  // namespace throng::server
