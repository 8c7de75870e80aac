// Nodes of a description: elements with attributes, as in Menge's XML, but as values that a program
// can create, copy, compare and change.
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace throng::crowd {

/// Formats a number as the shortest text that is read as the same number.
std::string number_text(double value);
/// Formats a number with exactly `decimals` decimals.
std::string decimals_text(double value, int decimals);

/// A named value. Numbers are stored as text, as in files; booleans as "1" and "0".
struct Attribute {
  Attribute(std::string attribute, std::string text)
      : name(std::move(attribute)), value(std::move(text)) {}
  Attribute(std::string attribute, std::string_view text)
      : name(std::move(attribute)), value(text) {}
  Attribute(std::string attribute, const char* text) : name(std::move(attribute)), value(text) {}
  Attribute(std::string attribute, double number)
      : name(std::move(attribute)), value(number_text(number)) {}
  Attribute(std::string attribute, bool flag)
      : name(std::move(attribute)), value(flag ? "1" : "0") {}
  template <std::integral Integer>
  Attribute(std::string attribute, Integer number)
      : name(std::move(attribute)), value(std::to_string(number)) {}

  bool operator==(const Attribute&) const = default;

  std::string name;
  std::string value;
};

/// An element with attributes and child elements.
struct Node {
  explicit Node(std::string element, std::vector<Attribute> of_it = {},
                std::vector<Node> below = {});

  /// Replaces the value of the attribute, or appends it. Returns this node.
  Node& set(Attribute attribute);
  /// Returns the value of the attribute, or null. Valid until the attributes change.
  const std::string* find(std::string_view attribute) const;
  /// Appends a child. Returns this node.
  Node& add(Node child);

  /// Compares name, attributes in order, and children; ignores comments and lines.
  bool operator==(const Node& other) const;

  std::string name;
  std::vector<Attribute> attributes;
  std::vector<Node> children;
  std::string comment = {};  ///< text of the XML comment before the element
  int line = 0;              ///< line in the file; 0: built in code
};

}  // namespace throng::crowd
