#include "formats/dataset/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/untrusted_folders.h"

namespace throng::formats {

namespace fs = std::filesystem;

namespace {

bool are_equal(const fs::path& a, const fs::path& b) {
  if (fs::equivalent(a, b)) return true;
  if (fs::file_size(a) != fs::file_size(b)) return false;
  constexpr std::size_t kBlock = 1 << 20;
  std::ifstream first = open_stream(a);
  std::ifstream second = open_stream(b);
  std::string one(kBlock, '\0');
  std::string other(kBlock, '\0');
  while (first && second) {
    first.read(one.data(), kBlock);
    second.read(other.data(), kBlock);
    if (first.gcount() != second.gcount() ||
        !std::equal(one.begin(), one.begin() + first.gcount(), other.begin())) {
      return false;
    }
  }
  return true;
}

}  // namespace

bool Comparison::is_there(const fs::path& path) {
  seen_.insert(path.string());
  if (fs::is_regular_file(folder_ / path)) return true;
  report_(path.string(), "no such file, but the annotations give one");
  return false;
}

void Comparison::bytes(const fs::path& path, std::string_view made) {
  if (!is_there(path)) return;
  if (fs::file_size(folder_ / path) != made.size() || read_file(folder_ / path) != made) {
    report_(path.string(), "not what the annotations give");
  }
}

void Comparison::file(const fs::path& path, const fs::path& made) {
  if (is_there(path) && !(fs::is_regular_file(made) && are_equal(folder_ / path, made))) {
    report_(path.string(), "not what the annotations or images give");
  }
}

void Comparison::finish() const {
  std::set<std::string> others;
  if (!fs::is_directory(folder_)) return;
  for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
    const std::string path = entry.path().lexically_relative(folder_).string();
    if (entry.is_regular_file() && !seen_.contains(path)) others.insert(path);
  }
  for (const std::string& path : others) report_(path, "a file that the format does not have");
}

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "throng-validate-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw EnvironmentError(fmt::format("cannot make {}: {}", name, std::strerror(errno)));
  }
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace throng::formats
