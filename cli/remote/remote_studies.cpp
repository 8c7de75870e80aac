// throng studies: studies of a server from the command line ($THRONG_URL, $THRONG_KEY).
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "base/files/files.h"
#include "base/text/suggest.h"
#include "base/text/url.h"
#include "base/text/words.h"
#include "cli/remote/api_client.h"
#include "cli/remote/bundle.h"
#include "cli/remote/remote_end.h"
#include "cli/shell/commands.h"
#include "cli/shell/document_kind.h"
#include "cli/shell/input_file.h"

namespace throng::cli {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kStudiesPath = "/v1/studies";

std::string study_path(const std::string& id) {
  return fmt::format("{}/{}", kStudiesPath, percent_encoded(id));
}

/// Does something with a study; one that the server does not have is reported with the nearest id.
template <typename Work>
auto with_study(ApiClient& api, const std::string& id, const Work& work) {
  try {
    return work();
  } catch (const NotFound&) {
    std::vector<std::string> ids;
    const json list = api.get(fmt::format("{}?limit=500", kStudiesPath));
    for (const json& study : list.at("studies")) ids.push_back(study.at("id"));
    const auto nearest = closest(id, std::vector<std::string_view>(ids.begin(), ids.end()));
    throw InputError(
        {"", "", fmt::format("unknown study \"{}\" on {}", id, api.url()),
         nearest ? fmt::format("\"{}\"", *nearest) : "an id that `throng studies list` shows"});
  }
}

double done_share(const json& study) {
  const auto total = study["progress"].value("runs_total", std::int64_t{0});
  return total == 0 ? 0.0
                    : static_cast<double>(study["progress"].value("runs_done", std::int64_t{0})) /
                          static_cast<double>(total);
}

void show_study(ProgressBar& bar, const json& study) {
  const json& progress = study["progress"];
  const std::int64_t total = progress.value("runs_total", std::int64_t{0});
  std::string text = progress.value("stage", study["state"].get<std::string>());
  if (total > 0) {
    text += fmt::format(", {} of {} runs", progress.value("runs_done", std::int64_t{0}), total);
  }
  if (const json left = progress.value("remaining_s", json()); left.is_number() && left > 0) {
    text += fmt::format(", {:.0f} s left", left.get<double>());
  }
  if (study["waiting_for"].is_string()) {
    text += fmt::format(", waits: {}", study["waiting_for"].get<std::string>());
  }
  bar.show(done_share(study), text);
}

void watch_study(ApiClient& api, const std::string& id) {
  static constexpr auto kPollInterval = std::chrono::seconds(1);
  const json ended = with_study(api, id, [&] {
    return followed(api, study_path(id), id,
                    {&show_study, [] { std::this_thread::sleep_for(kPollInterval); }});
  });
  require_success(ended);
}

void fetch_study(ApiClient& api, const std::string& id, const fs::path& folder) {
  with_study(api, id, [&] {
    const std::string path = study_path(id);
    for (const char* name : {"summary.md", "summary.csv", "values.json", "summary.json"}) {
      write_file_atomically(folder / name, api.get_text(fmt::format("{}/files/{}", path, name)));
    }
    write_file_atomically(folder / "report.html", api.get_text(path + "/report"));
  });
  fmt::print("{}\n", (folder / "summary.md").string());
}

struct StudySubmission {
  std::string file;
  bool dry_run = false;
  bool watch = false;
  std::string fetch_to;
};

void submit_study(const StudySubmission& arguments) {
  ApiClient api;
  const std::string text = read_input_file(arguments.file, "a study file");
  require_kind(DocumentKind::study, text, arguments.file);
  if (arguments.dry_run) {
    const json plan = api.post(fmt::format("{}?dry_run", kStudiesPath), text);
    const auto size = [&](const char* list) {
      return static_cast<std::int64_t>(plan[list].size());
    };
    fmt::print("{}, {}, {} of each: {}\n", counted(size("cases"), "case"),
               counted(size("policies"), "policy", "policies"),
               counted(plan["runs"].get<std::int64_t>(), "run"),
               counted(plan["simulations"].get<std::int64_t>(), "simulation"));
    return;
  }
  const std::string id = api.post(kStudiesPath, text)["id"];
  fmt::print("{}\n", id);
  std::fflush(stdout);
  if (!arguments.watch && arguments.fetch_to.empty()) return;
  watch_study(api, id);
  if (!arguments.fetch_to.empty()) fetch_study(api, id, arguments.fetch_to);
}

void list_studies() {
  fmt::print("{:<18}{:<11}{:>5}  {:<26}{}\n", "id", "state", "done", "submitted", "name");
  const json list = ApiClient().get(kStudiesPath);
  for (const json& study : list["studies"]) {
    constexpr double kPercent = 100;
    fmt::print("{:<18}{:<11}{:>4.0f}%  {:<26}{}\n", study["id"].get<std::string>(),
               study["state"].get<std::string>(), kPercent * done_share(study),
               study["created_at"].get<std::string>(), study["name"].get<std::string>());
  }
}

/// A subcommand that does something with the study of an id.
CLI::App* add_study_command(CLI::App& studies, const char* name, const char* what,
                            const std::function<void(ApiClient&, const std::string&)>& work) {
  CLI::App* command = studies.add_subcommand(name, what);
  const auto id = std::make_shared<std::string>();
  command->add_option("id", *id, "The study's id (throng studies list)")->required();
  command->callback([id, work] {
    ApiClient api;
    work(api, *id);
  });
  return command;
}

void add_study_submission(CLI::App& studies) {
  auto* command = studies.add_subcommand("submit", "Send a study to a server");
  const auto arguments = std::make_shared<StudySubmission>();
  command->add_option("study", arguments->file, "Study file (JSON; see docs/study.md)")->required();
  command->add_flag("--dry-run", arguments->dry_run, "Only check the study");
  command->add_flag("--watch", arguments->watch, "Follow the study to its end");
  command->add_option("--fetch", arguments->fetch_to,
                      "Download summary and report to this folder at the end");
  command->callback([arguments] { submit_study(*arguments); });
}

}  // namespace

void add_remote_studies(CLI::App& app) {
  auto* studies = app.add_subcommand("studies", "Studies of a server ($THRONG_URL, $THRONG_KEY)");
  studies->require_subcommand(1);
  add_study_submission(*studies);
  studies->add_subcommand("list", "List a server's studies, newest first")->callback([] {
    list_studies();
  });
  add_study_command(*studies, "watch", "Follow a study to its end", &watch_study);
  add_study_command(*studies, "cancel", "Cancel a study; finished runs are kept for a retry",
                    [](ApiClient& api, const std::string& id) {
                      with_study(api, id, [&] { api.cancel(study_path(id)); });
                    });
  add_study_command(*studies, "retry", "Queue a failed or cancelled study again",
                    [](ApiClient& api, const std::string& id) {
                      with_study(api, id, [&] { api.post(study_path(id) + "/retry"); });
                    });
  add_study_command(*studies, "remove", "Cancel a study and delete its files",
                    [](ApiClient& api, const std::string& id) {
                      with_study(api, id, [&] { api.remove(study_path(id)); });
                    });
  const auto folder = std::make_shared<std::string>();
  add_study_command(*studies, "fetch", "Download a study's summary and report",
                    [folder](ApiClient& api, const std::string& id) {
                      fetch_study(api, id, folder->empty() ? id : *folder);
                    })
      ->add_option("-o,--output", *folder, "Folder to write; default: named by the id");
}

}  // namespace throng::cli
