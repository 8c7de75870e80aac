// Reading XML so that everything wrong is reported with its file, line and element.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace throng::crowd {

/// Where elements come from, and what was odd about them.
struct XmlSource {
  std::filesystem::path path;
  std::string name;               ///< of the file, for messages
  std::vector<Problem> warnings;  ///< what was ignored
  bool words_are_zero = false;    ///< "true" is 0, as for who expects a number: Menge
};

/// A view of one element; valid as long as its XmlFile.
class Element {
 public:
  Element(const tinyxml2::XMLElement* node, XmlSource* source) : node_(node), source_(source) {}

  std::string_view name() const;
  std::vector<Element> children() const;
  std::vector<std::pair<std::string_view, std::string_view>> attributes() const;
  std::optional<std::string_view> attribute(std::string_view name) const;

  /// Whether the words true and false are both 0 in this file.
  bool words_are_zero() const { return source_->words_are_zero; }

  /// The only child, which must be there. `expected` names it in the error.
  Element only_child(std::string_view expected) const;
  /// Throws unless the element has no child elements.
  void require_no_children() const;

  /// Throw an InputError that says where this element stands.
  [[noreturn]] void fail(std::string found, std::string expected) const;
  [[noreturn]] void fail_attribute(std::string_view attribute, std::string found,
                                   std::string expected) const;
  /// For an element that does not belong here; `expected` lists those that do.
  [[noreturn]] void fail_unknown(std::string expected) const;

  /// Notes that something is ignored, or surely not meant.
  void warn(std::string found, std::string expected) const;
  void warn_attribute(std::string_view attribute, std::string found, std::string expected) const;

  /// The file that an attribute names: relative to the one that this element stands in.
  std::filesystem::path file_beside(std::string_view file_name) const;

 private:
  Problem problem(std::string found, std::string expected) const;
  void add_warning(Problem warning) const;
  Problem attribute_problem(std::string_view attribute, std::string found,
                            std::string expected) const;

  const tinyxml2::XMLElement* node_;
  XmlSource* source_;
};

/// A parsed XML file.
class XmlFile {
 public:
  /// Throws EnvironmentError when the file cannot be read, InputError when it is not well-formed
  /// or its root is another element.
  XmlFile(const std::filesystem::path& path, std::string_view root_name);
  ~XmlFile();

  Element root() const;
  const std::vector<Problem>& warnings() const { return source_->warnings; }
  void take_words_for_zero() { source_->words_are_zero = true; }

 private:
  std::unique_ptr<XmlSource> source_;
  std::unique_ptr<tinyxml2::XMLDocument> document_;
};

/// Text from a file in quotes, made printable and short enough for a message.
std::string in_quotes(std::string_view text);

}  // namespace throng::crowd
