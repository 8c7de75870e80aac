// The vocabulary of project, scene and behavior files, taken from the tables that the readers use.
// For `throng crowd --list` and the documentation.
#pragma once

#include <string>
#include <vector>

namespace throng::crowd {

/// An attribute of an element.
struct VocabularyAttribute {
  std::string name;  ///< "dist ..." for the attributes of a distribution
  std::string type;  ///< "number", "one of linear, quadratic", ...
  bool required = false;
  std::string default_text = {};  ///< empty if there is no default
  std::string range = {};         ///< e.g. "0 to 100"; empty if unlimited in practice
  std::string help;
};

/// A type of element, or an element without types.
struct VocabularyEntry {
  std::string name;  ///< value of the attribute `type`, or name of the element
  std::string help;
  std::vector<VocabularyAttribute> attributes;
};

/// All entries of one kind of element.
struct VocabularyKind {
  std::string title;    ///< "Conditions"
  std::string element;  ///< position in the file, e.g. "<Condition> in <Transition>"
  std::vector<VocabularyEntry> entries;
};

/// Returns all kinds of elements in the order of the files: project, scene, behavior.
std::vector<VocabularyKind> vocabulary();

}  // namespace throng::crowd
