#include "study/page.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/hash.h"

namespace throng::embedded {
extern const std::string_view kReportScript;
}  // namespace throng::embedded

namespace throng::study {

namespace {

constexpr const char* kPageStyle =
    "body{font-family:sans-serif;max-width:72em;margin:2em auto;padding:0 1em;color:#222}"
    "table{display:block;overflow-x:auto;border-collapse:collapse;margin:1em 0;font-size:13px}"
    "td,th{border:1px solid #ccc;padding:3px 7px;text-align:right;vertical-align:top}"
    "th{background:#f3f3f3}td:first-child,.text{text-align:left}label{margin-right:1em}"
    "figure{margin:1.5em 0;break-inside:avoid}figcaption{font-weight:bold;margin-bottom:.3em}"
    ".hint{color:#555;font-size:13px}"
    "@media print{body{margin:0;max-width:none}table{display:table;overflow:visible;font-size:10px}"
    "h2,h3{break-after:avoid}tr{break-inside:avoid}.hint,input[type=radio],label{display:none}}";

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

std::string html_of(const Page& page, const nlohmann::json& figures) {
  const std::string_view script = embedded::kReportScript;
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
      "<meta name=\"viewport\" content=\"width=device-width\">"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; "
      "script-src 'sha256-{0}'; style-src 'unsafe-inline'; img-src data:; base-uri 'none'; "
      "form-action 'none'\"><title>{1}</title><style>{2}{3}</style></head><body>\n{4}"
      "<script type=\"application/json\" id=\"figures\">{5}</script>\n"
      "<script>{6}</script>\n</body></html>\n",
      sha256_base64(script), escaped_markup(page.title), kPageStyle, page.style, page.body,
      inert(figures), script);
}

std::string chart_frame(const std::string& title, const std::string& data) {
  return fmt::format(
      "<figure><figcaption>{}</figcaption><div {}><noscript>The chart needs "
      "JavaScript.</noscript></div></figure>\n",
      escaped_markup(title), data);
}

std::string escaped_markup(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

nlohmann::json rounded(double value, int decimals) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10, decimals);
  return std::round(value * scale) / scale;
}

}  // namespace throng::study
