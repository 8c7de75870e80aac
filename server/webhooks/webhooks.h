// Webhooks: their addresses, events and delivery log. In a separate file of the data folder, which
// only its owner may read: it holds the signing secrets.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace throng::server {

struct Webhook {
  std::string id;
  std::string url;                  ///< http or https
  std::vector<std::string> events;  ///< types (jobs::EventRow::type); "*": all
  std::string secret;
  std::int64_t created_ms = 0;
  std::int64_t after = 0;             ///< the last event that is settled
  std::int64_t failing_since_ms = 0;  ///< 0: the last delivery succeeded
  int failures = 0;                   ///< in a row
  bool enabled = true;
};

/// One attempt to deliver one event.
struct Delivery {
  std::int64_t event = 0;  ///< its seq; 0 for a ping
  std::string type;
  std::int64_t at_ms = 0;
  int attempt = 0;
  int status = 0;     ///< of the answer; 0: there was none
  std::string error;  ///< why there was none; "" otherwise
  std::int64_t took_ms = 0;

  bool succeeded() const { return status >= 200 && status < 300; }
};

/// Safe to use from many threads. Throws EnvironmentError.
class Webhooks {
 public:
  explicit Webhooks(const std::filesystem::path& data);
  ~Webhooks();
  Webhooks(const Webhooks&) = delete;
  Webhooks& operator=(const Webhooks&) = delete;

  /// Receives events after `after`. An empty secret is generated.
  Webhook create(const std::string& url, const std::vector<std::string>& events, std::string secret,
                 std::int64_t after);
  std::vector<Webhook> list() const;
  std::optional<Webhook> get(const std::string& id) const;
  /// False when there is none.
  bool remove(const std::string& id);

  /// Takes a webhook into or out of use; events in between are not delivered later. False when
  /// there is none.
  bool enable(const std::string& id, bool enabled, std::int64_t after);

  /// Logs an attempt and stores the webhook's state.
  void settle(const Webhook& webhook, const std::optional<Delivery>& delivery);

  /// The newest first.
  std::vector<Delivery> deliveries(const std::string& id, int limit) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

/// "t=SECONDS,v1=HEX": HMAC-SHA256 with the secret, of the time, a dot and the body.
std::string sign_body(const std::string& secret, std::int64_t unix_s, const std::string& body);

}  // namespace throng::server
