// Routes of webhooks and their delivery log. For administrators only, because the server calls the
// addresses that they choose.
#pragma once

#include "server/api/service_parts.h"
#include "server/http/http_fwd.h"

namespace throng::server {

void create_webhook(JobQueue& queue, WebhookSender& hooks, const httplib::Request& request,
                    httplib::Response& response);
void list_webhooks(WebhookSender& hooks, httplib::Response& response);
void send_webhook(WebhookSender& hooks, const httplib::Request& request,
                  httplib::Response& response);
void change_webhook(JobQueue& queue, WebhookSender& hooks, const httplib::Request& request,
                    httplib::Response& response);
void remove_webhook(WebhookSender& hooks, const httplib::Request& request,
                    httplib::Response& response);
void list_deliveries(WebhookSender& hooks, const httplib::Request& request,
                     httplib::Response& response);
/// Sends a ping now and responds with the result.
void ping_webhook(WebhookSender& hooks, const httplib::Request& request,
                  httplib::Response& response);

}  // namespace throng::server
