// Self-contained HTML pages with charts.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/text/markup.h"

namespace throng::study {

/// Parts of a page.
struct Page {
  std::string title;  ///< plain text
  std::string style;  ///< CSS beyond that of all pages
  std::string body;   ///< HTML
};

/// The page as one HTML file. Its script, web/report.js, draws a chart from `figures` at each
/// chart_frame() of the body. The content security policy forbids all other scripts and all
/// requests. Without scripts, only the charts are missing.
std::string page_html(const Page& page, const nlohmann::json& figures);

/// Placeholder of a chart. `data` are attributes that select it: name="value", separated by blanks.
std::string chart_frame(const std::string& title, const std::string& data);

/// A number rounded for the charts of a page; null for NaN and infinities.
nlohmann::json rounded(double value, int decimals = 3);

}  // namespace throng::study
