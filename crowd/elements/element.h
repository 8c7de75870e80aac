// Access to the elements of a description, with errors that name file, line and element.
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

/// An element of a description while a simulation is created from it: its name, attributes and
/// children, and the reporting of errors and warnings. A view, valid as long as its Reading.
class Element {
 public:
  Element(const Node& node, Reading& reading) : node_(&node), reading_(&reading) {}

  std::string_view name() const;
  std::vector<Element> children() const;
  std::vector<std::pair<std::string_view, std::string_view>> attributes() const;
  std::optional<std::string_view> attribute(std::string_view name) const;

  /// Whether the words true and false both mean 0 in this file: see Reading.
  bool words_are_zero() const;

  /// Returns the only child. Fails with `expected` unless there is exactly one.
  Element only_child(std::string_view expected) const;
  /// Fails if the element has child elements.
  void require_no_children() const;

  /// Throws an InputError with the position of this element: file and line, or the path of an
  /// element that was built in code.
  [[noreturn]] void fail(std::string found, std::string expected) const;
  [[noreturn]] void fail_attribute(std::string_view attribute, std::string found,
                                   std::string expected) const;
  /// The problem that fail_attribute() throws.
  Problem attribute_problem(std::string_view attribute, std::string found,
                            std::string expected) const;
  /// Throws for an element that is not allowed here; `expected` lists the allowed ones.
  [[noreturn]] void fail_unknown(std::string expected) const;

  /// Records a warning: a part is ignored or probably a mistake.
  void warn(std::string found, std::string expected) const;
  void warn_attribute(std::string_view attribute, std::string found, std::string expected) const;

  /// Resolves a file name against the folder of the description; backslashes separate folders, too.
  std::filesystem::path file_beside(std::string_view file_name) const;
  /// The same of a file that has to be there. Fails with the folder that was looked in.
  std::filesystem::path existing_file(std::string_view file_name) const;
  /// Returns a text file of the description's folder or of Description::files. Fails like
  /// existing_file().
  TextFile text_file(std::string_view file_name) const;

 private:
  Problem problem(std::string found, std::string expected) const;
  void add_warning(Problem warning) const;

  const Node* node_;
  Reading* reading_;
};

/// The creation of a simulation from a description: collects warnings and provides the root
/// element. Does not change the description, so several simulations may be created from it at the
/// same time.
class Reading {
 public:
  /// The description must outlive this object. `words_are_zero`: "true" and "false" mean 0, as
  /// Menge reads them where it expects a number. Throws InputError if the root has another name.
  Reading(const Description& description, std::string_view root_name, bool words_are_zero = false);
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  Element root() { return {description_->root, *this}; }
  const std::vector<Problem>& warnings() const { return warnings_; }

 private:
  friend class Element;

  const Description* description_;
  bool words_are_zero_;
  std::vector<Problem> warnings_;  ///< ignored parts
};

/// Returns a text from a file in quotes, shortened and with unprintable characters replaced.
std::string in_quotes(std::string_view text);

}  // namespace throng::crowd
