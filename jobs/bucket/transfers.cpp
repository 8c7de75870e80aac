#include "jobs/bucket/transfers.h"

#include <curl/curl.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include "base/error.h"
#include "base/files/hash.h"
#include "base/files/untrusted_folders.h"
#include "base/text/words.h"
#include "jobs/bucket/listing.h"
#include "jobs/bucket/url_text.h"

namespace throng::bucket {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t kAtOnce = 8;
constexpr std::size_t kMaxAnswerBytes = std::size_t{16} << 20;  // a page of a listing has a tenth
constexpr long kConnectTimeoutS = 15;
constexpr long kSilenceS = 60;  // without a byte in either direction
constexpr long kNotFound = 404;

struct FreeHeaders {
  void operator()(curl_slist* list) const { ::curl_slist_free_all(list); }
};
struct FreeHandle {
  void operator()(CURL* handle) const { ::curl_easy_cleanup(handle); }
};

bool is_sending(const Request& request) {
  return request.method == "PUT" || request.method == "POST";
}

/// Statuses and codes that say that the same request may succeed later: the store is busy, or the
/// bytes were damaged or lost on their way.
bool is_passing(long status, std::string_view code) {
  constexpr std::array kStatuses = {408L, 425L, 429L, 500L, 502L, 503L, 504L};
  constexpr std::array<std::string_view, 8> kCodes = {
      "BadDigest",      "IncompleteBody", "InternalError", "OperationAborted",
      "RequestTimeout", "SlowDown",       "InvalidDigest", "XAmzContentSHA256Mismatch"};
  return std::find(kStatuses.begin(), kStatuses.end(), status) != kStatuses.end() ||
         std::find(kCodes.begin(), kCodes.end(), code) != kCodes.end();
}

/// Errors of the library that no repetition mends.
bool is_lasting(CURLcode code) {
  constexpr std::array kLasting = {
      CURLE_UNSUPPORTED_PROTOCOL, CURLE_URL_MALFORMAT, CURLE_PEER_FAILED_VERIFICATION,
      CURLE_SSL_CACERT_BADFILE,   CURLE_WRITE_ERROR,   CURLE_READ_ERROR};
  return std::find(kLasting.begin(), kLasting.end(), code) != kLasting.end();
}

}  // namespace

Payload make_payload(std::string text) {
  Payload payload;
  payload.digest = compute_digest(text);
  payload.size_bytes = static_cast<std::int64_t>(text.size());
  payload.text = std::move(text);
  return payload;
}

bool Response::is_success() const { return status / 100 == 2; }

std::string Response::header(std::string_view name) const {
  const auto found = headers.find(name);
  return found == headers.end() ? "" : found->second;
}

std::string Response::tag() const { return without_quotes(header("etag")); }

bool Response::has_opaque_tag() const {
  return header("x-amz-server-side-encryption").find("kms") != std::string::npos ||
         !header("x-amz-server-side-encryption-customer-algorithm").empty();
}

struct Transfers::Multi {
  Multi() {
    static const CURLcode kReady = ::curl_global_init(CURL_GLOBAL_DEFAULT);
    handle = kReady == CURLE_OK ? ::curl_multi_init() : nullptr;
    if (handle == nullptr) throw EnvironmentError("libcurl cannot be started");
  }
  ~Multi() { ::curl_multi_cleanup(handle); }
  Multi(const Multi&) = delete;
  Multi& operator=(const Multi&) = delete;
  CURLM* handle;
};

/// One request, from its first attempt to its answer.
struct Transfers::Transfer {
  Transfer(Work wanted, CURLM* in) : work(std::move(wanted)), multi(in) {}
  ~Transfer() { end(); }
  Transfer(const Transfer&) = delete;
  Transfer& operator=(const Transfer&) = delete;

  void begin(const Access& access, const std::string& url);
  /// Takes it out of the library's hands.
  void end() {
    if (handle) ::curl_multi_remove_handle(multi, handle.get());
    handle.reset();
    if (file >= 0) ::close(file);
    file = -1;
  }

  static std::size_t read(char* to, std::size_t size, std::size_t count, void* data);
  static int seek(void* data, curl_off_t offset, int origin);
  static std::size_t take_header(char* text, std::size_t size, std::size_t count, void* data);
  static std::size_t take_body(char* text, std::size_t size, std::size_t count, void* data);

