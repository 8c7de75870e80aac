#include "server/catalog/scenario_store.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/json/json_text.h"
#include "base/text/portable_name.h"
#include "server/catalog/api_json.h"
#include "server/catalog/service_errors.h"
#include "server/catalog/unix_time.h"
#include "world/scenario.h"

namespace throng::server {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr const char* kNoteName = "upload.json";
constexpr const char* kFilesName = "files";
constexpr const char* kPlaceId = "place";  // of a scenario that is sent as a blueprint
constexpr std::size_t kMaxNameLength = 40;
constexpr std::size_t kBundleDigits = 16;
constexpr std::size_t kMaxNoteBytes = 256 << 10;

bool is_upload_name(std::string_view name) {
  return !name.empty() && name.size() <= kMaxNameLength &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
         });
}

std::string upload_note(const ScenarioUpload& upload) {
  return dump_text({{"owner", upload.owner},
                    {"created_ms", upload.created_ms},
                    {"bytes", upload.bytes},
                    {"files", upload.files},
                    {"ids", upload.ids},
                    {"summaries", upload.summaries}});
}

ScenarioUpload read_note(const fs::path& folder) {
  const json note = parse_own_json(read_file(folder / kNoteName), (folder / kNoteName).string());
  return {folder.filename().string(),
          note.at("owner"),
          note.at("created_ms"),
          note.at("bytes"),
          note.at("files"),
          note.at("ids"),
          note.value("summaries", std::vector<json>{}),
          0};
}

/// Hash of the files of a folder; of those directly in it, or of all below it.
std::string hash_of_files(const fs::path& folder, bool with_subfolders) {
  std::vector<fs::path> files;
  const auto add = [&](const fs::directory_entry& entry) {
    if (entry.is_regular_file()) files.push_back(entry.path().lexically_relative(folder));
  };
  if (with_subfolders) {
    for (const auto& entry : fs::recursive_directory_iterator(folder)) add(entry);
  } else {
    for (const auto& entry : fs::directory_iterator(folder)) add(entry);
  }
  std::sort(files.begin(), files.end());
  std::string list;
  for (const fs::path& file : files) {
    list += fmt::format("{} {}\n", sha256_hex_of_file(folder / file), file.generic_string());
  }
  return sha256_hex(list);
}

/// Root of the bundle's files: below a single folder that holds everything.
fs::path find_root(const fs::path& unpacked) {
  std::vector<fs::directory_entry> entries;
  for (const fs::directory_entry& entry : fs::directory_iterator(unpacked)) {
    entries.push_back(entry);
  }
  return entries.size() == 1 && entries[0].is_directory() ? entries[0].path() : unpacked;
}

}  // namespace

bool is_bundle_name(std::string_view name) {
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return name.size() == 1 + kBundleDigits && name.front() == 'b' &&
         std::all_of(name.begin() + 1, name.end(), is_digit);
}

std::string bundle_name(std::string_view bytes) {
  return fmt::format("b{}", sha256_hex(bytes).substr(0, kBundleDigits));
}

std::string upload_name(const std::string& scenario_id) {
  return scenario_id.substr(0, scenario_id.find('/'));
}

fs::path ScenarioStore::folder_in(const fs::path& data) { return fs::absolute(data) / "scenarios"; }

ScenarioStore::ScenarioStore(const fs::path& data, const fs::path& shipped,
                             const ConfinedChecks& confined, UploadLimits limits)
    : data_(fs::absolute(data)),
      uploads_(data_ / "uploads"),
      links_(folder_in(data)),
      confined_(confined),
      limits_(limits) {
  make_folders(uploads_);
  remove_temporaries(uploads_);
  remove_temporaries(data_);
  find_uploads();
  make_links(shipped);
}

void ScenarioStore::find_uploads() {
  for (const fs::directory_entry& entry : fs::directory_iterator(uploads_)) {
    const std::string name = entry.path().filename().string();
    try {
      if (!is_upload_name(name)) continue;
      ScenarioUpload upload = read_note(entry.path());
      const bool is_large = fs::file_size(entry.path() / kNoteName) > kMaxNoteBytes;
      if (is_large || upload.summaries.size() != upload.ids.size()) describe(upload);
      known_[name] = std::move(upload);
    } catch (const std::exception& error) {
      spdlog::warn("upload {}: cannot be read and is left aside: {}", name, error.what());
    }
  }
}

