#include "jobs/queue/workers/worker_messages.h"

#include <nlohmann/json.hpp>

#include "base/json/json_text.h"
#include "base/json/problem_json.h"

namespace throng::jobs {

using nlohmann::json;

std::string progress_line(const TaskProgress& progress) {
  json line = {{"done", progress.done}, {"total", progress.total}};
  if (!progress.what.empty()) line["what"] = progress.what;
  return line.dump(-1, ' ', false, json::error_handler_t::replace);
}

json to_json(const WorkerError& error) {
  return {{"kind", error.kind}, {"message", error.message}, {"problems", error.problems}};
}

std::string error_line(const WorkerError& error) {
  // File names and messages of libraries may hold any bytes.
  return json{{"error", to_json(error)}}.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string sign_of_life_line() { return "{}"; }

WorkerMessage read_worker_message(const std::string& line) {
  WorkerMessage message;
  try {
    const json value = parse_json(line, "");
    if (value.contains("error")) {
      const json& error = value["error"];
      message.error = WorkerError{error.value("kind", "bug"), error.value("message", ""),
                                  error.value("problems", std::vector<Problem>{})};
    } else {
      message.progress =
          TaskProgress{value.at("done").get<double>(), value.at("total").get<double>(),
                       value.value("what", std::string())};
    }
  } catch (const InputError&) {
    return {};
  } catch (const json::exception&) {
    return {};
  }
  return message;
}

}  // namespace throng::jobs
