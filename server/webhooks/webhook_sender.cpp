#include "server/webhooks/webhook_sender.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/version.h"
#include "server/catalog/api_json.h"
#include "server/catalog/unix_time.h"

namespace throng::server {

using namespace std::chrono_literals;

namespace {

bool is_wanted(const Webhook& webhook, const std::string& type) {
  return std::any_of(webhook.events.begin(), webhook.events.end(),
                     [&](const std::string& event) { return event == "*" || event == type; });
}

std::string event_body(const jobs::EventRow& event) {
  nlohmann::json body = event_json(event);
  body["links"] = {{"job", "/v1/jobs/" + event.job}};
  return dump_text(body);
}

}  // namespace

WebhookSender::WebhookSender(const JobQueue& queue, const std::filesystem::path& data,
                             WebhookSenderOptions options)
    : queue_(queue), webhooks_(data), options_(options) {
  refresh();
}

WebhookSender::~WebhookSender() { stop(); }

void WebhookSender::stop() {
  ending_.request_stop();
  const std::lock_guard lock(mutex_);
  for (auto& [id, thread] : threads_) thread.request_stop();
}

Delivery WebhookSender::post(const Webhook& webhook, std::int64_t event, const std::string& type,
                             int attempt, const std::string& body,
                             const std::stop_token& stop) const {
  Delivery delivery{event, type, unix_ms_now(), attempt, 0, "", 0};
  const auto begun = std::chrono::steady_clock::now();
  constexpr std::int64_t kMsPerS = 1000;
  const PostHeaders headers = {
      {"User-Agent", std::string(kGenerator)},
      {"Content-Type", "application/json"},
      {"Throng-Event", type},
      {"Throng-Delivery", fmt::format("{}-{}", webhook.id, event)},
      {"Throng-Signature", sign_body(webhook.secret, delivery.at_ms / kMsPerS, body)}};
  PostResult result = bounded_post(webhook.url, headers, body, options_.post, stop);
  delivery.status = result.status;
  delivery.error = std::move(result.error);
  delivery.took_ms = std::chrono::duration_cast<std::chrono::milliseconds>(
                         std::chrono::steady_clock::now() - begun)
                         .count();
  const char* outcome = delivery.succeeded() ? "succeeded" : "failed";
  attempts_.add(prometheus_labels({{"outcome", outcome}}));
  return delivery;
}

void WebhookSender::refresh() {
  std::vector<std::string> wanted;
  for (const Webhook& webhook : webhooks_.list()) {
    if (webhook.enabled) wanted.push_back(webhook.id);
  }
  std::vector<std::jthread> ended;  // joined once the lock is free
  {
    const std::lock_guard lock(mutex_);
    for (auto thread = threads_.begin(); thread != threads_.end();) {
      if (std::find(wanted.begin(), wanted.end(), thread->first) != wanted.end()) {
        ++thread;
        continue;
      }
      thread->second.request_stop();
      ended.push_back(std::move(thread->second));
      thread = threads_.erase(thread);
    }
    for (const std::string& id : wanted) {
      if (threads_.contains(id)) continue;
      threads_.emplace(id,
                       std::jthread([this, id](const std::stop_token& stop) { serve(id, stop); }));
    }
  }
}

std::optional<Delivery> WebhookSender::ping(const std::string& id) {
  const auto webhook = webhooks_.get(id);
  if (!webhook) return std::nullopt;
  Delivery delivery = post(*webhook, 0, "ping", 1, R"({"type": "ping"})", ending_.get_token());
  // The result of a ping does not affect the waiting events.
  webhooks_.settle(*webhook, delivery);
  return delivery;
}

void WebhookSender::rest(std::chrono::milliseconds duration, const std::stop_token& stop) {
  std::mutex mutex;
  std::unique_lock lock(mutex);
  stopped_.wait_for(lock, stop, duration, [&] { return stop.stop_requested(); });
}

void WebhookSender::serve(const std::string& id, const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      auto webhook = webhooks_.get(id);
      if (!webhook || !webhook->enabled) {
        rest(1s, stop);  // refresh() will end this thread, or it is enabled again
        continue;
      }
      if (deliver_next(*webhook, stop)) continue;
      constexpr int kMaxDoublings = 20;
      rest(std::min(options_.max_pause,
                    options_.first_rest * (1 << std::min(webhook->failures - 1, kMaxDoublings))),
           stop);
    } catch (const std::exception& error) {
      spdlog::error("webhook {}: {}", id, error.what());
      rest(1s, stop);
    }
  }
}

bool WebhookSender::deliver_next(Webhook& webhook, const std::stop_token& stop) {
  constexpr int kPage = 100;
  constexpr auto kPatience = 500ms;  // also bounds how long it takes to end
  const std::int64_t before = webhook.after;
  for (const jobs::EventRow& event : queue_.events("", webhook.after, kPage, kPatience)) {
    if (stop.stop_requested()) return true;
    if (!is_wanted(webhook, event.type)) {
      webhook.after = event.seq;
      continue;
    }
    const Delivery delivery =
        post(webhook, event.seq, event.type, webhook.failures + 1, event_body(event), stop);
    // Broken off because the service ends: it did not fail.
    if (delivery.status == 0 && stop.stop_requested()) return true;
    if (delivery.succeeded()) {
      webhook.after = event.seq;
      webhook.failures = 0;
      webhook.failing_since_ms = 0;
      webhooks_.settle(webhook, delivery);
      continue;
    }
    ++webhook.failures;
    if (webhook.failing_since_ms == 0) webhook.failing_since_ms = delivery.at_ms;
    if (delivery.at_ms - webhook.failing_since_ms >= options_.timeout.count()) {
      webhook.enabled = false;
      spdlog::warn("webhook {}: out of use, it has failed for too long", webhook.id);
    }
    webhooks_.settle(webhook, delivery);
    return false;
  }
  if (webhook.after != before) webhooks_.settle(webhook, std::nullopt);
  return true;
}

}  // namespace throng::server
