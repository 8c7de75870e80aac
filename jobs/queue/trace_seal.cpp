#include "jobs/queue/trace_seal.h"

#include "base/files/files.h"
#include "base/files/hash.h"

namespace throng::jobs {

namespace fs = std::filesystem;

namespace {

fs::path seal_file(const fs::path& trace) { return trace.string() + ".sha256"; }

std::string text_of_seal(const fs::path& trace) { return sha256_hex_of_file(trace) + "\n"; }

}  // namespace

void seal_trace(const fs::path& trace) {
  write_file_atomically(seal_file(trace), text_of_seal(trace));
}

std::string sealed_hash(const fs::path& trace) {
  if (!fs::exists(seal_file(trace))) return sha256_hex_of_file(trace);
  const std::string text = read_file(seal_file(trace));
  return text.substr(0, text.find('\n'));
}

void remove_if_damaged(const fs::path& trace) {
  if (!fs::exists(trace)) return;
  if (fs::exists(seal_file(trace)) && read_file(seal_file(trace)) == text_of_seal(trace)) return;
  fs::remove(trace);
  fs::remove(seal_file(trace));
}

}  // namespace throng::jobs