  Work work;
  CURLM* multi;
  int attempts = 0;
  Clock::time_point due = {};  ///< of the next attempt
  Response response = {};
  std::array<char, CURL_ERROR_SIZE> detail{};
  std::unique_ptr<CURL, FreeHandle> handle = nullptr;
  std::unique_ptr<curl_slist, FreeHeaders> headers = nullptr;
  std::int64_t sent_bytes = 0;
  int file = -1;

 private:
  void set_headers(const Access& access);
  void set_connection(const Access& access);
};

std::size_t Transfers::Transfer::read(char* to, std::size_t size, std::size_t count, void* data) {
  auto& self = *static_cast<Transfer*>(data);
  const Payload& payload = self.work.request.payload;
  const auto most = static_cast<std::size_t>(payload.size_bytes - self.sent_bytes);
  const std::size_t wanted = std::min(size * count, most);
  if (wanted == 0) return 0;
  ssize_t taken = static_cast<ssize_t>(wanted);
  if (payload.file.empty()) {
    std::memcpy(to, payload.text.data() + self.sent_bytes, wanted);
  } else {
    taken = ::pread(self.file, to, wanted, payload.offset_bytes + self.sent_bytes);
    if (taken <= 0) return CURL_READFUNC_ABORT;  // it has become shorter
  }
  self.sent_bytes += taken;
  return static_cast<std::size_t>(taken);
}

int Transfers::Transfer::seek(void* data, curl_off_t offset, int origin) {
  if (origin != SEEK_SET) return CURL_SEEKFUNC_CANTSEEK;
  static_cast<Transfer*>(data)->sent_bytes = offset;
  return CURL_SEEKFUNC_OK;
}

std::size_t Transfers::Transfer::take_header(char* text, std::size_t size, std::size_t count,
                                             void* data) {
  constexpr std::size_t kMaxHeaders = 200;
  auto& headers = static_cast<Transfer*>(data)->response.headers;
  const std::string_view line(text, size * count);
  if (line.starts_with("HTTP/")) headers.clear();
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || headers.size() >= kMaxHeaders) return size * count;
  headers[lower_case(line.substr(0, colon))] = trimmed(line.substr(colon + 1));
  return size * count;
}

std::size_t Transfers::Transfer::take_body(char* text, std::size_t size, std::size_t count,
                                           void* data) {
  std::string& body = static_cast<Transfer*>(data)->response.body;
  if (body.size() + size * count > kMaxAnswerBytes) return 0;
  body.append(text, size * count);
  return size * count;
}

void Transfers::Transfer::set_headers(const Access& access) {
  const Request& request = work.request;
  curl_slist* list = nullptr;
  const auto add = [&](const std::string& line) { list = ::curl_slist_append(list, line.c_str()); };
  // Given here, so that the library signs it and the store compares it with what arrives.
  add("x-amz-content-sha256: " + request.payload.digest.sha256_hex);
  if (is_sending(request)) add("Content-MD5: " + encode_base64(request.payload.digest.md5));
  if (!access.token.empty()) add("x-amz-security-token: " + access.token);
  for (const auto& [name, value] : request.headers) add(name + ": " + value);
  headers.reset(list);
  ::curl_easy_setopt(handle.get(), CURLOPT_HTTPHEADER, list);
}

