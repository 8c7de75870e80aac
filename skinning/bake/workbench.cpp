#include "skinning/bake/workbench.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "base/error.h"
#include "base/files/files.h"
#include "base/resource_exhaustion.h"

namespace throng::skinning {

namespace fs = std::filesystem;

namespace {

constexpr const char* kHashFile = "content_hash";
constexpr const char* kMotionExtension = ".motion";

}  // namespace

Workbench::Workbench(fs::path output, const std::string& content_hash)
    : output_(std::move(output)), folder_(output_.string() + ".part") {
  std::error_code error;
  fs::create_directories(folder_, error);
  // The lock goes with the process, however it ends.
  lock_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0) throw_write_error(folder_, error ? error.value() : errno);
  if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    ::close(lock_);
    throw EnvironmentError(fmt::format("another build is writing {}", folder_.string()));
  }
  const fs::path hash_file = folder_ / kHashFile;
  if (fs::exists(hash_file) && read_file(hash_file) == content_hash) return;
  for (const auto& entry : fs::directory_iterator(folder_)) fs::remove_all(entry.path());
  write_file_atomically(hash_file, content_hash);
}

Workbench::~Workbench() { ::close(lock_); }

fs::path Workbench::file(const std::string& name, const char* extension) const {
  return folder_ / (name + extension);
}

bool Workbench::has(const std::string& name) const {
  return fs::exists(file(name, kCharacterExtension));  // written last
}

void Workbench::keep(const BakedPerson& person) const {
  const std::string& name = person.character.name;
  write_file_atomically(file(name, kMeshExtension), person.glb);
  write_file_atomically(file(name, kMotionExtension), person.motion);
  write_file_atomically(file(name, kCharacterExtension), encode_character(person.character));
}

void Workbench::keep_notice(const std::string& text) const {
  write_file_atomically(folder_ / kNoticeFile, text);
}

void Workbench::finish(const std::vector<PersonSpec>& people, PopulationIndex index) {
  StagingFolder staging(output_);
  StagedFile palettes(staging.path() / kPalettesFile);
  for (const PersonSpec& person : people) {
    // Not written twice: the finished folder shares them with the workbench.
    link_or_copy(file(person.name, kMeshExtension),
                 staging.path() / (person.name + kMeshExtension));
    palettes.write(read_file(file(person.name, kMotionExtension)));
    index.characters.push_back(read_character(file(person.name, kCharacterExtension)));
  }
  palettes.commit();
  index.textures = count_textures(staging.path(), index.characters);
  link_or_copy(folder_ / kNoticeFile, staging.path() / kNoticeFile);
  write_file_atomically(staging.path() / kIndexFile, encode_index(index));
  staging.commit_replacing();
  fs::remove_all(folder_);
}

}  // namespace throng::skinning
