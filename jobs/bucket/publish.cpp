#include "jobs/bucket/publish.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/error.h"
#include "base/files/hash.h"
#include "base/files/untrusted_folders.h"
#include "base/text/words.h"
#include "jobs/bucket/requests.h"
#include "jobs/queue/dataset/manifest.h"

namespace throng::bucket {

namespace fs = std::filesystem;
using jobs::FileEntry;

namespace {

constexpr std::int64_t kPartSizeBytes = std::int64_t{8} << 20;  // S3 asks for 5 MiB at least
constexpr std::int64_t kMaxParts = 10'000;

std::int64_t part_size(std::int64_t file_bytes) {
  return std::max(kPartSizeBytes, (file_bytes + kMaxParts - 1) / kMaxParts);
}

/// A prefix as listings want it: not those of which it is a part.
std::string folder_prefix(const Address& address) {
  return address.prefix.empty() ? "" : address.prefix + "/";
}

jobs::Manifest manifest_in(const fs::path& dataset) {
  if (!fs::exists(dataset / jobs::kManifestName)) {
    throw InputError(Problem{"", dataset.string(), fmt::format("no {}", jobs::kManifestName),
                             "the folder of a finished dataset"});
  }
  distrust_folders_in(dataset);
  return jobs::read_manifest(dataset);
}

class Publisher {
 public:
  Publisher(const fs::path& dataset, const Address& address, const OnPublished& on_published,
            const std::stop_token& stop)
      : dataset_(dataset),
        address_(address),
        on_published_(on_published),
        manifest_(manifest_in(dataset)),
        access_(read_access()),
        store_(access_, address, stop),
        asked_(access_, address, stop) {
    total_bytes_ = manifest_.itself.bytes;
    for (const FileEntry& file : manifest_.files) total_bytes_ += file.bytes;
  }

  Published publish() {
    look();
    report(0);
    send_small();
    for (const FileEntry& file : manifest_.files) {
      if (is_large(file)) send_large(file);
    }
    verify();
    remove_stale_uploads();
    send_manifest();
    return {static_cast<std::int64_t>(manifest_.files.size()) + 1, total_bytes_};
  }

 private:
  static bool is_large(const FileEntry& file) { return file.bytes > kPartSizeBytes; }

  std::string key_of(const FileEntry& file) const { return address_.key_of(file.path); }

  void report(std::int64_t more_bytes) {
    done_bytes_ += more_bytes;
    if (on_published_) on_published_(done_bytes_, total_bytes_);
  }

  [[noreturn]] void refuse(const FileEntry& file, const std::string& found) const {
    throw InputError(Problem{"", fmt::format("s3://{}/{}", address_.bucket, key_of(file)), found,
                             "a prefix that is empty, or holds only this dataset: nothing is "
                             "overwritten"});
  }

  /// Finds what can be seen to be wrong before anything is sent.
  void look() {
    for (ListedObject& object : list_objects(asked_, folder_prefix(address_))) {
      std::string key = object.key;
      listed_.emplace(std::move(key), std::move(object));
    }
    if (const auto found = listed_.find(key_of(manifest_.itself));
        found != listed_.end() &&
        !is_same(found->second, manifest_.itself, digest(manifest_.itself))) {
      refuse(manifest_.itself, "another dataset");
    }
    for (const FileEntry& file : manifest_.files) {
      std::error_code error;
      const auto bytes = fs::file_size(dataset_ / file.path, error);
      if (error || static_cast<std::int64_t>(bytes) != file.bytes) refuse_local(file);
      const auto found = listed_.find(key_of(file));
      if (found != listed_.end() && found->second.bytes != file.bytes) {
        refuse(file, counted(static_cast<std::size_t>(found->second.bytes), "byte"));
      }
    }
  }

  [[noreturn]] void refuse_local(const FileEntry& file) const {
    throw InputError(
        Problem{"", (dataset_ / file.path).string(), "a file that was changed or lost",
                fmt::format("the {} bytes that {} lists", file.bytes, jobs::kManifestName)});
  }

