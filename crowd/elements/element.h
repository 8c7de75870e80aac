// Reading descriptions so that everything wrong is reported with its file, line and element.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "crowd/description/description.h"
#include "crowd/elements/text_file.h"

namespace throng::crowd {

class Reading;

/// An element while a simulation is made from its description: what a reader of elements asks, and
/// where it says what is wrong. A view, valid as long as its Reading.
class Element {
 public:
  Element(const Node& node, Reading& reading) : node_(&node), reading_(&reading) {}

  std::string_view name() const;
  std::vector<Element> children() const;
  std::vector<std::pair<std::string_view, std::string_view>> attributes() const;
  std::optional<std::string_view> attribute(std::string_view name) const;

  /// Whether the words true and false are both 0 in this file.
  bool words_are_zero() const;

  /// The only child, which must be there. `expected` names it in the error.
  Element only_child(std::string_view expected) const;
  /// Throws unless the element has no child elements.
  void require_no_children() const;

  /// Throw an InputError that says where this element stands: file and line, or which of the
  /// elements it is that were built in code.
  [[noreturn]] void fail(std::string found, std::string expected) const;
  [[noreturn]] void fail_attribute(std::string_view attribute, std::string found,
                                   std::string expected) const;
  /// For an element that does not belong here; `expected` lists those that do.
  [[noreturn]] void fail_unknown(std::string expected) const;

  /// Notes that something is ignored, or surely not meant.
  void warn(std::string found, std::string expected) const;
  void warn_attribute(std::string_view attribute, std::string found, std::string expected) const;

  /// The file that an attribute names, relative to the description's folder.
  std::filesystem::path file_beside(std::string_view file_name) const;
  /// The same for a text file, which may also be one of Description::files.
  TextFile text_file(std::string_view file_name) const;

 private:
  Problem problem(std::string found, std::string expected) const;
  void add_warning(Problem warning) const;
  Problem attribute_problem(std::string_view attribute, std::string found,
                            std::string expected) const;

  const Node* node_;
  Reading* reading_;
};

/// The making of something from a description, which stays as it is: several simulations may be
/// made from one at the same time.
class Reading {
 public:
  /// `words_are_zero`: "true" and "false" are both 0, as Menge reads them where it expects a
  /// number. Throws InputError when the root is another element.
  Reading(const Description& description, std::string_view root_name, bool words_are_zero = false);
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  Element root() { return {description_->root, *this}; }
  const std::vector<Problem>& warnings() const { return warnings_; }

 private:
  friend class Element;

  const Description* description_;
  bool words_are_zero_;
  std::vector<Problem> warnings_;  ///< what was ignored
};

/// Text from a file in quotes, made printable and short enough for a message.
std::string in_quotes(std::string_view text);

}  // namespace throng::crowd
