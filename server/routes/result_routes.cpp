#include "server/api/downloads_api.h"
#include "server/api/trajectories_api.h"
#include "server/routes/resources.h"

namespace throng::server {

std::vector<Route> result_routes() {
  return tagged(
      "results",
      {on_get("/v1/jobs/{id}/logs", Scope::read, &list_logs,
              {.summary = "Logs of the workers, task by task",
               .answers = {ok("The names and sizes of the logs.", "LogList")}}),
       on_get("/v1/jobs/{id}/logs/{name}", Scope::read, &send_log,
              {.summary = "A log, or a range of its bytes",
               .parameters = {path_part("name", "Name of the log.")},
               .answers = {file("The log so far.", {{"text/plain"}})}}),
       on_get("/v1/jobs/{id}/previews", Scope::read, &list_previews,
              {.summary = "Images with annotation overlays, also while the job runs",
               .answers = {ok("The previews so far.", "PreviewList")}}),
       on_get("/v1/jobs/{id}/previews/{path}", Scope::read, &send_preview,
              {.summary = "An image with annotation overlays",
               .parameters = {{"clean", "boolean",
                               "Whether the image comes without annotation overlays.", false}},
               .answers = {file("The image.", {{"image/jpeg"}})}}),
       on_get(
           "/v1/jobs/{id}/images", Scope::read, &list_images_of_job,
           {.summary = "Images of the dataset by pages, and how many each camera took in each run",
            .parameters = {{"run", "string", "Name of the run of the images, for example run000."},
                           {"camera", "string", "Id of the drone that took the images."},
                           {"offset", at_least(0),
                            "Number of matching images before the first one of the page.", 0},
                           {"limit", fields::integers(1, kMaxImagesOfPage),
                            "Maximum number of images.", kUsualImagesOfPage}},
            .answers = {ok("The images in the order of their paths.", "ImageList")},
            .problems = {409}}),
       on_get(
           "/v1/jobs/{id}/archive", Scope::read, &send_archive,
           {.summary = "The dataset, or a part of it, as a tar or zip file",
            .help =
                "Nothing is copied for it, whatever its size, and `curl -C -` resumes it (Range, "
                "If-Range). It is there once the job has succeeded, at least in part, or has "
                "failed only to publish its dataset; before that the answer is 409. A choice that "
                "contains nothing is answered with 404.",
            .parameters =
                {{"format", words({"tar", "zip"}),
                  "Format of the archive; zip files are stored (zip64 where needed), not "
                  "compressed.",
                  "tar"},
                 {"include", "string",
                  "Names of folders and files at the dataset's top, of formats, and coco for the "
                  "annotations, separated by commas; default: everything."},
                 {"runs", fields::texts_like("^[0-9,-]+$", ""),
                  "Numbers of the runs whose files are sent, for example 0-3,7; default: all."},
                 {"split", words({"train", "val", "test"}),
                  "Split whose runs' files are sent; default: all."}},
            .answers = {file("The archive, with Content-Length and ETag.",
                             {{"application/x-tar"}, {"application/zip"}})},
            .problems = {409}}),
       on_get("/v1/jobs/{id}/manifest", Scope::read, &send_manifest,
              {.summary = "Every file of the dataset with size and SHA-256",
               .answers = {file("The file manifest.json.", {{"application/json", "object"}})},
               .problems = {409}}),
       on_get(
           "/v1/jobs/{id}/files/{path}", Scope::read, &send_file,
           {.summary = "One file of the dataset",
            .answers = {file("The file; its ETag is its SHA-256.", {{"application/octet-stream"}})},
            .problems = {409}}),
       on_get("/v1/jobs/{id}/metrics", Scope::read, &send_metrics,
              {.summary = "Figures of all runs",
               .answers = {ok("The file metrics.json (docs/metrics.md).", "object")},
               .problems = {409}}),
       with_scripts(on_get(
           "/v1/jobs/{id}/report", Scope::read, &send_report,
           {.summary = "The report of all runs as one HTML page, made when it is first asked for",
            .help = "The answer is 503 when 32 other reports wait.",
            .answers = {file("The page, complete in one file.", {{"text/html", "string"}}),
                        json_answer(
                            202, "The report is being made: ask again after `Retry-After` seconds.",
                            object({{"status", "string"}}), "Retry-After")},
            .problems = {409}})),
       on_get("/v1/jobs/{id}/runs/{n}/metrics", Scope::read, &send_run_metrics,
              {.summary = "Figures of one run",
               .help = "They are there once that run was measured, whatever the others do.",
               .answers = {ok("The figures of the run (docs/metrics.md).", "object")},
               .problems = {409}}),
       on_get("/v1/jobs/{id}/runs/{n}/metrics.csv", Scope::read, &send_run_metrics_csv,
              {.summary = "Exits of one run, frame by frame",
               .help = "It is there once that run was measured, whatever the others do.",
               .answers = {content("The table exits.csv of the run (docs/metrics.md).",
                                   {{"text/csv"}})},
               .problems = {409}}),
       on_get("/v1/jobs/{id}/runs/{n}/trace", Scope::read, &send_run_trace,
              {.summary = "The trace of one run: every person and drone at every step (HDF5)",
               .help = "It is there once that run was simulated.",
               .answers = {file("The trace (docs/trace.md), with Content-Length and ETag.",
                                {{"application/x-hdf5"}})},
               .problems = {409}}),
       on_get(
           "/v1/jobs/{id}/runs/{n}/trajectories", Scope::read, &send_trajectories,
           {.summary = "Positions of all people at some times of a run, in a compact binary form",
            .help = "They are there once that run was simulated; an answer holds at most 2 000 000 "
                    "positions.",
            .parameters = {{"from_s", fields::numbers(0, kMaxTimeS), "First time, s.", 0},
                           {"to_s", fields::numbers(0, kMaxTimeS),
                            "Maximum of the times, s; default: the run's end."},
                           {"every_s", fields::numbers(kMinEveryS, kMaxTimeS),
                            "Difference between successive times, s.", 1}},
            .answers = {content(
                "The trajectories, little-endian: a head, the times, the roles, and "
                "six bytes for each time and person (docs/api.md).",
                {{"application/octet-stream"}})},
            .problems = {409}})});
}

}  // namespace throng::server
