#include "cli/more/more_commands.h"

#include <nlohmann/json.hpp>
#include <string>

#include "calibration/request.h"
#include "jobs/queue/dataset/folder.h"

namespace throng::cli {

namespace {

void calibrate_in(const jobs::JobFolder& folder, const std::string& /*name*/,
                  const jobs::OnTaskProgress& on_progress) {
  calibrate::carry_out_in(folder.path(),
                          [&](double share, const std::string& what) {
                            on_progress({share, 1, what});
                          },
                          {});
}

/// Checks the calibration "request" with its "files", a folder: {"max_image_pixels"}.
nlohmann::json check_calibration(const nlohmann::json& request) {
  const calibrate::Request checked =
      calibrate::request_from_json(request.at("request"), request.at("files").get<std::string>());
  return {{"max_image_pixels", calibrate::max_image_pixels(checked)}};
}

}  // namespace

Extension more_commands() {
  return {.commands = {add_live, add_live_process, add_validate, add_validate_crowd, add_calibrate,
                       add_train, add_match},
          .tasks = {{jobs::to_string({jobs::Task::Kind::calibrate}), &calibrate_in}},
          .confined_work = {{"calibration", &check_calibration}}};
}

}  // namespace throng::cli
