#include "server/routes/resources.h"

namespace throng::server {

std::vector<NamedSchema> calibration_schemas() {
  return {
      {"Calibration", row(words({"queued", "running", "succeeded", "failed", "cancelled"}),
                          "object", {{"request", "object"}, {"camera?", "object"}})},
      {"CalibrationList", object({{"calibrations", "Calibration[]"},
                                  {"next", "string?"},
                                  {"schema", "object", "The JSON schema of a request."}})},
      {"CalibrationPoints",
       closed(
           {{"width", "integer"},
            {"height", "integer"},
            {"views",
             list(closed(
                 {{"image", "string"},
                  {"points",
                   list(closed(
                       {{"pixel", "number[2]",
                         "Position in the image, px; the middle of the top-left pixel is (0, 0)."},
                        {"residual_px", "number?[2]?",
                         "Difference between the projected and the observed position, px; null "
                         "before anything is estimated."},
                        {"used", "boolean",
                         "Whether the point is used; false: it is an outlier."}}))}}))}})}};
}

}  // namespace throng::server
