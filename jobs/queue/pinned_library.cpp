#include "jobs/queue/pinned_library.h"

#include <fmt/core.h>

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

std::string pinned_library(const JobFolder& folder) {
  const fs::path note = pin_file(folder);
  return fs::exists(note) ? read_file(note) : std::string();
}

}  // namespace throng::jobs
