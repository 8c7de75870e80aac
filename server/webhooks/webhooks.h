// Store of webhooks: addresses, event types and delivery log, in a file of their own that only its
// owner may read, because it holds the signing secrets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace throng::server {

/// A webhook as stored.
struct Webhook {
  std::string id;
  std::string url;                  ///< http or https
  std::vector<std::string> events;  ///< types (jobs::EventRow::type); "*": all
  std::string secret;
  std::int64_t created_ms = 0;
  std::int64_t after = 0;             ///< number of the last event that needs no delivery any more
  std::int64_t failing_since_ms = 0;  ///< 0: the last delivery succeeded
  int failures = 0;                   ///< consecutive failures
  bool enabled = true;
};

/// One attempt to deliver one event.
struct Delivery {
  std::int64_t event = 0;  ///< EventRow::seq; 0 for a ping
  std::string type;
  std::int64_t at_ms = 0;
  int attempt = 0;
  int status = 0;     ///< HTTP status; 0: no response
  std::string error;  ///< why there was no response; "" otherwise
  std::int64_t took_ms = 0;

  bool succeeded() const { return status >= 200 && status < 300; }
};

/// Safe to use from many threads. All members throw EnvironmentError.
class Webhooks {
 public:
  explicit Webhooks(const std::filesystem::path& data);
  ~Webhooks();
  Webhooks(const Webhooks&) = delete;
  Webhooks& operator=(const Webhooks&) = delete;

  /// Creates a webhook for the events with numbers above `after`. If `secret` is "", generates one.
  Webhook create(const std::string& url, const std::vector<std::string>& events, std::string secret,
                 std::int64_t after);
  std::vector<Webhook> list() const;
  std::optional<Webhook> get(const std::string& id) const;
  /// Removes a webhook; returns false if there is none.
  bool remove(const std::string& id);

  /// Enables or disables a webhook; deliveries continue with events above number `after`. Returns
  /// false if there is no such webhook.
  bool enable(const std::string& id, bool enabled, std::int64_t after);

  /// Stores the webhook's state and logs the attempt, if any.
  void settle(const Webhook& webhook, const std::optional<Delivery>& delivery);

  /// At most `limit` attempts, newest first.
  std::vector<Delivery> deliveries(const std::string& id, int limit) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

/// The signature "t=SECONDS,v1=HEX": HMAC-SHA256, keyed by the secret, of the time, a dot and the
/// body.
std::string sign_body(const std::string& secret, std::int64_t unix_s, const std::string& body);

}  // namespace throng::server
