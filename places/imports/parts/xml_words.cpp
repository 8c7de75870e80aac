#include "places/imports/parts/xml_words.h"

#include <expat.h>
#include <tinyxml2.h>

namespace throng::imports {

namespace {

constexpr const char* kNoTag = "text that is no tag of XML";
constexpr const char* kNoMatch = "a start tag and an end tag that do not match";
constexpr const char* kEarlyEnd = "a text that ends too early";

}  // namespace

std::string tinyxml_fault(int error) {
  switch (error) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "an empty text";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return kNoMatch;
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute without a value in quotes, or the same attribute twice";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment that does not end";
    case tinyxml2::XML_ERROR_PARSING_CDATA:
    case tinyxml2::XML_ERROR_PARSING_DECLARATION:
    case tinyxml2::XML_ERROR_PARSING_UNKNOWN:
      return "a section that does not end";
    case tinyxml2::XML_ERROR_PARSING_TEXT:
    case tinyxml2::XML_ERROR_PARSING:
      return kEarlyEnd;
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements nested too deep";
    default:
      return kNoTag;
  }
}

std::string expat_fault(int error) {
  switch (error) {
    case XML_ERROR_NO_ELEMENTS:
    case XML_ERROR_UNCLOSED_TOKEN:
    case XML_ERROR_UNCLOSED_CDATA_SECTION:
    case XML_ERROR_PARTIAL_CHAR:
      return kEarlyEnd;
    case XML_ERROR_TAG_MISMATCH:
      return kNoMatch;
    case XML_ERROR_DUPLICATE_ATTRIBUTE:
      return "the same attribute twice";
    case XML_ERROR_JUNK_AFTER_DOC_ELEMENT:
      return "text after the end of the document";
    case XML_ERROR_UNDEFINED_ENTITY:
      return "an entity that is not defined (write &amp; for an ampersand)";
    case XML_ERROR_UNKNOWN_ENCODING:
    case XML_ERROR_INCORRECT_ENCODING:
      return "an encoding other than UTF-8";
    default:
      return "a character that XML does not allow there (write &amp; for &, &lt; for <)";
  }
}

}  // namespace throng::imports
