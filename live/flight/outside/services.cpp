#include "live/flight/outside/services.h"

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/error.h"
#include "base/json/field_table.h"

namespace throng::live {

using fields::at;
using fields::FieldTable;
using nlohmann::json;

namespace {

constexpr std::int64_t kMaxSteps = 100'000;
constexpr std::int64_t kMaxSeed = 9'007'199'254'740'991;  // that JavaScript has exactly

/// Everything that a request may say.
struct Request {
  std::int64_t steps = 1;
  std::optional<std::int64_t> seed;
};

FieldTable<Request> no_fields() { return {}; }

FieldTable<Request> step_fields() {
  FieldTable<Request> table;
  table.add("steps", "Steps", "", fields::integers(1, kMaxSteps), at(&Request::steps),
            "Steps to simulate.");
  return table;
}

FieldTable<Request> reset_fields() {
  FieldTable<Request> table;
  table.add("seed", "Seed", "", fields::integers(0, kMaxSeed), at(&Request::seed),
            "Seed of the job; without it, the same.");
  return table;
}

/// Answers that what was asked for is done.
Control::Answer answer_done(const foxglove::ServiceAnswer& answer) {
  return [answer](const std::string& problem, double time_s) {
    answer(problem, {{"success", true}, {"message", ""}, {"time_s", time_s}});
  };
}

void pause(const Request& /*request*/, Control& control, const Control::Answer& answer) {
  Commands commands;
  commands.paused = true;
  control.command(commands);
  answer("", control.time_s());
}

void resume(const Request& /*request*/, Control& control, const Control::Answer& answer) {
  Commands commands;
  commands.paused = false;
  control.command(commands);
  answer("", control.time_s());
}

void step(const Request& request, Control& control, const Control::Answer& answer) {
  control.step(request.steps, answer);
}

void reset(const Request& request, Control& control, const Control::Answer& answer) {
  std::optional<std::uint64_t> seed;
  if (request.seed) seed = static_cast<std::uint64_t>(*request.seed);
  control.reset(seed, answer);
}

void stop(const Request& /*request*/, Control& control, const Control::Answer& answer) {
  answer("", control.time_s());
  control.end();
}

struct Row {
  const char* name;
  const char* type;
  FieldTable<Request> (*fields)();
  void (*call)(const Request&, Control&, const Control::Answer&);
};

constexpr std::array kServices{Row{"/throng/pause", "std_srvs/srv/Trigger", no_fields, pause},
                               Row{"/throng/resume", "std_srvs/srv/Trigger", no_fields, resume},
                               Row{"/throng/step", "throng/srv/Step", step_fields, step},
                               Row{"/throng/reset", "throng/srv/Reset", reset_fields, reset},
                               Row{"/throng/stop", "std_srvs/srv/Trigger", no_fields, stop}};

}  // namespace

std::vector<foxglove::Service> flight_services() {
  const json response = {{"type", "object"},
                         {"properties",
                          {{"success", {{"type", "boolean"}}},
                           {"message", {{"type", "string"}}},
                           {"time_s", {{"type", "number"}}}}}};
  std::vector<foxglove::Service> services;
  for (const Row& row : kServices) {
    nlohmann::ordered_json request = {{"type", "object"}};
    request.update(row.fields().schema());
    services.push_back({row.name, row.type, request.dump(), response.dump()});
  }
  return services;
}

void call_service(std::size_t service, const json& given, Control& control,
                  const foxglove::ServiceAnswer& answer) {
  const Row& row = kServices.at(service);
  Request request;
  std::vector<Problem> problems;
  const std::string source = row.name;
  row.fields().read_checked(given, request, {"", source, problems});
  if (!problems.empty()) throw InputError(std::move(problems));
  row.call(request, control, answer_done(answer));
}

}  // namespace throng::live
