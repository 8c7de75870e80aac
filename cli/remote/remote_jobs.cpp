// throng submit, jobs, watch, cancel, retry, remove, logs, fetch: the HTTP API from the command
// line.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <memory>
#include <thread>

#include "base/error.h"
#include "base/text/suggest.h"
#include "base/text/url.h"
#include "cli/remote/api_client.h"
#include "cli/remote/bundle.h"
#include "cli/remote/remote_end.h"
#include "cli/shell/commands.h"
#include "cli/shell/document_kind.h"
#include "cli/shell/input_file.h"
#include "cli/shell/interrupt.h"
#include "cli/shell/job_summary.h"
#include "cli/shell/progress_bar.h"

namespace throng::cli {

using nlohmann::json;
using namespace std::chrono_literals;
namespace fs = std::filesystem;

namespace {

std::string job_path(const std::string& id) { return "/v1/jobs/" + percent_encoded(id); }

/// Does something with a job; one that the server does not have is reported with the nearest id.
template <typename Work>
auto with_job(ApiClient& api, const std::string& id, const Work& work) {
  try {
    return work();
  } catch (const NotFound& error) {
    std::vector<std::string> ids;
    const json jobs = api.get("/v1/jobs?limit=500");
    for (const json& job : jobs.at("jobs")) ids.push_back(job.at("id"));
    if (std::find(ids.begin(), ids.end(), id) != ids.end()) throw;  // it lacks something
    const auto nearest = closest(id, std::vector<std::string_view>(ids.begin(), ids.end()));
    throw InputError(
        {"", "", fmt::format("unknown job \"{}\" on {}", id, api.url()),
         nearest ? fmt::format("\"{}\"", *nearest) : "an id that `throng jobs` lists"});
  }
}

void show(ProgressBar& bar, const json& job) {
  const json& progress = job["progress"];
  const std::int64_t done = progress.value("frames_done", std::int64_t{0});
  const std::int64_t total = progress.value("frames_total", std::int64_t{0});
  const double fraction = job["state"] == "succeeded" ? 1.0
                          : total > 0                 ? static_cast<double>(done) / total
                                                      : 0.0;
  const std::string stage = progress.value("stage", job["state"].get<std::string>());
  std::string text = total == 0 ? stage : fmt::format("{}, {} of {} frames", stage, done, total);
  if (const json left = progress.value("remaining_s", json()); left.is_number()) {
    text += fmt::format(", {:.0f} s left", left.get<double>());
  }
  if (job["waiting_for"].is_string()) {
    text += fmt::format(", waits: {}", job["waiting_for"].get<std::string>());
  }
  bar.show(fraction, text);
}

/// Follows a job until it has ended.
json watched(ApiClient& api, const std::string& id) {
  std::int64_t seen = 0;
  return followed(api, job_path(id), id, {&show, [&] {
                                            const json news = api.get(fmt::format(
                                                "{}/events?after={}&wait_s=1", job_path(id), seen));
                                            seen = news["next"];
                                          }});
}

struct FetchArguments {
  std::string id;
  std::string file;
  bool zip = false;
  std::string include = {};
  std::string runs = {};
  std::string split = {};
  int trace = -1;  ///< number of the run whose trace is fetched instead of the dataset; -1: none
  bool force = false;
  const char* option = "--output";  ///< that names the file
};

std::string fetched_path(const FetchArguments& arguments) {
  if (arguments.trace >= 0) {
    return fmt::format("{}/runs/{}/trace", job_path(arguments.id), arguments.trace);
  }
  std::string path = job_path(arguments.id) + "/archive";
  char before = '?';
  const auto add = [&](const char* name, const std::string& value) {
    if (value.empty()) return;
    path += fmt::format("{}{}={}", before, name, percent_encoded(value));
    before = '&';
  };
  add("format", arguments.zip ? "zip" : "");
  add("include", arguments.include);
  add("runs", arguments.runs);
  add("split", arguments.split);
  return path;
}

/// The file to write; its folder is there, and it is new.
fs::path checked_output(const FetchArguments& arguments) {
  const std::string suffix = arguments.trace >= 0 ? fmt::format("_run{:03}.h5", arguments.trace)
                             : arguments.zip      ? ".zip"
                                                  : ".tar";
  fs::path file = arguments.file;
  if (file.empty() || fs::is_directory(file)) file /= arguments.id + suffix;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!fs::is_directory(folder)) {
    throw InputError(
        {arguments.option, "", file.string() + ", whose folder does not exist", "a file to write"});
  }
  const fs::path part = file.string() + ".part";
  const bool is_ours = fs::exists(part.string() + ".etag");
  for (const fs::path& other : {file, part}) {
    if (arguments.force || !fs::exists(other) || (other == part && is_ours)) continue;
    throw InputError({arguments.option, "", other.string() + ", which is there already",
                      "a new file; --force writes over it"});
  }
  return file;
}

void fetch(ApiClient& api, const FetchArguments& arguments) {
  constexpr int kMaxAttempts = 20;
  const fs::path file = checked_output(arguments);
  const Interrupt interrupt;
  ProgressBar bar(file.filename().string());
  constexpr double kMegabyte = 1e6;
  const auto on_bytes = [&](std::int64_t done, std::int64_t total) {
    bar.show(static_cast<double>(done) / static_cast<double>(std::max<std::int64_t>(total, 1)),
             fmt::format("{:.1f} of {:.1f} MB", static_cast<double>(done) / kMegabyte,
                         static_cast<double>(total) / kMegabyte));
    return !interrupt.token().stop_requested();
  };
  for (int attempt = 1;; ++attempt) {
    try {
      if (!api.download(fetched_path(arguments), file, on_bytes)) throw Cancelled();
      break;
    } catch (const EnvironmentError&) {
      if (attempt == kMaxAttempts) throw;
      std::this_thread::sleep_for(1s);  // and on from where it broke off
    }
  }
  fmt::print("{}\n", file.string());
}

struct SubmitArguments {
  std::string job_file;
  int priority = 0;
  std::vector<std::string> labels;
  std::string key;
  bool dry_run = false;
  bool watch = false;
  std::string fetch_to;
  std::string scenario;  ///< a bundle of the job's own; "" for none
  bool force = false;
};

void submit(const SubmitArguments& arguments) {
  ApiClient api;
  const std::string text = read_job_document(arguments.job_file);
  std::string query = fmt::format("?priority={}", arguments.priority);
  for (const std::string& label : arguments.labels) query += "&label=" + percent_encoded(label);
  const auto post = [&](const std::string& path,
                        const std::pair<std::string, std::string>& header = {}) {
    if (arguments.scenario.empty()) return api.post(path, text, header);
    return api.post_form(
        path,
        {{"job", "", "application/json", text},
         {"scenario", "bundle", "application/octet-stream", read_bundle(arguments.scenario).bytes}},
        header);
  };
  // Before the job is sent: at its end nobody may be there to choose another file.
  FetchArguments fetched{"", arguments.fetch_to};
  fetched.force = arguments.force;
  fetched.option = "--fetch";
  if (!arguments.fetch_to.empty()) checked_output(fetched);
  if (arguments.dry_run) {
    return print_job_summary(post("/v1/jobs?dry_run"), arguments.job_file, 1);
  }
  const std::pair<std::string, std::string> header =
      arguments.key.empty() ? std::pair<std::string, std::string>()
                            : std::pair<std::string, std::string>("Idempotency-Key", arguments.key);
  const std::string id = post("/v1/jobs" + query, header)["id"];
  fmt::print("{}\n", id);
  std::fflush(stdout);
  if (!arguments.watch && arguments.fetch_to.empty()) return;
  require_success(watched(api, id));
  fetched.id = id;
  if (!arguments.fetch_to.empty()) fetch(api, fetched);
}

void print_jobs(const json& list) {
  fmt::print("{:<18}{:<11}{:>5}  {:<26}{}\n", "id", "state", "done", "submitted", "name");
  for (const json& job : list["jobs"]) {
    const std::int64_t total = job["progress"].value("frames_total", std::int64_t{0});
    const std::int64_t done = job["progress"].value("frames_done", std::int64_t{0});
    constexpr int kPercent = 100;
    fmt::print("{:<18}{:<11}{:>4}%  {:<26}{}\n", job["id"].get<std::string>(),
               job["state"].get<std::string>(), total > 0 ? kPercent * done / total : 0,
               job["created_at"].get<std::string>(), job["name"].get<std::string>());
  }
}

struct ListArguments {
  std::vector<std::string> states;
  std::string label;
  std::string name;
  int limit = 50;
};

void list(const ListArguments& arguments) {
  std::string query = fmt::format("?limit={}", arguments.limit);
  for (const std::string& state : arguments.states) query += "&state=" + percent_encoded(state);
  if (!arguments.label.empty()) query += "&label=" + percent_encoded(arguments.label);
  if (!arguments.name.empty()) query += "&name=" + percent_encoded(arguments.name);
  print_jobs(ApiClient().get("/v1/jobs" + query));
}

void logs(const std::string& id, const std::string& name) {
  ApiClient api;
  with_job(api, id, [&] {
    if (!name.empty()) {
      std::cout << api.get_text(job_path(id) + "/logs/" + percent_encoded(name));
      return;
    }
    const json all = api.get(job_path(id) + "/logs");
    for (const json& log : all["logs"]) {
      fmt::print("{:>10}  {}\n", log["bytes"].dump(), log["name"].get<std::string>());
    }
  });
}

/// A subcommand whose one argument is a job's id.
CLI::App* add_for_id(CLI::App& app, const char* name, const char* what,
                     const std::shared_ptr<std::string>& id) {
  CLI::App* command = app.add_subcommand(name, what);
  command->add_option("id", *id, "The job's id (throng jobs)")->required();
  return command;
}

void add_submit(CLI::App& app) {
  auto* command = app.add_subcommand("submit", "Send a job to a server ($THRONG_URL, $THRONG_KEY)");
  const auto arguments = std::make_shared<SubmitArguments>();
  command->add_option("job", arguments->job_file, "Job file (JSON; see docs/job.md)")->required();
  command->add_option("--priority", arguments->priority, "Jobs with higher priority start first")
      ->check(CLI::Range(-100, 100))
      ->capture_default_str();
  command->add_option("--label", arguments->labels, "Label; may be repeated");
  command->add_option("--key", arguments->key,
                      "Idempotency-Key: the same key again is the same submission");
  command->add_option("--scenario", arguments->scenario,
                      "Folder, zip or tar file of scenarios to send along; the job names one as "
                      "\"bundle/NAME\"");
  command->add_flag("--dry-run", arguments->dry_run, "Only check the job");
  command->add_flag("--watch", arguments->watch, "Follow the job to its end");
  command->add_option("--fetch", arguments->fetch_to,
                      "Download the job's archive to this file at the end");
  command->add_flag("--force", arguments->force, "Write over a file that is there already");
  command->callback([arguments] { submit(*arguments); });
}

void add_job_list(CLI::App& app) {
  auto* command = app.add_subcommand("jobs", "List a server's jobs, newest first");
  const auto arguments = std::make_shared<ListArguments>();
  command->add_option("--state", arguments->states, "Only these")
      ->check(CLI::IsMember({"queued", "running", "succeeded", "partial", "failed", "cancelled"}));
  command->add_option("--label", arguments->label, "Only jobs with this label");
  command->add_option("--name", arguments->name, "Only jobs whose name contains this");
  command->add_option("--limit", arguments->limit, "Max number of jobs")
      ->check(CLI::Range(1, 500))
      ->capture_default_str();
  command->callback([arguments] { list(*arguments); });
}

void add_fetch(CLI::App& app) {
  auto* command = app.add_subcommand("fetch", "Download a job's dataset; run again to resume");
  const auto arguments = std::make_shared<FetchArguments>();
  command->add_option("id", arguments->id, "The job's id (throng jobs)")->required();
  command->add_option("-o,--output", arguments->file,
                      "File or folder to write; default: named by the id");
  command->add_flag("--force", arguments->force, "Write over a file that is there already");
  command->add_flag("--zip", arguments->zip, "As a zip file instead of a tar file");
  command->add_option("--include", arguments->include,
                      "Only these top-level folders and files, formats, coco");
  command->add_option("--runs", arguments->runs, "Only files of these runs: 0-3,7");
  command->add_option("--split", arguments->split, "Only files of this split's runs");
  command
      ->add_option("--trace", arguments->trace,
                   "The trace of the run of this number instead of the dataset")
      ->check(CLI::NonNegativeNumber)
      ->excludes("--zip", "--include", "--runs", "--split");
  command->callback([arguments] {
    ApiClient api;
    with_job(api, arguments->id, [&] { fetch(api, *arguments); });
  });
}

}  // namespace

