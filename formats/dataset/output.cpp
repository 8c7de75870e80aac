#include "formats/dataset/output.h"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/path_below.h"
#include "base/resource_exhaustion.h"
#include "formats/dataset/comparison.h"

namespace throng::formats {

namespace fs = std::filesystem;

namespace {

fs::path with_folder(fs::path path) {
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  return path;
}

const fs::path& below(const fs::path& path) {
  require_path_below(path.generic_string(), "export", "");
  return path;
}

}  // namespace

OutputStream Output::open(const fs::path& path) const {
  return {folder_ / below(path), comparison_, path};
}

OutputStream::OutputStream(fs::path path)
    : path_(with_folder(std::move(path))), file_(path_, std::ios::binary) {
  require_good();
}

OutputStream::OutputStream(fs::path path, Comparison* comparison, fs::path compared)
    : OutputStream(std::move(path)) {
  comparison_ = comparison;
  compared_ = std::move(compared);
}

void OutputStream::write(std::string_view text) {
  file_.write(text.data(), static_cast<std::streamsize>(text.size()));
  require_good();
}

void OutputStream::close() {
  file_.close();
  require_good();
  if (comparison_ == nullptr) return;
  comparison_->file(compared_, path_);
  fs::remove(path_);
}

void OutputStream::require_good() const {
  if (file_) return;
  throw_write_error(path_, errno);
}

void Output::written(const fs::path& path) const {
  if (comparison_ == nullptr) return;
  comparison_->file(path, folder_ / path);
  fs::remove(folder_ / path);
}

void Output::write(const fs::path& path, std::string_view bytes) const {
  if (comparison_ != nullptr) {
    comparison_->bytes(path, bytes);
    return;
  }
  OutputStream file(folder_ / below(path));
  file.write(bytes);
  file.close();
}

void Output::link(const fs::path& path, const fs::path& source) const {
  if (comparison_ != nullptr) {
    comparison_->file(path, source);
    return;
  }
  link_or_copy(source, folder_ / below(path));
}

}  // namespace throng::formats