  FileDigest digest(const FileEntry& file) const {
    FileDigest digest = digest_of_file(dataset_ / file.path, part_size(file.bytes));
    if (digest.whole.sha256_hex != file.sha256) refuse_local(file);
    return digest;
  }

  /// Whether an object holds the file's bytes. A tag that can be no MD5, since the store encrypts
  /// or its parts were others, leaves the hash that was kept with the object.
  bool is_same(const ListedObject& object, const FileEntry& file, const FileDigest& digest) {
    if (object.bytes != file.bytes) return false;
    if (object.tag == encode_hex(digest.whole.md5)) return true;
    if (digest.parts.size() > 1 && object.tag == tag_of_parts(digest.parts)) return true;
    const std::optional<Response> head = head_object(asked_, object.key);
    const std::size_t dash = object.tag.find('-');
    const bool has_other_parts = dash != std::string::npos &&
                                 object.tag.substr(dash + 1) != std::to_string(digest.parts.size());
    return head && (head->has_opaque_tag() || has_other_parts) &&
           head->header(kHashHeader) == digest.whole.sha256_hex;
  }

  /// Whether the file's object is there already; then it is noted. Throws InputError when there is
  /// another one in its place.
  bool is_there(const FileEntry& file, const FileDigest& digest) {
    const auto found = listed_.find(key_of(file));
    if (found == listed_.end()) return false;
    if (!is_same(found->second, file, digest)) refuse(file, "other bytes");
    note(file, found->second.tag);
    return true;
  }

  void note(const FileEntry& file, const std::string& tag) { tags_[key_of(file)] = tag; }

  Payload payload_of_part(const FileEntry& file, const FileDigest& digest, std::size_t part) const {
    const std::int64_t size_bytes = part_size(file.bytes);
    const std::int64_t begin_bytes = size_bytes * static_cast<std::int64_t>(part);
    return {.file = dataset_ / file.path,
            .offset_bytes = begin_bytes,
            .size_bytes = std::min(size_bytes, file.bytes - begin_bytes),
            .digest = digest.parts.at(part)};
  }

  void send_small() {
    auto next = manifest_.files.begin();
    store_.run([&]() -> std::optional<Transfers::Work> {
      for (; next != manifest_.files.end(); ++next) {
        if (is_large(*next)) continue;
        const FileEntry& file = *next++;
        const FileDigest digest = this->digest(file);
        if (is_there(file, digest)) {
          report(file.bytes);
          --next;
          continue;
        }
        return Transfers::Work{put_object(key_of(file), payload_of_part(file, digest, 0)),
                               [this, &file](const Response& response) {
                                 note(file, response.tag());
                                 report(file.bytes);
                               }};
      }
      return std::nullopt;
    });
  }

  void send_large(const FileEntry& file) {
    const FileDigest digest = this->digest(file);
    if (is_there(file, digest)) return report(file.bytes);
    std::vector<std::string> tags(digest.parts.size());
    const ListedUpload upload = find_or_create_upload(file, digest, tags);
    std::size_t part = 0;
    store_.run([&]() -> std::optional<Transfers::Work> {
      while (part < tags.size() && !tags[part].empty()) ++part;
      if (part == tags.size()) return std::nullopt;
      const std::size_t sent = part++;
      Payload payload = payload_of_part(file, digest, sent);
      const std::int64_t bytes = payload.size_bytes;
      return Transfers::Work{put_part(upload, static_cast<int>(sent) + 1, std::move(payload)),
                             [this, &tags, sent, bytes](const Response& response) {
                               tags[sent] = response.tag();
                               report(bytes);
                             }};
    });
    const bool is_completed = complete_upload(asked_, upload, tags);
    const std::optional<Response> head = head_object(asked_, upload.key);
    if (!head) {
      throw EnvironmentError(fmt::format(
          "s3://{}/{}: the store {}, and the object is not there", address_.bucket, upload.key,
          is_completed ? "said that it is complete" : "knows nothing of its parts"));
    }
    const ListedObject made{upload.key, file.bytes, head->tag()};
    if (head->header("content-length") != std::to_string(file.bytes) ||
        !is_same(made, file, digest)) {
      throw EnvironmentError(fmt::format("s3://{}/{}: the store holds other bytes than were sent",
                                         address_.bucket, upload.key));
    }
    note(file, made.tag);
  }