/// An upload of an earlier version, whose record lacks the scenarios' summaries or has too large
/// ones.
void ScenarioStore::describe(ScenarioUpload& upload) const {
  upload.summaries.clear();
  const fs::path folder = uploads_ / upload.name;
  try {
    jobs::CheckedScenarios checked = confined_.scenarios(folder / kFilesName);
    if (checked.ids.size() != upload.ids.size()) return;
    upload.summaries = std::move(checked.summaries);
    write_file_atomically(folder / kNoteName, upload_note(upload));
  } catch (const InputError& error) {
    spdlog::warn("upload {}: cannot be used any more: {}", upload.name, error.what());
  }
}

void ScenarioStore::make_links(const fs::path& shipped) const {
  StagingFolder links(links_);
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(shipped, error)) {
    const std::string name = entry.path().filename().string();
    if (known_.contains(name)) {
      spdlog::warn("scenario {}: an upload of this name hides the one that comes with throng",
                   name);
      continue;
    }
    fs::create_symlink(fs::canonical(entry.path()), links.path() / name);
  }
  for (const auto& [name, upload] : known_) {
    fs::create_directory_symlink(fs::path("../uploads") / name / kFilesName, links.path() / name);
  }
  links.commit_replacing();
}

ScenarioStore::Staged ScenarioStore::begin_staging(const std::string& name,
                                                   const std::string& owner) const {
  if (!is_upload_name(name) || is_device_name(name)) {
    throw InputError(Problem{
        "", "?name", '"' + name + '"',
        fmt::format("1 to {} small letters, digits and underscores, and no device of Windows",
                    kMaxNameLength)});
  }
  return {{name, owner, unix_ms_now(), 0, 0, {}, {}, 0},
          {},
          std::make_unique<StagingFolder>(uploads_ / name)};
}

void ScenarioStore::finish_staging(Staged& staged) const {
  const fs::path& folder = staged.folder->path();
  ScenarioUpload& upload = staged.upload;
  jobs::CheckedScenarios checked = confined_.scenarios(folder / kFilesName);
  for (const std::string& id : checked.ids) upload.ids.push_back(upload.name + "/" + id);
  upload.summaries = std::move(checked.summaries);
  staged.findings = std::move(checked.findings);
  const std::string note = upload_note(upload);
  // Notes of all uploads are in memory.
  if (note.size() > kMaxNoteBytes) {
    throw InputError(Problem{"", "", fmt::format("summaries of scenarios of {} bytes", note.size()),
                             fmt::format("at most {}: fewer or simpler scenarios", kMaxNoteBytes)});
  }
  write_file_atomically(folder / kNoteName, note);
}

ScenarioStore::Staged ScenarioStore::stage(const std::string& name, std::string_view bytes,
                                           const std::string& owner) const {
  Staged staged = begin_staging(name, owner);
  const fs::path& folder = staged.folder->path();
  const fs::path unpacked = folder / "unpacked";
  fs::create_directories(unpacked);
  const Unpacked found = confined_.unpack(bytes, unpacked, limits_.each);
  staged.upload.bytes = found.bytes;
  staged.upload.files = found.files;
  fs::rename(find_root(unpacked), folder / kFilesName);
  fs::remove_all(unpacked);
  finish_staging(staged);
  return staged;
}

ScenarioStore::Staged ScenarioStore::stage_blueprint(const std::string& name, const json& blueprint,
                                                     const std::string& owner) const {
  Staged staged = begin_staging(name, owner);
  const std::string text = blueprint.dump(1) + "\n";
  const std::string file = fmt::format("{}{}", kPlaceId, world::kBlueprintEnding);
  write_file_atomically(staged.folder->path() / kFilesName / file, text);
  staged.upload.bytes = static_cast<std::int64_t>(text.size());
  staged.upload.files = 1;
  finish_staging(staged);
  return staged;
}

