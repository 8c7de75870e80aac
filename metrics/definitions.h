// The paragraphs of docs/metrics.md that define the values of metrics.json. The document is
// embedded in the program.
#pragma once

#include <string>
#include <vector>

namespace throng::metrics {

/// A paragraph of the document.
struct Definition {
  /// Values that the paragraph defines, as paths in metrics.json: "people", "exits[].net_out".
  std::vector<std::string> paths;
  std::string anchor;  ///< anchor of the paragraph in the document
  std::string text;    ///< the paragraph without links and markup
};

/// All definitions for a run, in the document's order.
const std::vector<Definition>& definitions_of_run();

/// "docs/metrics.md#ANCHOR".
std::string anchor_address(const Definition& definition);

/// The definition of the value at a path of metrics.json, or of the innermost object that contains
/// it; null if there is none.
const Definition* find_definition(const std::string& path);

}  // namespace throng::metrics
