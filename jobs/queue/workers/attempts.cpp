#include "jobs/queue/workers/attempts.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <random>
#include <system_error>
#include <thread>

#include "base/error.h"
#include "base/files/files.h"
#include "base/json/json_text.h"
#include "base/resource_exhaustion.h"

namespace throng::jobs {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kArrayName = "array.json";
constexpr const char* kNumberName = "slurm_job";

std::string random_name() {
  std::random_device random;
  const std::uint64_t high = random();
  return fmt::format("{:08x}{:08x}", high, random());
}

/// A worker that has lost its right may still write there: what it makes is removed again.
void remove_for_good(const fs::path& folder) {
  constexpr int kTries = 50;
  constexpr std::chrono::milliseconds kPause(20);
  std::error_code error;
  for (int i = 0; i < kTries; ++i) {
    fs::remove_all(folder, error);
    if (!error && !fs::exists(folder)) return;
    std::this_thread::sleep_for(kPause);
  }
  throw EnvironmentError(fmt::format("cannot remove {}: {}", folder.string(),
                                     error ? error.message() : "files appear in it"));
}

}  // namespace

fs::path attempts_folder(const JobFolder& folder) { return folder.path() / "attempts"; }

fs::path array_folder(const JobFolder& folder, const std::string& array) {
  return attempts_folder(folder) / array;
}

fs::path attempt_folder(const JobFolder& folder, const std::string& array, std::size_t index) {
  return array_folder(folder, array) / std::to_string(index);
}

void create_attempts(const JobFolder& folder, AttemptArray& array) {
  array.name = random_name();
  json tasks = json::array();
  for (const Attempt& attempt : array.attempts) {
    tasks.push_back({{"task", attempt.task}, {"attempt", attempt.number}});
  }
  make_folders(array_folder(folder, array.name) / "out");
  // Synced all together, with the array's file.
  for (std::size_t i = 0; i < array.attempts.size(); ++i) {
    const fs::path own = attempt_folder(folder, array.name, i);
    std::error_code error;
    fs::create_directory(own, error);
    if (error) throw_environment_error("cannot create " + own.string(), error.value());
  }
  write_file_atomically(
      array_folder(folder, array.name) / kArrayName,
      json{{"tasks", std::move(tasks)}, {"variables", array.variables}}.dump() + "\n");
}

std::vector<AttemptArray> read_attempts(const JobFolder& folder) {
  std::vector<AttemptArray> arrays;
  std::vector<fs::path> broken;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(attempts_folder(folder), none)) {
    AttemptArray array{entry.path().filename().string(), {}};
    try {
      const fs::path file = entry.path() / kArrayName;
      const json value = parse_own_json(read_file(file), file.string());
      for (const json& task : value.at("tasks")) {
        array.attempts.push_back({task.at("task"), task.at("attempt")});
      }
      value.at("variables").get_to(array.variables);
      arrays.push_back(std::move(array));
    } catch (const EnvironmentError&) {
      broken.push_back(entry.path());
    } catch (const json::exception&) {
      broken.push_back(entry.path());
    }
  }
  for (const fs::path& path : broken) remove_for_good(path);
  std::sort(arrays.begin(), arrays.end(),
            [](const AttemptArray& a, const AttemptArray& b) { return a.name < b.name; });
  return arrays;
}

void end_all_attempts(const JobFolder& folder) {
  std::error_code none;
  if (fs::exists(attempts_folder(folder), none)) remove_for_good(attempts_folder(folder));
}

void note_array_job(const JobFolder& folder, const std::string& array, const std::string& number) {
  write_file_atomically(array_folder(folder, array) / kNumberName, number + "\n");
}

std::string noted_array_job(const JobFolder& folder, const std::string& array) {
  const fs::path file = array_folder(folder, array) / kNumberName;
  if (!fs::exists(file)) return "";
  const std::string text = read_file(file);
  return text.substr(0, text.find('\n'));
}

void revoke_attempt(const JobFolder& folder, const std::string& array, std::size_t index) {
  remove_for_good(attempt_folder(folder, array, index));
}

bool renew_attempt(const JobFolder& folder, const std::string& array, std::size_t index) {
  revoke_attempt(folder, array, index);
  std::error_code error;
  return fs::create_directory(attempt_folder(folder, array, index), error);
}

void remove_attempts(const JobFolder& folder, const std::string& array) {
  remove_for_good(array_folder(folder, array));
  std::error_code ignored;
  fs::remove(attempts_folder(folder), ignored);  // unless there are others
}

std::optional<AttemptClaim> find_claim(const JobFolder& folder, const std::string& array,
                                       std::size_t index) {
  const fs::path file = attempt_folder(folder, array, index) / "claim";
  std::error_code none;
  if (!fs::exists(file, none)) return std::nullopt;
  try {
    const json value = parse_own_json(read_file(file), file.string());
    return AttemptClaim{value.at("node"), value.at("pid")};
  } catch (const EnvironmentError&) {
    return std::nullopt;  // it is being written
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

std::string attempt_end_line(const AttemptEnd& end) {
  return json{{"end", {{"code", end.code}, {"seconds", end.seconds}, {"published", end.published}}}}
      .dump(-1, ' ', false, json::error_handler_t::replace);
}

std::optional<AttemptEnd> read_attempt_end(const std::string& line) {
  if (line.find("\"end\"") == std::string::npos) return std::nullopt;
  try {
    const json value = parse_json(line, "");
    if (!value.contains("end")) return std::nullopt;
    const json& end = value.at("end");
    return AttemptEnd{end.at("code"), end.at("seconds"), end.at("published")};
  } catch (const InputError&) {
    return std::nullopt;
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

}  // namespace throng::jobs