ScenarioUpload ScenarioStore::publish(Staged& staged) {
  const ScenarioUpload& upload = staged.upload;
  const std::lock_guard lock(mutex_);
  if (known_.contains(upload.name) || fs::exists(fs::symlink_status(links_ / upload.name))) {
    throw NameTaken(fmt::format("there are scenarios named \"{}\" already", upload.name));
  }
  constexpr std::int64_t kMaxPartOfKey = 5;
  std::int64_t bytes = upload.bytes;
  std::int64_t own_bytes = upload.bytes;
  std::size_t own_uploads = 1;
  for (const auto& [name, other] : known_) {
    bytes += other.bytes;
    if (other.owner != upload.owner) continue;
    own_bytes += other.bytes;
    ++own_uploads;
  }
  if (!upload.owner.empty() &&
      (own_uploads > limits_.max_uploads_of_key || own_bytes > limits_.max_bytes / kMaxPartOfKey)) {
    throw QuotaError(fmt::format("a key may have {} uploads of {} bytes together: remove some",
                                 limits_.max_uploads_of_key, limits_.max_bytes / kMaxPartOfKey));
  }
  if (known_.size() >= limits_.max_uploads || bytes > limits_.max_bytes) {
    throw UploadsFull(
        fmt::format("uploads may be {} of {} bytes together, and there is no space for this one",
                    limits_.max_uploads, limits_.max_bytes));
  }
  staged.folder->commit();
  fs::create_directory_symlink(fs::path("../uploads") / upload.name / kFilesName,
                               links_ / upload.name);
  ScenarioUpload& known = known_[upload.name] = upload;
  known.publication = ++publications_;
  spdlog::info("scenarios {} uploaded: {} files, {} bytes", upload.name, upload.files,
               upload.bytes);
  return upload;
}

std::optional<ScenarioUpload> ScenarioStore::find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = known_.find(name);
  return found == known_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<ScenarioUpload> ScenarioStore::list() const {
  const std::lock_guard lock(mutex_);
  std::vector<ScenarioUpload> all;
  all.reserve(known_.size());
  for (const auto& [name, upload] : known_) all.push_back(upload);
  return all;
}

std::uint64_t ScenarioStore::publications() const {
  const std::lock_guard lock(mutex_);
  return publications_;
}

bool ScenarioStore::is_published_after(const std::string& name, std::uint64_t publications) const {
  const std::lock_guard lock(mutex_);
  const auto found = known_.find(name);
  return found != known_.end() && found->second.publication > publications;
}

std::string ScenarioStore::content_hash(const std::string& name) const {
  const std::lock_guard lock(hashes_mutex_);
  const auto found = hashes_.find(name);
  if (found != hashes_.end()) return found->second;
  try {
    // The files of a scenario whose id has one part lie among those of the others.
    const bool is_folder = fs::is_directory(links_ / name);
    if (!is_folder && !world::has_scenario(links_, name)) return "";
    return hashes_[name] = hash_of_files(is_folder ? links_ / name : links_, is_folder);
  } catch (const fs::filesystem_error& error) {
    throw EnvironmentError(fmt::format("cannot read the scenarios {}: {}", name, error.what()));
  }
}

bool ScenarioStore::is_taken(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return is_upload_name(name) && fs::exists(fs::symlink_status(links_ / name));
}

bool ScenarioStore::remove(const std::string& name) {
  const std::lock_guard lock(mutex_);
  if (known_.erase(name) == 0) return false;
  {
    const std::lock_guard hashes_lock(hashes_mutex_);
    hashes_.erase(name);
  }
  std::error_code error;
  fs::remove(links_ / name, error);
  const fs::path trash = data_ / "trash";
  fs::create_directories(trash, error);
  fs::rename(uploads_ / name, trash / ("upload_" + name), error);
  fs::remove_all(trash / ("upload_" + name), error);
  if (error) spdlog::warn("upload {}: some files remain: {}", name, error.message());
  spdlog::info("scenarios {} removed", name);
  return true;
}

}  // namespace throng::server
