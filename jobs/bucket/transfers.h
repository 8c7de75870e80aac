// Signed requests to a bucket (Signature Version 4, by libcurl): several at once, each repeated
// when the network or the store fails.
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

/// Bytes to be sent: a part of a file, read while it is sent, or a text.
struct Payload {
  std::string text = {};
  std::filesystem::path file = {};  ///< "": the text
  std::int64_t offset_bytes = 0;
  std::int64_t size_bytes = 0;
  Digest digest = compute_digest("");  ///< of what is sent; the store refuses other bytes
};

Payload make_payload(std::string text);

struct Response {
  long status = 0;
  std::map<std::string, std::string, std::less<>> headers = {};  ///< names in lower case
  std::string body = {};

  bool is_success() const;
  /// "" if there is none.
  std::string header(std::string_view name) const;
  /// The object's tag without quotes.
  std::string tag() const;
  /// Whether the store encrypts the object with keys of its own service: then its tag is no MD5.
  bool has_opaque_tag() const;
};

struct Request {
  std::string method = "GET";
  std::string key = {};  ///< "": the bucket itself
  Pairs query = {};
  Pairs headers = {};
  Payload payload = {};
  std::vector<long> accepted = {};  ///< statuses beside 2xx that are an answer
  /// Names the fault of an answer, which has the request repeated; "" if there is none.
  std::function<std::string(const Response&)> fault = [](const Response&) { return ""; };
};

/// How often a request is tried where the network or the store fails.
struct RetryPolicy {
  int attempts = 8;
  double first_rest_s = 0.2;  ///< twice as long after each further failure
  double max_rest_s = 10;
};

/// Not for several threads at once. All calls throw EnvironmentError when the store cannot be
/// reached or refuses a request, InputError when there is no such bucket, and Cancelled. Messages
/// hold the store's code and message and nothing else of its answer.
class Transfers {
 public:
  struct Work {
    Request request;
    std::function<void(const Response&)> done;
  };

  Transfers(Access access, Address address, std::stop_token stop, RetryPolicy policy = {});
  ~Transfers();
  Transfers(const Transfers&) = delete;
  Transfers& operator=(const Transfers&) = delete;

  Response send(Request request);
  /// Asks for work as long as there is some, and does several pieces at a time.
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
