#include "cli/calibration_child.h"

#include <fmt/core.h>
#include <sys/prctl.h>

#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "base/problem_json.h"
#include "calibrate/request.h"
#include "server/calibrator.h"

namespace throng::cli {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

void write_problems(const fs::path& file, const std::vector<Problem>& problems) {
  write_file_atomically(file, json(problems).dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace

int run_calibration_child(const fs::path& folder) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  try {
    calibrate::carry_out_in(folder,
                            [](double share, const std::string& what) {
                              fmt::print("{:.3f} {}\n", share, what);
                              std::fflush(stdout);
                            },
                            {});
    return 0;
  } catch (const InputError& error) {
    write_problems(folder / server::kCalibrationProblems, error.problems());
    return server::kCalibrationInputExit;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return server::kCalibrationEnvironmentExit;
  }
}

}  // namespace throng::cli
