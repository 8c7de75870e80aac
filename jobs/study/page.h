// HTML pages with charts, each one file that needs nothing else.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "base/text/markup.h"

namespace throng::study {

struct Page {
  std::string title;  ///< plain text
  std::string style;  ///< CSS beyond that of all pages
  std::string body;   ///< HTML
};

/// The page with the charts of web/report.js, drawn in the browser from `figures` wherever the body
/// has chart_frame()s. Its policy lets it fetch nothing and run no script but its own. Without
/// scripts, all but the charts is there.
std::string page_html(const Page& page, const nlohmann::json& figures);

/// Placeholder of a chart. `data` are attributes that select it: name="value", separated by blanks.
std::string chart_frame(const std::string& title, const std::string& data);

/// For figures of a page: as near as a chart can show, in few characters. NaN and infinities
/// become null.
nlohmann::json rounded(double value, int decimals = 3);

}  // namespace throng::study
