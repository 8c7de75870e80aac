#include "server/api/calibration_api.h"
#include "server/routes/parameters.h"
#include "server/routes/resources.h"

namespace throng::server {

std::vector<Route> calibration_routes() {
  return tagged(
      "calibrations",
      {begins_work(
           on_post("/v1/calibrations", Scope::submit, &submit_calibration,
                   {.summary = "Queue a calibration (docs/calibration.md)",
                    .help = "A request may have 256 MiB (413).",
                    .body = Body{{{"application/json", "object"},
                                  {"multipart/form-data", object({{"request", "string"}})}}},
                    .answers = {created("The calibration is queued.", "Calibration")}})),
       on_get("/v1/calibrations", Scope::read, &list_calibrations,
              {.summary = "List calibrations",
               .help = "The list also has the JSON Schema of a request.",
               .parameters = page_parameters(),
               .answers = {ok("A page of the list, newest first.", "CalibrationList")}}),
       on_get("/v1/calibrations/{id}", Scope::read, &send_calibration,
              {.summary = "Get a calibration, with its camera once it has succeeded",
               .answers = {ok("The calibration.", "Calibration")}}),
       on_delete(
           "/v1/calibrations/{id}", Scope::submit, &remove_calibration,
           {.summary = "End a calibration and remove its files",
            .help =
                "An active calibration is ended first. The calibration of another key is answered "
                "with 404, but not to administrators.",
            .answers = {done("It has been removed.")}}),
       on_get(
           "/v1/calibrations/{id}/{name}", Scope::read, &send_calibration_result,
           {.summary = "A result: camera, points (JSON), opencv, ros (YAML) or residuals (SVG)",
            .help =
                "The points found in the images are there before the camera, and also if nothing "
                "can be estimated from them.",
            .parameters = {path_part("name", "Name of the result.")},
            .answers = {content(
                "The requested result.",
                {{"application/json", "object",
                  "The camera as `throng calibrate` writes it, or CalibrationPoints."},
                 {"application/yaml"},
                 {"image/svg+xml"}})},
            .problems = {409}}),
       on_get("/v1/calibrations/{id}/images/{path}", Scope::read, &send_calibration_image,
              {.summary = "An image of a board, as it was sent",
               .parameters = {path_part("path", "The name in the request's `images`.")},
               .answers = {content("The image.", {{"image/jpeg"}, {"image/png"}})}})});
}

}  // namespace throng::server
