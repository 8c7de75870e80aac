// Delivers events to webhooks: in their order, each until it is taken, for a day at most.
//
//   POST URL
//   Throng-Event: succeeded
//   Throng-Delivery: WEBHOOK-SEQ          the same for every attempt
//   Throng-Signature: t=SECONDS,v1=HEX    server/webhooks/webhooks.h
//   {"seq": 17, "job": ID, "at": TIME, "type": "succeeded", "data": {...}, "links": {"job": PATH}}
//
// Any answer from 200 to 299 takes it; redirections are not followed. Of an answer only the status
// is read, and each attempt has ten seconds (server/webhooks/bounded_post.h). An event may come
// twice, where the answer was lost. After a failure it is tried again after 1, 2, 4... seconds, at
// last every ten minutes; a webhook that has failed for a day is taken out of use.
#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "server/jobs/job_queue.h"
#include "server/webhooks/bounded_post.h"
#include "server/webhooks/webhooks.h"

namespace throng::server {

struct WebhookSenderOptions {
  std::chrono::milliseconds first_rest{1000};  ///< after a first failure; doubles with each
  std::chrono::milliseconds max_pause{600'000};
  std::chrono::milliseconds timeout{86'400'000};  ///< with a webhook that fails
  PostOptions post = {};                          ///< of each attempt
};

class WebhookSender {
 public:
  /// Those of the service's data folder; the queue must outlive it.
  WebhookSender(const JobQueue& queue, const std::filesystem::path& data,
                WebhookSenderOptions options = {});
  ~WebhookSender();
  WebhookSender(const WebhookSender&) = delete;
  WebhookSender& operator=(const WebhookSender&) = delete;

  Webhooks& webhooks() { return webhooks_; }
  /// Whether webhooks may lead to addresses that are not public (server/webhooks/public_address.h).
  bool allows_private() const { return options_.post.allow_private; }

  /// Ends what is being sent; nothing is sent any more.
  void stop();

  /// Takes note of webhooks that have come or gone.
  void refresh();

  /// Sends a ping at once and logs how that went; nothing when there is no such webhook.
  std::optional<Delivery> ping(const std::string& id);

 private:
  Delivery post(const Webhook& webhook, std::int64_t event, const std::string& type, int attempt,
                const std::string& body, const std::stop_token& stop) const;
  void serve(const std::string& id, const std::stop_token& stop);
  bool deliver_next(Webhook& webhook, const std::stop_token& stop);
  void rest(std::chrono::milliseconds duration, const std::stop_token& stop);

  const JobQueue& queue_;
  Webhooks webhooks_;
  WebhookSenderOptions options_;
  std::stop_source ending_;
  std::mutex mutex_;
  std::condition_variable_any stopped_;
  std::map<std::string, std::jthread> threads_;  ///< by webhook; guarded by mutex_
};

}  // namespace throng::server
