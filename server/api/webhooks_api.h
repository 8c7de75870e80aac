// Routes of webhooks and their delivery log. For administrators only, because the server calls the
// addresses that they choose.
#pragma once

#include "server/api/request_context.h"
#include "server/http/http_fwd.h"

namespace throng::server {

void create_webhook(const RequestContext& context, const httplib::Request& request,
                    httplib::Response& response);
void list_webhooks(const RequestContext& context, const httplib::Request& request,
                   httplib::Response& response);
void send_webhook(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);
void change_webhook(const RequestContext& context, const httplib::Request& request,
                    httplib::Response& response);
void remove_webhook(const RequestContext& context, const httplib::Request& request,
                    httplib::Response& response);
void list_deliveries(const RequestContext& context, const httplib::Request& request,
                     httplib::Response& response);
/// Sends a ping now and responds with the result.
void ping_webhook(const RequestContext& context, const httplib::Request& request,
                  httplib::Response& response);

}  // namespace throng::server
