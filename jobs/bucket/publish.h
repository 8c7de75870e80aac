// A finished dataset as objects of a bucket.
//
// Nothing is kept here about what has been sent: the bucket is asked. Objects that are there with
// the right size and checksum are left as they are, parts of an upload that was broken off are
// continued, and objects with other bytes are never overwritten. manifest.json goes last, after a
// listing has shown every other object: a prefix that has one holds the whole dataset.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>

#include "spec/bucket/address.h"

namespace throng::bucket {

struct Published {
  std::int64_t objects = 0;
  std::int64_t bytes = 0;
};

/// Gets the bytes that are known to be in the bucket.
using OnPublished = std::function<void(std::int64_t done_bytes, std::int64_t total_bytes)>;

/// Brings a dataset to an address, with the credentials of read_access(). Safe to repeat after any
/// interruption. Throws InputError (the folder holds no dataset or one that was changed, there is
/// no such bucket, the prefix holds something else), EnvironmentError and Cancelled.
Published publish_dataset(const std::filesystem::path& dataset, const Address& address,
                          const OnPublished& on_published = {}, const std::stop_token& stop = {});

/// Finds out before any work whether a dataset can be brought to an address later: credentials, the
/// bucket, the right to write there, and that the prefix holds no dataset yet. Leaves no object
/// behind. Throws as publish_dataset().
void check_target(const Address& address, std::stop_token stop = {});

}  // namespace throng::bucket
