// A description of a crowd is a tree of nodes: elements with attributes, as in Menge's XML, but as
// values that a program can build, copy, compare and change.
#pragma once

#include <concepts>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace throng::crowd {

/// The shortest text that reads back as the same number.
std::string number_text(double value);
/// A number rounded to so many decimals, all of them written.
std::string decimals_text(double value, int decimals);

/// A named value. Numbers are kept as text, as in files; booleans are "1" and "0".
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

struct Node {
  explicit Node(std::string element, std::vector<Attribute> of_it = {},
                std::vector<Node> below = {});

  /// Replaces the attribute, or adds it at the end.
  Node& set(Attribute attribute);
  /// The attribute's value, or null.
  const std::string* find(std::string_view attribute) const;
  /// Adds a child at the end, and returns this node.
  Node& add(Node child);

  /// Same name, attributes in the same order and equal children; not comment and line.
  bool operator==(const Node& other) const;

  std::string name;
  std::vector<Attribute> attributes;
  std::vector<Node> children;
  std::string comment = {};  ///< what a file says before the element
  int line = 0;              ///< in the file that it was read from; 0: built in code
};

}  // namespace throng::crowd
