// The requests of the object store's interface that publishing needs, one function each.
#pragma once

#include <string>
#include <vector>

#include "jobs/bucket/listing.h"
#include "jobs/bucket/transfers.h"

namespace throng::bucket {

/// A file's SHA-256, kept with its object.
inline constexpr const char* kHashHeader = "x-amz-meta-sha256";

/// All objects below a prefix.
std::vector<ListedObject> list_objects(Transfers& store, const std::string& prefix);

/// Uploads below a prefix that were begun and not completed. Empty where the store cannot list them
/// or these credentials may not.
std::vector<ListedUpload> list_uploads(Transfers& store, const std::string& prefix);

/// Parts of an upload that have arrived. Empty likewise.
std::vector<ListedPart> list_parts(Transfers& store, const ListedUpload& upload);

/// An object's headers; nothing when there is none.
std::optional<Response> head_object(Transfers& store, const std::string& key);

/// Sends the whole object; its answer has the tag.
Request put_object(const std::string& key, Payload payload);

/// Begins an object of several parts, of a file with this hash, if it is not ""; returns the
/// upload's id.
std::string create_upload(Transfers& store, const std::string& key, const std::string& sha256_hex);

Request put_part(const ListedUpload& upload, int number, Payload payload);

/// Makes the object of parts with these tags, from part 1 on. False when the store does not know
/// the upload: perhaps an earlier attempt has completed it, and its answer was lost.
bool complete_upload(Transfers& store, const ListedUpload& upload,
                     const std::vector<std::string>& tags);

/// Removes an upload's parts. A store that cannot do so keeps them until its own rules remove them.
void abort_upload(Transfers& store, const ListedUpload& upload);

}  // namespace throng::bucket
