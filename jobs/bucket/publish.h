// Upload of a finished dataset to a bucket of an object store.
//
// The bucket is the only record of progress: objects with the right size and checksum are kept,
// interrupted multipart uploads are continued, and objects with other bytes are never overwritten.
// manifest.json is uploaded last, after a listing has shown all other objects, so that a prefix
// with a manifest holds the whole dataset.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <stop_token>

#include "spec/bucket/address.h"

namespace throng::bucket {

/// Size of a published dataset, including objects that existed already.
struct Published {
  std::int64_t objects = 0;
  std::int64_t bytes = 0;
};

/// Receives the number of bytes known to be in the bucket and the size of the dataset.
using OnPublished = std::function<void(std::int64_t done_bytes, std::int64_t total_bytes)>;

/// Uploads a dataset to an address with the credentials of read_access(). Safe to repeat after any
/// interruption. Throws InputError (the folder holds no dataset or a modified one, the bucket does
/// not exist, the prefix holds other objects), EnvironmentError and Cancelled.
Published publish_dataset(const std::filesystem::path& dataset, const Address& address,
                          const OnPublished& on_published = {}, const std::stop_token& stop = {});

/// Checks in advance whether a dataset can be uploaded to an address: credentials, bucket,
/// permission to write, and that the prefix holds no dataset yet. Leaves no object behind. Throws
/// as publish_dataset().
void check_target(const Address& address, std::stop_token stop = {});

}  // namespace throng::bucket
