// Parsers for the XML answers of an object store.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/bucket/url_text.h"

namespace throng::bucket {

struct ListedObject {
  std::string key;
  std::int64_t bytes = 0;
  std::string tag;  ///< ETag without quotes
};

/// A multipart upload that was started and not completed.
struct ListedUpload {
  std::string key;
  std::string id;
};

/// A part of a multipart upload that has arrived.
struct ListedPart {
  int number = 0;
  std::int64_t bytes = 0;
  std::string tag;
};

/// A page of a listing.
template <typename Entry>
struct Page {
  std::vector<Entry> entries;
  Pairs next;  ///< query parameters of the next page; empty on the last page
};

/// Bounds a listing over all its pages, because a store may list for ever. One of a dataset with a
/// million objects has about 160 MB.
class ListingBound {
 public:
  /// To be called with each page. Throws EnvironmentError for a listing of more than 256 MiB or
  /// 100 000 pages, and for one that begins again.
  template <typename Entry>
  void add(const Page<Entry>& page) {
    for (const Entry& entry : page.entries) bytes_ += sizeof(Entry) + text_bytes(entry);
    add_page(page.next);
  }

 private:
  static std::size_t text_bytes(const ListedObject& one) { return one.key.size() + one.tag.size(); }
  static std::size_t text_bytes(const ListedUpload& one) { return one.key.size() + one.id.size(); }
  static std::size_t text_bytes(const ListedPart& one) { return one.tag.size(); }
  void add_page(const Pairs& next);

  std::size_t bytes_ = 0;
  int pages_ = 0;
  Pairs next_;
};

/// Parse the answers to ListObjectsV2, ListMultipartUploads and ListParts. Throw EnvironmentError
/// for other text.
Page<ListedObject> read_objects(const std::string& xml);
Page<ListedUpload> read_uploads(const std::string& xml);
Page<ListedPart> read_parts(const std::string& xml);

/// The text of a child of the root element, for example "UploadId"; "" if there is none.
std::string read_value(const std::string& xml, const char* name);

/// An error answer of a store.
struct StoreError {
  std::string code;  ///< "" if the text is no error
  std::string message;
};

/// Parses an error answer. Ignores its other elements, which may contain key ids and signed text.
StoreError read_error(const std::string& xml);

/// A text for people: "AccessDenied: Access Denied", or the HTTP status if there is no code.
std::string error_text(const StoreError& error, long status);

/// The first line of untrusted text, shortened and without control characters.
std::string first_line(std::string_view text);

std::string without_quotes(std::string_view tag);

}  // namespace throng::bucket
