#include "server/api/requests.h"
#include "server/api/webhooks_api.h"
#include "server/routes/resources.h"

namespace throng::server {

std::vector<Route> webhook_routes() {
  return tagged(
      "webhooks",
      {on_post(
           "/v1/webhooks", Scope::admin, &create_webhook,
           {.summary = "Create a webhook: an address that receives events (administrators)",
            .body = json_body(closed(
                {{"url", "string"},
                 {"events?", at_least_one("string"),
                  "Types of events, or [\"*\"]; default: the ends of jobs."},
                 {"secret?", "string", "Secret that signs deliveries; default: a random one."}})),
            .answers = {created("The webhook as created; it receives events from now on.",
                                "Webhook")},
            .problems = {409}}),
       on_get("/v1/webhooks", Scope::admin, &list_webhooks,
              {.summary = "List webhooks", .answers = {ok("The complete list.", "WebhookList")}}),
       on_get(
           "/v1/webhooks/{id}", Scope::admin, &send_webhook,
           {.summary = "Get a webhook", .answers = {ok("The state of the webhook.", "Webhook")}}),
       on_patch("/v1/webhooks/{id}", Scope::admin, &change_webhook,
                {.summary = "Take a webhook into or out of use",
                 .body = json_body(closed({{"enabled", "boolean"}})),
                 .answers = {ok("The state of the webhook.", "Webhook")}}),
       on_delete("/v1/webhooks/{id}", Scope::admin, &remove_webhook,
                 {.summary = "Remove a webhook", .answers = {done("It has been removed.")}}),
       on_get("/v1/webhooks/{id}/deliveries", Scope::admin, &list_deliveries,
              {.summary = "Deliveries, newest first",
               .parameters = {{"limit", fields::integers(1, kMaxPageRows),
                               "Maximum number of entries.", kUsualPageRows}},
               .answers = {ok("Attempts, including those that failed.", "DeliveryList")}}),
       on_post("/v1/webhooks/{id}/ping", Scope::admin, &ping_webhook,
               {.summary = "Send a ping now",
                .answers = {ok("The outcome of the ping.", "Delivery")}})});
}

}  // namespace throng::server
