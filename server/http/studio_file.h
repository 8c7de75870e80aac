// A file of Studio, as the build embeds it (web/studio/build.mjs). Without other headers: its table
// is compiled by itself.
#pragma once

#include <string_view>

namespace throng::server {

/// A file of the page.
struct StudioFile {
  std::string_view name;  ///< "index.DEPTH.html", or with a hash of its content: "main-4K2VXQ7A.js"
  std::string_view type;  ///< media type
  std::string_view etag;  ///< including its quotes
  std::string_view bytes;
  std::string_view gzip;  ///< the same bytes, compressed by gzip
};

}  // namespace throng::server
