// WebDataset: plain tar shards in which a sample's members lie together, KEY.jpg and KEY.json, and
// shards.json with the checksum of each.
#include <archive.h>
#include <archive_entry.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "base/error.h"
#include "base/files/files.h"
#include "base/files/hash.h"
#include "base/resource_exhaustion.h"
#include "base/text/portable_name.h"
#include "formats/export/makers.h"

namespace throng::formats {

namespace fs = std::filesystem;
namespace {

constexpr double kBytesPerMb = 1e6;
constexpr std::int64_t kTarBlock = 512;

/// Size of a member in a tar file: a header and whole blocks.
std::int64_t bytes_in_tar(std::string_view member) {
  const auto size = static_cast<std::int64_t>(member.size());
  return kTarBlock + (size + kTarBlock - 1) / kTarBlock * kTarBlock;
}

struct CloseArchive {
  void operator()(archive* tar) const { archive_write_free(tar); }
};

/// Equal members give equal bytes: owner 0, time 0.
class TarFile {
 public:
  explicit TarFile(fs::path path) : path_(std::move(path)), tar_(archive_write_new()) {
    fs::create_directories(path_.parent_path());
    require(archive_write_set_format_ustar(tar_.get()));
    require(archive_write_add_filter_none(tar_.get()));
    require(archive_write_open_filename(tar_.get(), path_.c_str()));
  }

  void add(const std::string& name, std::string_view bytes) {
    if (const auto clash = names_.add(name)) {
      throw InputError(Problem{
          path_.string(), "",
          fmt::format("\"{}\" and \"{}\", one file on Windows and macOS", clash->earlier, name),
          "cameras whose ids differ in more than their case"});
    }
    constexpr int kMode = 0644;
    const std::unique_ptr<archive_entry, decltype(&archive_entry_free)> entry(archive_entry_new(),
                                                                              archive_entry_free);
    archive_entry_set_pathname(entry.get(), name.c_str());
    archive_entry_set_size(entry.get(), static_cast<la_int64_t>(bytes.size()));
    archive_entry_set_filetype(entry.get(), AE_IFREG);
    archive_entry_set_perm(entry.get(), kMode);
    archive_entry_set_mtime(entry.get(), 0, 0);
    require(archive_write_header(tar_.get(), entry.get()));
    if (archive_write_data(tar_.get(), bytes.data(), bytes.size()) !=
        static_cast<la_ssize_t>(bytes.size())) {
      require(ARCHIVE_FATAL);
    }
  }

  void close() { require(archive_write_close(tar_.get())); }

 private:
  void require(int result) const {
    if (result == ARCHIVE_OK) return;
    throw_write_error(path_, std::max(0, archive_errno(tar_.get())));
  }

  fs::path path_;
  std::unique_ptr<archive, CloseArchive> tar_;
  DistinctPaths names_;
};

class WebDatasetExporter : public Exporter {
 public:
  WebDatasetExporter(const DatasetInfo& info, Output output)
      : info_(info), output_(std::move(output)) {}

  void add(const Image& image) override {
    // Keys end at the first dot, and have none.
    const std::string jpeg = read_file(info_.root / image.file);
    const std::string sample = webdataset_sample(image, info_).dump();
    const std::int64_t bytes = bytes_in_tar(jpeg) + bytes_in_tar(sample);
    Shards& shards = shards_[image.split];
    const bool is_full =
        static_cast<double>(shards.bytes + bytes) > info_.options.webdataset.shard_mb * kBytesPerMb;
    if (!shards.open || is_full) {
      close(shards);
      shards.place = fmt::format("{}-{:06}.tar", to_string(image.split), shards.list.size());
      shards.open = std::make_unique<TarFile>(output_.folder() / shards.place);
    }
    ++shards.samples;
    shards.bytes += bytes;
    shards.open->add(image.stem() + ".jpg", jpeg);
    shards.open->add(image.stem() + ".json", sample);
  }

  void finish() override {
    nlohmann::json list = nlohmann::json::object();
    for (auto& [split, shards] : shards_) {
      close(shards);
      list[std::string(to_string(split))] = std::move(shards.list);
    }
    output_.write("shards.json", list.dump(2) + "\n");
  }

 private:
  struct Shards {
    std::unique_ptr<TarFile> open;
    std::string place;
    std::int64_t samples = 0;  ///< in the open one
    std::int64_t bytes = 0;    ///< likewise
    nlohmann::json list = nlohmann::json::array();
  };

  void close(Shards& shards) const {
    if (!shards.open) return;
    shards.open->close();
    shards.open.reset();
    const fs::path file = output_.folder() / shards.place;
    shards.list.push_back({{"file", shards.place},
                           {"samples", shards.samples},
                           {"bytes", fs::file_size(file)},
                           {"sha256", sha256_hex_of_file(file)}});
    shards.samples = 0;
    shards.bytes = 0;
    output_.written(shards.place);
  }

  const DatasetInfo& info_;
  Output output_;
  std::map<Split, Shards> shards_;
};

}  // namespace

ExporterPointer make_webdataset(const DatasetInfo& info, Output output) {
  return std::make_unique<WebDatasetExporter>(info, std::move(output));
}

}  // namespace throng::formats