void add_remote_jobs(CLI::App& app) {
  add_submit(app);
  add_job_list(app);
  const auto id = std::make_shared<std::string>();
  add_for_id(app, "watch", "Follow a job to its end", id)->callback([id] {
    ApiClient api;
    require_success(with_job(api, *id, [&] { return watched(api, *id); }));
  });
  add_for_id(app, "cancel", "Cancel a job; finished work is kept for a retry", id)->callback([id] {
    ApiClient api;
    with_job(api, *id, [&] { api.cancel(job_path(*id)); });
  });
  add_for_id(app, "retry", "Queue a failed, partly failed or cancelled job again", id)
      ->callback([id] {
        ApiClient api;
        with_job(api, *id, [&] { api.post(job_path(*id) + "/retry"); });
      });
  add_for_id(app, "remove", "Cancel a job and delete its files", id)->callback([id] {
    ApiClient api;
    with_job(api, *id, [&] { api.remove(job_path(*id)); });
  });
  auto* show_logs = add_for_id(app, "logs", "Print the logs of a job's workers", id);
  const auto name = std::make_shared<std::string>();
  show_logs->add_option("name", *name, "Name of a log; default: list the names");
  show_logs->callback([id, name] { logs(*id, *name); });
  add_fetch(app);
  app.add_subcommand("drain",
                     "End the service at $THRONG_URL once its running tasks have finished; jobs go "
                     "on at its next start (administrators)")
      ->callback([] {
        ApiClient api;
        api.post("/v1/service/drain");
        fmt::print("{} ends when no task runs\n", api.url());
      });
}

}  // namespace throng::cli
