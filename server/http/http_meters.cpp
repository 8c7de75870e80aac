#include "server/http/http_meters.h"

#include <algorithm>
#include <array>

namespace throng::server {

void HttpMeters::note(std::string_view route, const std::string& method, int status,
                      double seconds) {
  constexpr std::string_view kApi = "/v1/";
  constexpr std::array<std::string_view, 4> kOther = {"/healthz", "/readyz", "/metrics",
                                                      "/openapi.json"};
  std::string_view group = route.empty() ? "other" : "studio";
  if (route.starts_with(kApi)) {
    group = route.substr(kApi.size(), route.find('/', kApi.size()) - kApi.size());
  } else if (std::find(kOther.begin(), kOther.end(), route) != kOther.end()) {
    group = route.substr(1);
  }
  constexpr int kOk = 200;  // what the library sends where a handler sets no status
  requests_.add(prometheus_labels({{"route", group},
                                   {"method", method},
                                   {"status", std::to_string(status < 0 ? kOk : status)}}));
  seconds_.add(prometheus_labels({{"route", group}}), seconds);
}

}  // namespace throng::server
