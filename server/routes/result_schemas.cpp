#include "server/routes/resources.h"

namespace throng::server {

std::vector<NamedSchema> result_schemas() {
  return {
      {"LogList",
       object({{"logs",
                list(object({{"name", "string"}, {"bytes", "integer"}, {"href", "string"}}))}})},
      {"PreviewList",
       object(
           {{"previews", list(object({{"name", "string"},
                                      {"href", "string"},
                                      {"clean", "string", "The image without annotations."}}))}})},
      {"ImageList",
       closed({{"images", list(object({{"run", "string"},
                                       {"camera", "string"},
                                       {"frame", "integer"},
                                       {"path", "string",
                                        "Path in the dataset, for /v1/jobs/{id}/files/PATH."},
                                       {"bytes", "integer"}}))},
               {"total", "integer", "Number of matching images on all pages."},
               {"runs",
                list(object(
                    {{"run", "string"},
                     {"cameras", list(object({{"camera", "string"},
                                              {"images", "integer"},
                                              {"first", "integer", "Number of the first frame."},
                                              {"last", "integer"}}))}})),
                "The runs of the whole dataset."}})}};
}

}  // namespace throng::server
