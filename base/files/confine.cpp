#include "base/files/confine.h"

#include <algorithm>
#include <utility>

namespace throng {

namespace fs = std::filesystem;

namespace {

thread_local fs::path confined_to;  // empty: anywhere

}  // namespace

bool lies_within(const fs::path& path, const fs::path& folder) {
  std::error_code error;
  const fs::path real = fs::weakly_canonical(path, error);
  if (error) return false;
  const fs::path real_folder = fs::weakly_canonical(folder, error);
  if (error) return false;
  return std::mismatch(real_folder.begin(), real_folder.end(), real.begin(), real.end()).first ==
         real_folder.end();
}

Confinement::Confinement(const fs::path& folder) : before_(std::exchange(confined_to, folder)) {}

Confinement::~Confinement() { confined_to = std::move(before_); }

bool Confinement::allows(const fs::path& path) {
  return confined_to.empty() || lies_within(path, confined_to);
}

}  // namespace throng
