#include "jobs/queue/pinned_library.h"

#include <fmt/core.h>

#include <string_view>

#include "base/error.h"
#include "base/files/files.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

fs::path pin_file(const JobFolder& folder) { return folder.path() / "work" / "people"; }

}  // namespace

void pin_library(const JobFolder& folder, const std::string& content_hash) {
  const fs::path note = pin_file(folder);
  if (!fs::exists(note)) {
    // Only one of several workers can give the note its name; the others read it.
    StagedFile draft(note);
    draft.write(content_hash);
    draft.commit_if_absent();
  }
  const std::string pinned = pinned_library(folder);
  if (pinned == content_hash) return;
  throw EnvironmentError(
      fmt::format("the people have changed since the job began: it was begun with {} ({}), and the "
                  "character library is {}; build the former again or submit the job again",
                  pinned, note.string(), content_hash));
}

void heal_library_pin(const JobFolder& folder) {
  const fs::path note = pin_file(folder);
  std::error_code error;
  if (!fs::exists(fs::symlink_status(note, error))) return;
  constexpr std::string_view kDigits = "0123456789abcdef";
  constexpr std::size_t kHashDigits = 64;
  try {
    const std::string hash = read_file(note);
    if (hash.size() == kHashDigits && hash.find_first_not_of(kDigits) == hash.npos) return;
  } catch (const EnvironmentError&) {  // a folder or a link
  }
  for (const auto& run : fs::directory_iterator(note.parent_path(), error)) {
    if (!run.is_directory(error) || run.is_symlink(error)) continue;
    for (const auto& output : fs::directory_iterator(run.path(), error)) {
      if (output.path().filename().string().starts_with("shard"))
        fs::remove_all(output.path(), error);
    }
  }
  fs::remove_all(note, error);
}

std::string pinned_library(const JobFolder& folder) {
  const fs::path note = pin_file(folder);
  return fs::exists(note) ? read_file(note) : std::string();
}

}  // namespace throng::jobs