  /// An upload of the file that was broken off, with the tags of its parts, or a new one.
  ListedUpload find_or_create_upload(const FileEntry& file, const FileDigest& digest,
                                     std::vector<std::string>& tags) {
    if (!uploads_) uploads_ = list_uploads(asked_, folder_prefix(address_));
    for (const ListedUpload& upload : *uploads_) {
      if (upload.key != key_of(file)) continue;
      const std::vector<ListedPart> parts = list_parts(asked_, upload);
      const auto is_ours = [&](const ListedPart& part) {
        const auto index = static_cast<std::size_t>(part.number) - 1;
        return part.number > 0 && index < tags.size() &&
               part.bytes == payload_of_part(file, digest, index).size_bytes &&
               part.tag == encode_hex(digest.parts[index].md5);
      };
      if (parts.empty() || !std::all_of(parts.begin(), parts.end(), is_ours)) continue;
      for (const ListedPart& part : parts) {
        tags[static_cast<std::size_t>(part.number) - 1] = part.tag;
        report(part.bytes);
      }
      return upload;
    }
    return {key_of(file), create_upload(asked_, key_of(file), digest.whole.sha256_hex)};
  }

  /// The listing has every object, as it was when the store confirmed it.
  void verify() {
    std::size_t right = 0;
    for (const ListedObject& object : list_objects(asked_, folder_prefix(address_))) {
      const auto found = tags_.find(object.key);
      if (found != tags_.end() && found->second == object.tag) ++right;
    }
    if (right == manifest_.files.size()) return;
    throw EnvironmentError(fmt::format(
        "{}: the listing shows {} of {} objects as they were sent; {} is not there yet, and the "
        "same command goes on",
        address_.text(), right, manifest_.files.size(), jobs::kManifestName));
  }

  /// Removes uploads of attempts whose answer was lost, or of a file that was made again.
  void remove_stale_uploads() {
    if (std::none_of(manifest_.files.begin(), manifest_.files.end(), &is_large)) return;
    for (const ListedUpload& upload : list_uploads(asked_, folder_prefix(address_))) {
      if (tags_.contains(upload.key)) abort_upload(asked_, upload);
    }
  }

  void send_manifest() {
    const FileEntry& file = manifest_.itself;
    if (!listed_.contains(key_of(file))) {
      const FileDigest digest = this->digest(file);
      // One request whatever its size: it is there as a whole or not at all.
      asked_.send(put_object(
          key_of(file),
          {.file = dataset_ / file.path, .size_bytes = file.bytes, .digest = digest.whole}));
    }
    report(file.bytes);
  }

  const fs::path& dataset_;
  const Address& address_;
  const OnPublished& on_published_;
  jobs::Manifest manifest_;
  Access access_;
  Transfers store_;                             ///< sends many objects at once
  Transfers asked_;                             ///< for single questions, also while those are sent
  std::map<std::string, ListedObject> listed_;  ///< by key, before anything was sent
  std::optional<std::vector<ListedUpload>> uploads_;
  std::map<std::string, std::string> tags_;  ///< that the store gave the objects, by key
  std::int64_t done_bytes_ = 0;
  std::int64_t total_bytes_ = 0;
};

}  // namespace

Published publish_dataset(const fs::path& dataset, const Address& address,
                          const OnPublished& on_published, const std::stop_token& stop) {
  return Publisher(dataset, address, on_published, stop).publish();
}

void check_target(const Address& address, std::stop_token stop) {
  constexpr RetryPolicy kBrief{.attempts = 3};
  Transfers store(read_access(), address, std::move(stop), kBrief);
  const std::string key = address.key_of(jobs::kManifestName);
  if (!list_objects(store, key).empty()) {
    throw InputError(Problem{"", address.text(), "a dataset", "a prefix without one"});
  }
  // Says whether these credentials may write, without an object.
  abort_upload(store, {key, create_upload(store, key, "")});
}

}  // namespace throng::bucket
