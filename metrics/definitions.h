// The paragraphs of docs/metrics.md that define the values of metrics.json. The document is built
// in.
#pragma once

#include <string>
#include <vector>

namespace throng::metrics {

struct Definition {
  /// Values that it defines, as paths in metrics.json: "people", "exits[].net_out".
  std::vector<std::string> paths;
  std::string anchor;  ///< of the paragraph in the document
  std::string text;    ///< without links and markup
};

/// Those of a run, in the document's order.
const std::vector<Definition>& definitions_of_run();

/// "docs/metrics.md#ANCHOR".
std::string anchor_address(const Definition& definition);

/// The definition of the value, or of the nearest object that holds it. Null if there is none.
const Definition* find_definition(const std::string& path);

}  // namespace throng::metrics
