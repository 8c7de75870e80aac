#include "jobs/study/page.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/files/hash.h"

namespace throng::embedded {
extern const std::string_view kReportScript;
extern const std::string_view kReportStyle;
}  // namespace throng::embedded

namespace throng::study {

namespace {

/// JSON that cannot end the element it stands in.
std::string inert(const nlohmann::json& value) {
  std::string safe;
  for (const char c : value.dump()) {
    if (c == '<') {
      safe += "\\u003c";
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace

std::string page_html(const Page& page, const nlohmann::json& figures) {
  const std::string_view script = embedded::kReportScript;
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\" data-theme=\"light\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "script-src 'sha256-{0}'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; "
      "form-action 'none'\"><title>{1}</title><style>{2}{3}</style></head><body>\n{4}"
      "<script type=\"application/json\" id=\"figures\">{5}</script>\n"
      "<script>{6}</script>\n</body></html>\n",
      sha256_base64(script), escaped_markup(page.title), embedded::kReportStyle, page.style,
      page.body, inert(figures), script);
}

std::string chart_frame(const std::string& title, const std::string& data) {
  return fmt::format(
      "<figure><figcaption>{}</figcaption><div {}><noscript>The chart needs "
      "JavaScript.</noscript></div></figure>\n",
      escaped_markup(title), data);
}

nlohmann::json rounded(double value, int decimals) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10, decimals);
  return std::round(value * scale) / scale;
}

}  // namespace throng::study
