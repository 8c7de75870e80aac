// throng keys: who may use the service over HTTP.
#include "server/access/keys.h"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/error.h"
#include "cli/shell/commands.h"
#include "server/access/expiry.h"

namespace throng::cli {

namespace {

constexpr int kGibShift = 30;

std::string format_day(std::int64_t unix_ms) {
  constexpr std::int64_t kMsPerS = 1000;
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(static_cast<std::time_t>(unix_ms / kMsPerS)));
}

void print_keys(const std::vector<server::KeyRow>& keys) {
  fmt::print("{:<10}{:<8}{:>10}{:>10}{:>10}  {:<12}{:<12}{:<12}{}\n", "id", "scope", "max jobs",
             "max GiB", "priority", "made", "expires", "revoked", "name");
  for (const server::KeyRow& key : keys) {
    const int max_priority =
        key.scope >= server::Scope::admin ? server::kMaxPriority : key.max_priority;
    const auto day = [](std::int64_t unix_ms) {
      return unix_ms == 0 ? std::string() : format_day(unix_ms);
    };
    fmt::print(
        "{:<10}{:<8}{:>10}{:>10}{:>10}  {:<12}{:<12}{:<12}{}\n", key.id,
        server::to_string(key.scope), key.max_active == 0 ? "any" : std::to_string(key.max_active),
        key.max_bytes == 0 ? "any" : std::to_string(key.max_bytes >> kGibShift), max_priority,
        format_day(key.created_ms), day(key.expires_ms), day(key.revoked_ms), key.name);
  }
}

}  // namespace

void add_keys(CLI::App& app) {
  auto* command =
      app.add_subcommand("keys", "Manage API keys; as soon as one exists, every request needs one");
  command->require_subcommand(1);
  const auto data = std::make_shared<std::string>("throng-data");
  const auto add_data = [data](CLI::App* to) {
    to->add_option("--data", *data, "Data folder of the service, or its --database")
        ->capture_default_str();
  };

  auto* create =
      command->add_subcommand("create", "Create a key and print it; it cannot be shown again");
  const auto name = std::make_shared<std::string>();
  const auto scope = std::make_shared<std::string>("submit");
  const auto max_jobs = std::make_shared<int>(0);
  create->add_option("name", *name, "Name of the owner, shown in lists")->required();
  create
      ->add_option("--scope", *scope,
                   "read: jobs with the label \"shared\"; submit: also queue jobs, see and change "
                   "own ones; admin: all jobs")
      ->check(CLI::IsMember({"read", "submit", "admin"}))
      ->capture_default_str();
  create->add_option("--max-jobs", *max_jobs, "Max queued and running jobs (0: no limit)")
      ->check(CLI::NonNegativeNumber);
  const auto max_gib = std::make_shared<int>(0);
  create->add_option("--max-gib", *max_gib, "Max disk usage of their jobs in GiB (0: no limit)")
      ->check(CLI::NonNegativeNumber);
  const auto max_priority = std::make_shared<int>(0);
  create
      ->add_option("--max-priority", *max_priority,
                   "Highest priority of their jobs; administrators may give any")
      ->check(CLI::Range(-server::kMaxPriority, server::kMaxPriority))
      ->capture_default_str();
  const auto expires = std::make_shared<std::string>();
  create->add_option("--expires", *expires,
                     "When it expires: a date or time in UTC (2027-01-31, 2027-01-31T12:00:00Z), "
                     "or how long from now (30d, 12h, 2w); its jobs then go on");
  add_data(create);
  create->callback([=] {
    const auto expires_ms =
        expires->empty() ? std::optional<std::int64_t>(0) : server::parse_expiry(*expires);
    if (!expires_ms) {
      throw InputError(Problem{"throng keys create", "--expires", *expires, server::kExpiryRule});
    }
    if (!server::is_key_name(*name)) {
      throw InputError(Problem{
          "throng keys create", "name",
          nlohmann::json(*name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace),
          server::kKeyNameRule});
    }
    fmt::print("{}\n", server::Keys(*data).create(*name, *server::scope_named(*scope), *max_jobs,
                                                  static_cast<std::int64_t>(*max_gib) << kGibShift,
                                                  *max_priority, *expires_ms));
  });

  auto* list = command->add_subcommand("list", "List the keys");
  add_data(list);
  list->callback([=] { print_keys(server::Keys(*data).list()); });

  auto* revoke = command->add_subcommand("revoke", "Revoke a key immediately");
  const auto id = std::make_shared<std::string>();
  revoke->add_option("id", *id, "Id of the key (throng keys list)")->required();
  add_data(revoke);
  revoke->callback([=] {
    if (!server::Keys(*data).revoke(*id)) {
      throw InputError(Problem{"throng keys revoke", "id", *id, "the id of a valid key"});
    }
  });
}

}  // namespace throng::cli
