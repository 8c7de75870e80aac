// Everything that the files may say, from the very tables that read them: for `throng crowd --list`
// and the documentation.
#pragma once

#include <string>
#include <vector>

namespace throng::crowd {

struct VocabularyAttribute {
  std::string name;  ///< "dist ..." stands for the attributes of a distribution
  std::string type;  ///< "number", "one of linear, quadratic", ...
  bool required = false;
  std::string default_text = {};  ///< "" when there is none
  std::string range = {};         ///< "0 to 100", "" when there is none worth saying
  std::string help;
};

struct VocabularyEntry {
  std::string name;  ///< the value of `type`, or an element
  std::string help;
  std::vector<VocabularyAttribute> attributes;
};

/// The elements of one plug-in point.
struct VocabularyKind {
  std::string title;    ///< "Conditions"
  std::string element;  ///< where they stand: "<Condition> in <Transition>"
  std::vector<VocabularyEntry> entries;
};

/// In the order of the files: project, scene, behavior.
std::vector<VocabularyKind> vocabulary();

}  // namespace throng::crowd
