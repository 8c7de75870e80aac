#include "server/api/keys_api.h"
#include "server/routes/resources.h"

namespace throng::server {

std::vector<Route> key_routes() {
  return tagged(
      "keys",
      {on_post(
           "/v1/keys", Scope::admin, &create_key,
           {.summary = "Create a key (administrators); `throng keys create` makes the first one",
            .help = "The answer is 403 before the first key.",
            .body = json_body(closed(
                {{"name", "string", "Name of the key's owner, for lists."},
                 {"scope?", with_default(enumeration(Scope::read, Scope::admin), "submit")},
                 {"max_jobs?", "integer?",
                  "Maximum number of jobs that wait or run at once; null: any number."},
                 {"max_bytes?", "integer?", "Maximum disk space of all the key's jobs; null: any."},
                 {"max_priority?", "integer",
                  "Maximum priority of the key's jobs, from -100 to 100."},
                 {"expires_at?", "string?",
                  "When the key expires: a date (from 00:00 UTC on), a time by RFC 3339, or a "
                  "duration from now: 2027-01-31, 2027-01-31T12:00:00Z, 30d, 12h, 2w; null: never. "
                  "From then on its callers get 401; what it has queued or running goes on."}})),
            .answers = {created("The key; `key` is in this answer only.", "Key")}}),
       on_get("/v1/keys", Scope::admin, &list_keys,
              {.summary = "List keys (administrators)",
               .answers = {ok("The complete list, oldest first, without secrets.", "KeyList")}}),
       on_delete(
           "/v1/keys/{id}", Scope::admin, &revoke_key,
           {.summary = "Revoke a key at once (administrators)",
            .help =
                "The key that makes the request is not revoked (409). Its queued and running "
                "jobs, calibrations and studies are cancelled and its live flights end; `ended` "
                "counts them. `throng keys revoke` does so within seconds where a service runs.",
            .answers = {ok("The revoked key.", "Key")},
            .problems = {409}})});
}

}  // namespace throng::server
