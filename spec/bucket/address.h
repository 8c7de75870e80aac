// The place of a dataset in an object store: s3://bucket/prefix.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace throng::bucket {

/// A bucket, and what the keys of a dataset's objects begin with.
struct Address {
  std::string bucket = {};
  std::string prefix = {};  ///< segments with slashes between them; "": the whole bucket

  /// "s3://bucket/prefix", without a slash at its end.
  std::string text() const;
  /// The key of a dataset's file.
  std::string key_of(std::string_view path) const;
  /// Whether it is `other`, or below it by whole segments: s3://b/a/c is within s3://b/a, and
  /// s3://b/ab is not.
  bool is_within(const Address& other) const;
};

/// Reads an address: a bucket's name by the rules of S3, and a prefix of letters, digits, '.', '_',
/// '-' and '='. Throws InputError whose problem has `source` and `pointer`; a user and password in
/// the address are refused and not repeated in the message.
Address parse_address(std::string_view text, const std::string& source, const std::string& pointer);

}  // namespace throng::bucket
