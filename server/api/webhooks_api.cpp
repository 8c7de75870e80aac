#include "server/api/webhooks_api.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <string_view>

#include "server/api/requests.h"
#include "server/catalog/api_json.h"
#include "server/http/http.h"
#include "server/jobs/job_queue.h"
#include "server/webhooks/webhook_sender.h"

namespace throng::server {

using httplib::Request;
using httplib::Response;
using nlohmann::json;

namespace {

constexpr const char* kWebhookNoun = "webhook";
constexpr std::size_t kMaxWebhooks = 32;  // each has a thread of its own
constexpr std::size_t kMaxUrlLength = 2000;
constexpr std::size_t kMaxEvents = 32;
constexpr std::size_t kMaxSecretLength = 200;

json webhook_json(const Webhook& webhook) {
  return {{"id", webhook.id},
          {"url", webhook.url},
          {"events", webhook.events},
          {"enabled", webhook.enabled},
          {"created_at", time_json(webhook.created_ms)},
          {"delivered_up_to", webhook.after},
          {"failures", webhook.failures},
          {"failing_since", time_json(webhook.failing_since_ms)},
          {"links",
           {{"self", "/v1/webhooks/" + webhook.id},
            {"deliveries", fmt::format("/v1/webhooks/{}/deliveries", webhook.id)}}}};
}

json delivery_json(const Delivery& delivery) {
  return {{"event", delivery.event},
          {"type", delivery.type},
          {"at", time_json(delivery.at_ms)},
          {"attempt", delivery.attempt},
          {"status", delivery.status == 0 ? json(nullptr) : json(delivery.status)},
          {"error", delivery.error.empty() ? json(nullptr) : json(delivery.error)},
          {"took_ms", delivery.took_ms},
          {"succeeded", delivery.succeeded()}};
}

Webhook find_webhook(WebhookSender& hooks, const Request& request) {
  const std::string id = request.matches[1];
  auto webhook = hooks.webhooks().get(id);
  if (!webhook) throw HttpError{404, fmt::format("there is no webhook {}", id)};
  return *webhook;
}

HttpError invalid_field(const std::string& pointer, const std::string& found,
                        const std::string& expected) {
  return wrong_field(kWebhookNoun, pointer, found, expected);
}

/// A host, optionally a port and a path, no user or blank: what can be called.
bool is_url(const std::string& url) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (!url.starts_with(scheme) || url.size() > kMaxUrlLength) continue;
    const std::string rest = url.substr(scheme.size());
    return !rest.empty() && rest[0] != '/' && rest[0] != ':' &&
           std::none_of(rest.begin(), rest.end(),
                        [](unsigned char c) {
                          return c <= ' ' || c >= 127 || c == '@' || c == '\\' || c == '#';
                        }) &&
           is_callable_url(url);
  }
  return false;
}

std::string text_at(const json& body, const char* name, const std::string& otherwise) {
  if (!body.contains(name)) return otherwise;
  if (!body[name].is_string())
    throw invalid_field(fmt::format("/{}", name), body[name].dump(), "a text");
  return body[name];
}

std::vector<std::string> read_event_names(const json& body) {
  if (!body.contains("events")) return {"succeeded", "partial", "failed", "cancelled"};
  const json& list = body["events"];
  const bool is_list =
      list.is_array() && !list.empty() && list.size() <= kMaxEvents &&
      std::all_of(list.begin(), list.end(), [](const json& event) { return event.is_string(); });
  if (!is_list) {
    throw invalid_field("/events", list.dump(), "a list of types of events, or [\"*\"] for all");
  }
  return list.get<std::vector<std::string>>();
}

}  // namespace

void create_webhook(JobQueue& queue, WebhookSender& hooks, const Request& request,
                    Response& response) {
  const json body = json_fields(request, kWebhookNoun, {"url", "events", "secret"});
  const std::string url = text_at(body, "url", "");
  if (!is_url(url)) {
    throw invalid_field("/url", '"' + url + '"', "an address such as https://example.org/hook");
  }
  if (!hooks.allows_private() && names_private_address(url)) {
    throw invalid_field("/url", '"' + url + '"',
                        "a public address (throng serve --webhook-private allows others)");
  }
  const std::string secret = text_at(body, "secret", "");
  if (secret.size() > kMaxSecretLength) {
    throw invalid_field("/secret", fmt::format("{} characters", secret.size()),
                        fmt::format("at most {}", kMaxSecretLength));
  }
  Webhooks& webhooks = hooks.webhooks();
  if (webhooks.list().size() >= kMaxWebhooks) {
    throw HttpError{409, fmt::format("there may be {} webhooks: remove one", kMaxWebhooks)};
  }
  const Webhook webhook = webhooks.create(url, read_event_names(body), secret, queue.last_event());
  hooks.refresh();
  json answer = webhook_json(webhook);
  answer["secret"] = webhook.secret;  // this once
  response.set_header("Location", "/v1/webhooks/" + webhook.id);
  write_json(response, 201, answer);
}

void list_webhooks(WebhookSender& hooks, Response& response) {
  json list = json::array();
  for (const Webhook& webhook : hooks.webhooks().list()) list.push_back(webhook_json(webhook));
  write_json(response, 200, {{"webhooks", std::move(list)}});
}

void send_webhook(WebhookSender& hooks, const Request& request, Response& response) {
  write_json(response, 200, webhook_json(find_webhook(hooks, request)));
}

void change_webhook(JobQueue& queue, WebhookSender& hooks, const Request& request,
                    Response& response) {
  const std::string id = find_webhook(hooks, request).id;
  const json body = json_fields(request, kWebhookNoun, {"enabled"});
  if (!body.contains("enabled") || !body["enabled"].is_boolean()) {
    throw invalid_field("/enabled", body.value("enabled", json(nullptr)).dump(), "true or false");
  }
  hooks.webhooks().enable(id, body["enabled"], queue.last_event());
  hooks.refresh();
  write_json(response, 200, webhook_json(find_webhook(hooks, request)));
}

void remove_webhook(WebhookSender& hooks, const Request& request, Response& response) {
  hooks.webhooks().remove(find_webhook(hooks, request).id);
  hooks.refresh();
  response.status = 204;
}

void list_deliveries(WebhookSender& hooks, const Request& request, Response& response) {
  json list = json::array();
  for (const Delivery& delivery :
       hooks.webhooks().deliveries(find_webhook(hooks, request).id, requested_limit(request))) {
    list.push_back(delivery_json(delivery));
  }
  write_json(response, 200, {{"deliveries", std::move(list)}});
}

void ping_webhook(WebhookSender& hooks, const Request& request, Response& response) {
  const auto delivery = hooks.ping(find_webhook(hooks, request).id);
  if (!delivery) throw HttpError{404, "the webhook has been removed"};
  write_json(response, 200, delivery_json(*delivery));
}

}  // namespace throng::server
