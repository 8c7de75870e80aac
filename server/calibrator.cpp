#include "server/calibrator.h"

#include <fmt/core.h>
#include <poll.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files.h"
#include "base/json_text.h"
#include "base/problem_json.h"
#include "jobs/queue/child_process.h"

namespace throng::server {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr int kPollMs = 50;

std::vector<Problem> read_problems(const fs::path& file) {
  return parse_own_json(read_file(file), file.string()).get<std::vector<Problem>>();
}

/// The last line of the child's output when it failed.
std::string last_line(const fs::path& log) {
  const std::string text = fs::exists(log) ? read_file(log) : "";
  const std::size_t end = text.find_last_not_of('\n');
  if (end == std::string::npos) return "no message";
  const std::size_t before = text.find_last_of('\n', end);
  const std::size_t first = before == std::string::npos ? 0 : before + 1;
  return text.substr(first, end - first + 1);
}

}  // namespace

Calibrator calibrator_in_child(std::vector<std::string> command) {
  return [command = std::move(command)](const fs::path& folder, const auto& on_progress,
                                        const std::stop_token& stop) {
    std::vector<std::string> words = command;
    words.push_back(folder.string());
    jobs::ChildProcess child(words, {}, folder / "log.txt");
    const auto pass_on = [&] {
      for (const std::string& line : child.read_lines()) {
        const std::size_t space = line.find(' ');
        if (space == std::string::npos) continue;
        on_progress(std::strtod(line.c_str(), nullptr), line.substr(space + 1));
      }
    };
    while (!child.has_ended()) {
      if (stop.stop_requested()) throw Cancelled();  // the child ends with its object
      pollfd wait{child.output(), POLLIN, 0};
      ::poll(&wait, 1, kPollMs);
      pass_on();
    }
    pass_on();
    const jobs::ExitStatus status = child.wait();
    if (status.signal == 0 && status.code == 0) return;
    if (status.code == kCalibrationInputExit && fs::exists(folder / kCalibrationProblems)) {
      throw InputError(read_problems(folder / kCalibrationProblems));
    }
    throw EnvironmentError(
        status.signal != 0
            ? fmt::format("the calibration was ended by signal {}", status.signal)
            : fmt::format("the calibration failed: {}", last_line(folder / "log.txt")));
  };
}

}  // namespace throng::server
