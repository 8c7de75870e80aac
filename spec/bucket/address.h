// The address of a dataset in an object store: s3://bucket/prefix.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace throng::bucket {

/// A bucket and the prefix of the keys of a dataset's objects.
struct Address {
  std::string bucket = {};
  std::string prefix = {};  ///< segments separated by slashes; "": the whole bucket

  /// "s3://bucket/prefix", without a trailing slash.
  std::string text() const;
  /// The key of the dataset's file with this path (relative to the dataset).
  std::string key_of(std::string_view path) const;
  /// Whether this address equals `other` or lies below it by whole segments: s3://b/a/c is within
  /// s3://b/a, and s3://b/ab is not.
  bool is_within(const Address& other) const;
};

/// Parses an address: a bucket's name by the rules of S3 and a prefix of at most 512 bytes, whose
/// segments consist of letters, digits, '.', '_', '-' and '='. Throws InputError whose problem has
/// `source` and `pointer`; the message does not repeat an address that contains '@', hence no
/// password.
Address parse_address(std::string_view text, const std::string& source, const std::string& pointer);

}  // namespace throng::bucket