void Transfers::Transfer::set_connection(const Access& access) {
  CURL* const curl = handle.get();
  ::curl_easy_setopt(curl, CURLOPT_PROTOCOLS_STR, "http,https");
  ::curl_easy_setopt(curl, CURLOPT_FOLLOWLOCATION, 0L);
  ::curl_easy_setopt(curl, CURLOPT_HTTP_VERSION, CURL_HTTP_VERSION_1_1);
  ::curl_easy_setopt(curl, CURLOPT_SSLVERSION, CURL_SSLVERSION_TLSv1_2);
  for (const char* name : {"AWS_CA_BUNDLE", "SSL_CERT_FILE"}) {
    const char* trusted = std::getenv(name);
    if (trusted == nullptr || *trusted == '\0') continue;
    ::curl_easy_setopt(curl, CURLOPT_CAINFO, trusted);
    break;
  }
  ::curl_easy_setopt(curl, CURLOPT_AWS_SIGV4, fmt::format("aws:amz:{}:s3", access.region).c_str());
  ::curl_easy_setopt(curl, CURLOPT_USERNAME, access.key_id.c_str());
  ::curl_easy_setopt(curl, CURLOPT_PASSWORD, access.secret.c_str());
  ::curl_easy_setopt(curl, CURLOPT_NOSIGNAL, 1L);
  ::curl_easy_setopt(curl, CURLOPT_CONNECTTIMEOUT, kConnectTimeoutS);
  ::curl_easy_setopt(curl, CURLOPT_LOW_SPEED_LIMIT, 1L);
  ::curl_easy_setopt(curl, CURLOPT_LOW_SPEED_TIME, kSilenceS);
  ::curl_easy_setopt(curl, CURLOPT_ERRORBUFFER, detail.data());
  ::curl_easy_setopt(curl, CURLOPT_PRIVATE, this);
  ::curl_easy_setopt(curl, CURLOPT_HEADERFUNCTION, &take_header);
  ::curl_easy_setopt(curl, CURLOPT_HEADERDATA, this);
  ::curl_easy_setopt(curl, CURLOPT_WRITEFUNCTION, &take_body);
  ::curl_easy_setopt(curl, CURLOPT_WRITEDATA, this);
}

void Transfers::Transfer::begin(const Access& access, const std::string& url) {
  end();
  response = {};
  detail = {};
  sent_bytes = 0;
  ++attempts;
  const Request& request = work.request;
  if (!request.payload.file.empty()) {
    file = open_for_reading(request.payload.file);
    if (file < 0) {
      throw EnvironmentError(
          fmt::format("cannot read {}: {}", request.payload.file.string(), std::strerror(errno)));
    }
  }
  handle.reset(::curl_easy_init());
  CURL* const curl = handle.get();
  const std::string path = request.key.empty() ? "" : "/" + encoded_path(request.key);
  ::curl_easy_setopt(curl, CURLOPT_URL, (url + path + query_text(request.query)).c_str());
  set_connection(access);
  if (is_sending(request)) {
    ::curl_easy_setopt(curl, CURLOPT_UPLOAD, 1L);
    ::curl_easy_setopt(curl, CURLOPT_INFILESIZE_LARGE, curl_off_t{request.payload.size_bytes});
    ::curl_easy_setopt(curl, CURLOPT_READFUNCTION, &read);
    ::curl_easy_setopt(curl, CURLOPT_READDATA, this);
    ::curl_easy_setopt(curl, CURLOPT_SEEKFUNCTION, &seek);
    ::curl_easy_setopt(curl, CURLOPT_SEEKDATA, this);
  }
  if (request.method == "HEAD") ::curl_easy_setopt(curl, CURLOPT_NOBODY, 1L);
  if (request.method == "POST" || request.method == "DELETE") {
    ::curl_easy_setopt(curl, CURLOPT_CUSTOMREQUEST, request.method.c_str());
  }
  set_headers(access);
  ::curl_multi_add_handle(multi, curl);
}

Transfers::Transfers(Access access, Address address, std::stop_token stop, RetryPolicy policy)
    : access_(std::move(access)),
      address_(std::move(address)),
      stop_(std::move(stop)),
      policy_(policy),
      url_(url_of_bucket(access_, address_)),
      multi_(std::make_unique<Multi>()) {}

Transfers::~Transfers() = default;

Response Transfers::send(Request request) {
  Response answer;
  std::optional<Work> work{
      {std::move(request), [&answer](const Response& response) { answer = response; }}};
  run([&] { return std::exchange(work, std::nullopt); });
  return answer;
}

void Transfers::run(const std::function<std::optional<Work>()>& next) {
  constexpr int kPollMs = 50;
  for (bool has_more = true; has_more || !active_.empty() || !resting_.empty();) {
    if (stop_.stop_requested()) throw Cancelled();
    begin_rested();
    while (has_more && active_.size() + resting_.size() < kAtOnce) {
      std::optional<Work> work = next();
      has_more = work.has_value();
      if (work) begin(std::make_unique<Transfer>(std::move(*work), multi_->handle));
      // Others go on while this thread computes checksums for the next one.
      int running = 0;
      ::curl_multi_perform(multi_->handle, &running);
    }
    int running = 0;
    ::curl_multi_perform(multi_->handle, &running);
    collect_ended();
    if (!active_.empty() || !resting_.empty()) {
      ::curl_multi_poll(multi_->handle, nullptr, 0, kPollMs, nullptr);
    }
  }
}

