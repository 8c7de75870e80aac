// Delivery of events to webhooks: in order, each repeated until it is accepted, for at most a day.
//
//   POST URL
//   Throng-Event: succeeded
//   Throng-Delivery: WEBHOOK-SEQ          the same for every attempt
//   Throng-Signature: t=SECONDS,v1=HEX    server/webhooks/webhooks.h
//   {"seq": 17, "job": ID, "at": TIME, "type": "succeeded", "data": {...}, "links": {"job": PATH}}
//
// A status from 200 to 299 accepts the event; redirections are not followed. Only the status of a
// response is read, and each attempt is limited to ten seconds (server/webhooks/bounded_post.h). An
// event may be delivered twice if a response was lost. Failed attempts are repeated after 1,
// 2, 4... seconds, at last every ten minutes; a webhook that has failed for a day is disabled.
#pragma once

#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

#include "base/text/prometheus.h"
#include "server/jobs/job_queue.h"
#include "server/webhooks/bounded_post.h"
#include "server/webhooks/webhooks.h"

namespace throng::server {

struct WebhookSenderOptions {
  std::chrono::milliseconds first_rest{1000};     ///< pause after a failure; doubles with each
  std::chrono::milliseconds max_pause{600'000};   ///< max pause between attempts
  std::chrono::milliseconds timeout{86'400'000};  ///< time of failures until it is disabled
  PostOptions post = {};                          ///< options of each attempt
};

/// Delivers events in one thread per webhook. Safe to use from many threads.
class WebhookSender {
 public:
  /// Opens the webhooks in the folder `data`. The queue must outlive this object.
  WebhookSender(const JobQueue& queue, const std::filesystem::path& data,
                WebhookSenderOptions options = {});
  ~WebhookSender();
  WebhookSender(const WebhookSender&) = delete;
  WebhookSender& operator=(const WebhookSender&) = delete;

  Webhooks& webhooks() { return webhooks_; }
  /// Whether webhooks may have addresses that are not public (server/webhooks/public_address.h).
  bool allows_private() const { return options_.post.allow_private; }

  /// Metrics of the attempts to deliver events.
  std::string attempts() const { return attempts_.text(); }

  /// Cancels current deliveries and prevents further ones.
  void stop();

  /// Starts and stops deliveries after webhooks were created, changed or removed.
  void refresh();

  /// Sends a ping at once and logs the attempt; std::nullopt if there is no such webhook.
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
  mutable PrometheusMeter attempts_{"throng_webhook_deliveries_total",
                                    "Attempts to deliver events, by outcome."};
  std::stop_source ending_;
  std::mutex mutex_;
  std::condition_variable_any stopped_;
  std::map<std::string, std::jthread> threads_;  ///< by webhook; guarded by mutex_
};

}  // namespace throng::server
