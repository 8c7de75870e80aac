#include "server/access/keys.h"
#include "server/routes/resources.h"

namespace throng::server {

std::vector<NamedSchema> access_schemas() {
  return {
      {"Key",
       closed(
           {{"id", "string"},
            {"name", "string"},
            {"scope", enumeration(Scope::read, Scope::admin)},
            {"ended?", object({{"jobs", "integer"}, {"live_flights", "integer"}}),
             "In the answer to its revocation: what the key had under way, which was cancelled."},
            {"max_jobs", "integer?",
             "Maximum number of jobs that wait or run at once; null: any number."},
            {"max_bytes", "integer?", "Maximum disk space of all the key's jobs; null: any."},
            {"max_priority", "integer", "Maximum priority of the key's jobs, from -100 to 100."},
            {"created_at", "time?"},
            {"revoked_at", "time?", "Time when the key was revoked; null: it is valid."},
            {"expires_at", "time?",
             "Time from which on callers with the key get 401; null: never."},
            {"key?", "string",
             "The key itself, which callers send; only in the answer to its creation."},
            {"links", links()}})},
      {"KeyList", object({{"keys", "Key[]"}})},
      {"Webhook",
       closed({{"id", "string"},
               {"url", "string"},
               {"events", "string[]"},
               {"enabled", "boolean",
                "Whether it is in use; it goes out of use after failing for a day."},
               {"created_at", "time?"},
               {"delivered_up_to", "integer", "Number of the last event that is settled."},
               {"failures", "integer", "Number of failures in a row."},
               {"failing_since", "time?"},
               {"secret?", "string",
                "Secret that signs deliveries; only in the answer to its creation."},
               {"links", object({{"self", "string"}, {"deliveries", "string"}})}})},
      {"WebhookList", closed({{"webhooks", "Webhook[]"}})},
      {"Delivery", closed({{"event", "integer", "Number of the event; 0 for a ping."},
                           {"type", "string"},
                           {"at", "time?"},
                           {"attempt", "integer"},
                           {"status", "integer?"},
                           {"error", "string?"},
                           {"took_ms", "integer"},
                           {"succeeded", "boolean"}})},
      {"DeliveryList", closed({{"deliveries", "Delivery[]"}})},
      {"Session",
       object({{"needs_key", "boolean", "Whether callers need a key."},
               {"scope", "string?",
                "Scope of the caller: read, submit or admin; null without a valid key."}})}};
}

}  // namespace throng::server