void Transfers::begin(std::unique_ptr<Transfer> transfer) {
  transfer->begin(access_, url_);
  active_.push_back(std::move(transfer));
}

void Transfers::begin_rested() {
  const auto is_due = [now = Clock::now()](const auto& transfer) { return transfer->due <= now; };
  for (auto due = std::find_if(resting_.begin(), resting_.end(), is_due); due != resting_.end();
       due = std::find_if(resting_.begin(), resting_.end(), is_due)) {
    std::unique_ptr<Transfer> transfer = std::move(*due);
    resting_.erase(due);
    begin(std::move(transfer));
  }
}

void Transfers::collect_ended() {
  int left = 0;
  while (const CURLMsg* message = ::curl_multi_info_read(multi_->handle, &left)) {
    if (message->msg != CURLMSG_DONE) continue;
    const CURLcode code = message->data.result;
    CURL* const handle = message->easy_handle;
    const auto found = std::find_if(active_.begin(), active_.end(), [&](const auto& transfer) {
      return transfer->handle.get() == handle;
    });
    check(found != active_.end(), "every handle of the library belongs to a transfer");
    std::unique_ptr<Transfer> transfer = std::move(*found);
    active_.erase(found);
    ::curl_easy_getinfo(handle, CURLINFO_RESPONSE_CODE, &transfer->response.status);
    transfer->end();
    finish(std::move(transfer), code);
  }
}

void Transfers::finish(std::unique_ptr<Transfer> transfer, int curl_code) {
  const Request& request = transfer->work.request;
  const Response& response = transfer->response;
  const auto code = static_cast<CURLcode>(curl_code);
  std::string reason;
  bool may_pass = true;
  if (code != CURLE_OK) {
    const char* detail = transfer->detail.data();
    reason = *detail != '\0' ? detail : ::curl_easy_strerror(code);
    may_pass = !is_lasting(code);
  } else if (std::find(request.accepted.begin(), request.accepted.end(), response.status) ==
             request.accepted.end()) {
    // An upload that is completed answers 200 first, and says later that it failed.
    const StoreError error = read_error(response.body);
    if (!response.is_success() || !error.code.empty()) {
      reason = error_text(error, response.status);
      may_pass = is_passing(response.status, error.code);
      if (response.status == kNotFound && error.code == "NoSuchBucket") {
        throw InputError(
            Problem{"", address_.text(), "no such bucket", "a bucket that the store has"});
      }
      if (const std::string region = response.header("x-amz-bucket-region");
          !region.empty() && region != access_.region) {
        reason += fmt::format("; the bucket is in the region {}, AWS_REGION says {}",
                              first_line(region), access_.region);
      }
    } else {
      reason = request.fault(response);
    }
  }
  if (reason.empty()) return transfer->work.done(response);
  if (!may_pass || transfer->attempts >= policy_.attempts) refuse(*transfer, reason);
  const double rest_s =
      std::min(policy_.max_rest_s, policy_.first_rest_s * std::pow(2.0, transfer->attempts - 1));
  transfer->due = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(rest_s));
  resting_.push_back(std::move(transfer));
}

void Transfers::refuse(const Transfer& transfer, const std::string& reason) const {
  const Request& request = transfer.work.request;
  std::string what =
      fmt::format("{} s3://{}/{}: {}", request.method, address_.bucket, request.key, reason);
  if (transfer.attempts > 1) what += fmt::format(" (after {} attempts)", transfer.attempts);
  // A store may repeat in its message what it was sent.
  constexpr std::size_t kMinSecretBytes = 6;  // a shorter one would be found in any text
  for (const std::string& word : {access_.secret, access_.token, access_.key_id}) {
    if (word.size() < kMinSecretBytes) continue;
    for (auto at = what.find(word); at != std::string::npos; at = what.find(word)) {
      what.replace(at, word.size(), "***");
    }
  }
  throw EnvironmentError(what);
}

}  // namespace throng::bucket
