#include "server/api/scenarios_api.h"
#include "server/api/service_api.h"
#include "server/routes/parameters.h"
#include "server/routes/resources.h"

namespace throng::server {

std::vector<Route> catalog_routes() {
  return tagged(
      "catalog",
      {on_post(
           "/v1/scenarios", Scope::submit, &upload_scenarios,
           {.summary = "Upload scenarios, or a blueprint",
            .help =
                "All mistakes are named (400). A name that is taken is answered with 409, a full "
                "disk with 507.",
            .parameters = {{"name", fields::texts_like("^[a-z0-9_]{1,40}$", ""),
                            "First part of the scenarios' ids.", nullptr,
                            Parameter::Location::query, true},
                           dry_run("Whether the scenarios are only checked.")},
            .body =
                Body{{{"application/zip", "binary"},
                      {"application/x-tar", "binary"},
                      {"application/gzip", "binary"},
                      {"application/octet-stream", "binary"},
                      {"application/json", "object"}},
                     "A bundle, recognized by its content, not by its type, with every file that "
                     "its scenarios name; or a blueprint as application/json (docs/blueprint.md), "
                     "which becomes the scenario NAME/place."},
            .answers = {ok("With dry_run: the scenarios are in order.", "Upload"),
                        created("The scenarios are stored; their ids begin with NAME/.", "Upload")},
            .problems = {409, 507}}),
       on_get("/v1/scenarios", Scope::read, &list_scenarios,
              {.summary = "List the scenarios that jobs can name",
               .parameters = {{"after", "string", "The `next` of the page before."}},
               .answers = {ok("A page of the list, by ids; a page has all of them unless they take "
                              "more than 4 MiB.",
                              "ScenarioList")}}),
       on_get("/v1/scenarios/{path}", Scope::read, &send_scenario,
              {.summary = "Get a scenario, its floor plan or its blueprint",
               .parameters =
                   {{"format", words({"json", "svg", "blueprint"}),
                     "Form of the answer: the description as json, the floor plan as svg, or "
                     "the blueprint that the scenario was made from, with the files that it "
                     "extends (404 if there is none).",
                     "json"}},
               .answers = {content("The scenario.",
                                   {{"application/json", "Scenario"}, {"image/svg+xml"}})}}),
       on_delete(
           "/v1/scenarios/{path}", Scope::submit, &remove_scenarios,
           {.summary = "Remove an upload",
            .help =
                "The answer is 403 unless the upload is one's own, and 409 while a job that waits "
                "or runs names it.",
            .parameters = {path_part("path",
                                     "Name of the upload: the first part of its scenarios' ids.")},
            .answers = {done("The upload and all its scenarios have been removed.")},
            .problems = {409}}),
       on_get("/v1/people", Scope::read, &list_people,
              {.summary = "The character library",
               .answers = {ok("The complete list.",
                              object({{"content_hash", "string"},
                                      {"licence", "string"},
                                      {"people", list(object({{"name", "any"},
                                                              {"sex", "any"},
                                                              {"age_years", "any"},
                                                              {"stature_m", "any"},
                                                              {"carries", "any"},
                                                              {"wears", "any"}}))},
                                      {"schema", "JobField"}}))},
               .problems = {404}}),
       on_get("/v1/airframes", Scope::read, &list_airframes,
              {.summary = "The quadcopters that come with throng",
               .answers = {ok(
                   "The complete list.",
                   object({{"airframes", list(object({{"name", "any"}, {"derived", "any"}}))},
                           {"schema", "JobField"}}))}}),
       on_get("/v1/policies", Scope::read, &list_policies,
              {.summary = "The policies that drones can fly by",
               .answers = {ok("The complete list.",
                              object({{"policies", list(object({{"name", "any"}}))},
                                      {"schema", "JobField"}}))}}),
       on_get("/v1/formats", Scope::read, &list_formats,
              {.summary = "The formats that a dataset can have",
               .answers = {ok(
                   "The complete list.",
                   object({{"formats",
                            list(object({{"name", "any"}, {"summary", "any"}, {"needs", "any"}}))},
                           {"schema", "JobField"}}))}}),
       on_get("/v1/schema", Scope::read, &send_schema,
              {.summary = "The JSON Schema of a job",
               .answers = {content("The schema; docs/reference/job.md lists the same fields.",
                                   {{"application/schema+json"}})}}),
       on_get("/v1/schemas", Scope::read, &list_schemas,
              {.summary = "The kinds of files that have a JSON Schema",
               .answers = {ok("The names of the kinds: job, scenario, blueprint and others.",
                              object({{"schemas", "string[]"}}))}}),
       on_get(
           "/v1/schemas/{name}", Scope::read, &send_file_schema,
           {.summary = "The JSON Schema of a kind of file, for editors",
            .parameters = {path_part("name", "Kind of file: a name that GET /v1/schemas lists.")},
            .answers = {content("The schema, complete in itself; `throng schema` prints the same.",
                                {{"application/schema+json"}})}})});
}

}  // namespace throng::server
