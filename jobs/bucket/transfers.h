// Signed HTTP requests to a bucket (AWS Signature Version 4, by libcurl): several at once, each
// repeated when the network or the store fails.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "jobs/bucket/access.h"
#include "jobs/bucket/digests.h"
#include "jobs/bucket/url_text.h"

namespace throng::bucket {

/// Body of a request: a text, or a range of a file that is read during the transfer.
struct Payload {
  std::string text = {};
  std::filesystem::path file = {};  ///< "" for a text
  std::int64_t offset_bytes = 0;
  std::int64_t size_bytes = 0;
  Digest digest = compute_digest("");  ///< of the body; the store refuses other bytes
};

/// A payload with the size and digest of a text.
Payload make_payload(std::string text);

/// Response to a request.
struct Response {
  long status = 0;                                               ///< HTTP status
  std::map<std::string, std::string, std::less<>> headers = {};  ///< names in lower case
  std::string body = {};

  bool is_success() const;
  /// The header with this name in lower case; "" if there is none.
  std::string header(std::string_view name) const;
  /// The object's ETag without quotes.
  std::string tag() const;
  /// Whether the store encrypts the object with a key-management service, so that its ETag is no
  /// MD5.
  bool has_opaque_tag() const;
};

/// A request to the bucket or to one of its objects.
struct Request {
  std::string method = "GET";
  std::string key = {};  ///< "" for the bucket
  Pairs query = {};
  Pairs headers = {};
  Payload payload = {};
  std::vector<long> accepted = {};  ///< statuses besides 2xx that are no errors
  /// Returns the fault of a response, so that the request is repeated; "" if there is none.
  std::function<std::string(const Response&)> fault = [](const Response&) { return ""; };
};

/// Retries of a request after failures of the network or the store.
struct RetryPolicy {
  int attempts = 8;
  double first_rest_s = 0.2;  ///< pause after the first failure; doubled after each further one
  double max_rest_s = 10;     ///< max pause
};

/// Use from one thread at a time. All calls throw EnvironmentError if the store cannot be reached
/// or refuses a request, InputError if the bucket does not exist, and Cancelled. Error messages
/// contain the store's code and message and no other part of its response.
class Transfers {
 public:
  /// A request and the function that receives its response.
  struct Work {
    Request request;
    std::function<void(const Response&)> done;
  };

  Transfers(Access access, Address address, std::stop_token stop, RetryPolicy policy = {});
  ~Transfers();
  Transfers(const Transfers&) = delete;
  Transfers& operator=(const Transfers&) = delete;

  /// Sends one request and blocks until its response has arrived.
  Response send(Request request);
  /// Sends the requests that `next` returns, several at once, until it returns std::nullopt and all
  /// responses have arrived.
  void run(const std::function<std::optional<Work>()>& next);

  const Address& address() const { return address_; }

 private:
  struct Transfer;
  struct Multi;

  void begin(std::unique_ptr<Transfer> transfer);
  void collect_ended();
  void finish(std::unique_ptr<Transfer> transfer, int curl_code);
  void begin_rested();
  [[noreturn]] void refuse(const Transfer& transfer, const std::string& reason) const;

  Access access_;
  Address address_;
  std::stop_token stop_;
  RetryPolicy policy_;
  std::string url_;
  std::unique_ptr<Multi> multi_;
  std::vector<std::unique_ptr<Transfer>> active_;
  std::vector<std::unique_ptr<Transfer>> resting_;
};

}  // namespace throng::bucket
