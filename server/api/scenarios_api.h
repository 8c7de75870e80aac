// Routes of scenarios, both shipped and uploaded.
#pragma once

#include "server/api/service_parts.h"
#include "server/http/http_fwd.h"

namespace throng::server {

/// POST of a bundle (zip, tar, tar.gz) or a blueprint (JSON) with ?name=; ?dry_run only checks it.
void upload_scenarios(Uploads& uploads, const ServiceFolders& folders, const Caller& caller,
                      const httplib::Request& request, httplib::Response& response);
void list_scenarios(Uploads& uploads, const ConfinedChecks& confined, const ServiceFolders& folders,
                    AnswerBudget& answers, const httplib::Request& request,
                    httplib::Response& response);
/// Sends a scenario by its id; its floor plan with ?format=svg, its blueprint with
/// ?format=blueprint.
void send_scenario(Uploads& uploads, const ConfinedChecks& confined, const ServiceFolders& folders,
                   const httplib::Request& request, httplib::Response& response);
/// Sends the floor plan of a job's scenario with the planned paths of its drones.
void send_job_plan(JobQueue& queue, const ConfinedChecks& confined, const ServiceFolders& folders,
                   const Caller& caller, const httplib::Request& request,
                   httplib::Response& response);
/// DELETE of an upload by its name.
void remove_scenarios(Uploads& uploads, const Caller& caller, const httplib::Request& request,
                      httplib::Response& response);

}  // namespace throng::server
