#include "jobs/bucket/requests.h"

#include <fmt/core.h>

#include <exception>

#include "base/error.h"
#include "base/files/hash.h"

namespace throng::bucket {

namespace {

// Answers of stores that do not have a call, or do not let these credentials use it.
const std::vector<long> kUnable = {400, 403, 404, 405, 501};

/// A listing, page after page. `read` throws where the answer is damaged.
template <typename Entry>
std::vector<Entry> list_all(Transfers& store, const Request& first,
                            Page<Entry> (*read)(const std::string&)) {
  std::vector<Entry> all;
  Page<Entry> page;
  ListingBound bound;
  do {
    Request request = first;
    request.query.insert(request.query.end(), page.next.begin(), page.next.end());
    request.fault = [&](const Response& response) -> std::string {
      try {
        page = read(response.body);
        return "";
      } catch (const EnvironmentError& error) {
        return error.what();
      }
    };
    if (!store.send(std::move(request)).is_success()) return all;
    bound.add(page);
    all.insert(all.end(), page.entries.begin(), page.entries.end());
  } while (!page.next.empty());
  return all;
}

/// The tag of what was sent: the MD5, unless the store says that its tags are something else.
std::string fault_of_tag(const Response& response, const Digest& sent) {
  const std::string tag = response.tag();
  if (tag == encode_hex(sent.md5) || (response.has_opaque_tag() && !tag.empty())) return "";
  return fmt::format("the store received other bytes than were sent: its ETag is {}, expected {}",
                     tag.empty() ? "missing" : first_line(tag), encode_hex(sent.md5));
}

Request put(Payload payload) {
  Request request{.method = "PUT", .payload = std::move(payload)};
  request.fault = [digest = request.payload.digest](const Response& response) {
    return fault_of_tag(response, digest);
  };
  return request;
}

}  // namespace

std::vector<ListedObject> list_objects(Transfers& store, const std::string& prefix) {
  return list_all(store, {.query = {{"list-type", "2"}, {"prefix", prefix}}}, &read_objects);
}

std::vector<ListedUpload> list_uploads(Transfers& store, const std::string& prefix) {
  return list_all(store, {.query = {{"uploads", ""}, {"prefix", prefix}}, .accepted = kUnable},
                  &read_uploads);
}

std::vector<ListedPart> list_parts(Transfers& store, const ListedUpload& upload) {
  return list_all(store,
                  {.key = upload.key, .query = {{"uploadId", upload.id}}, .accepted = kUnable},
                  &read_parts);
}

std::optional<Response> head_object(Transfers& store, const std::string& key) {
  Response response = store.send({.method = "HEAD", .key = key, .accepted = {404}});
  if (!response.is_success()) return std::nullopt;
  return response;
}

Request put_object(const std::string& key, Payload payload) {
  Request request = put(std::move(payload));
  request.key = key;
  request.headers = {{kHashHeader, request.payload.digest.sha256_hex}};
  return request;
}

std::string create_upload(Transfers& store, const std::string& key, const std::string& sha256_hex) {
  std::string id;
  Request request{.method = "POST", .key = key, .query = {{"uploads", ""}}};
  if (!sha256_hex.empty()) request.headers = {{kHashHeader, sha256_hex}};
  request.fault = [&](const Response& response) {
    id = read_value(response.body, "UploadId");
    return id.empty() ? "the object store's answer names no upload" : "";
  };
  store.send(std::move(request));
  return id;
}

Request put_part(const ListedUpload& upload, int number, Payload payload) {
  Request request = put(std::move(payload));
  request.key = upload.key;
  request.query = {{"partNumber", std::to_string(number)}, {"uploadId", upload.id}};
  return request;
}

bool complete_upload(Transfers& store, const ListedUpload& upload,
                     const std::vector<std::string>& tags) {
  std::string body = "<CompleteMultipartUpload>";
  for (std::size_t i = 0; i < tags.size(); ++i) {
    body +=
        fmt::format("<Part><PartNumber>{}</PartNumber><ETag>\"{}\"</ETag></Part>", i + 1, tags[i]);
  }
  body += "</CompleteMultipartUpload>";
  Request request{.method = "POST",
                  .key = upload.key,
                  .query = {{"uploadId", upload.id}},
                  .payload = make_payload(std::move(body)),
                  .accepted = {404}};
  request.fault = [](const Response& response) {
    return response.status == 404 || !read_value(response.body, "ETag").empty()
               ? ""
               : "the object store's answer names no object";
  };
  return store.send(std::move(request)).is_success();
}

void abort_upload(Transfers& store, const ListedUpload& upload) {
  store.send({.method = "DELETE",
              .key = upload.key,
              .query = {{"uploadId", upload.id}},
              .accepted = kUnable});
}

}  // namespace throng::bucket
