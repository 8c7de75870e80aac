// The requests to an object store that publishing needs, one function each.
#pragma once

#include <string>
#include <vector>

#include "jobs/bucket/listing.h"
#include "jobs/bucket/transfers.h"

namespace throng::bucket {

/// Header with a file's SHA-256 in hex, stored with its object.
inline constexpr const char* kHashHeader = "x-amz-meta-sha256";

/// All objects below a prefix.
std::vector<ListedObject> list_objects(Transfers& store, const std::string& prefix);

/// Uploads below a prefix that were started and not completed. Empty if the store does not support
/// or the credentials do not permit the listing.
std::vector<ListedUpload> list_uploads(Transfers& store, const std::string& prefix);

/// Parts of an upload that have arrived. Empty if the store does not support or the credentials do
/// not permit the listing.
std::vector<ListedPart> list_parts(Transfers& store, const ListedUpload& upload);

/// An object's headers; std::nullopt if it does not exist.
std::optional<Response> head_object(Transfers& store, const std::string& key);

/// A request that uploads the whole object; its response has the ETag.
Request put_object(const std::string& key, Payload payload);

/// Starts a multipart upload and returns its id. Stores `sha256_hex`, the file's hash, with the
/// object unless it is "".
std::string create_upload(Transfers& store, const std::string& key, const std::string& sha256_hex);

/// A request that uploads the part with this number, from 1; its response has the ETag.
Request put_part(const ListedUpload& upload, int number, Payload payload);

/// Completes an upload from the parts with these ETags, in order from part 1. Returns false if the
/// store does not know the upload, perhaps because an earlier attempt completed it and the response
/// was lost.
bool complete_upload(Transfers& store, const ListedUpload& upload,
                     const std::vector<std::string>& tags);

/// Aborts an upload and removes its parts. A store that cannot do so keeps them until its own rules
/// remove them.
void abort_upload(Transfers& store, const ListedUpload& upload);

}  // namespace throng::bucket
