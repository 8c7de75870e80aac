#include "crowd/description/node.h"

#include <fmt/core.h>

#include <algorithm>

namespace throng::crowd {

std::string number_text(double value) { return fmt::format("{}", value); }

std::string decimals_text(double value, int decimals) {
  return fmt::format("{:.{}f}", value, decimals);
}

Node::Node(std::string element, std::vector<Attribute> of_it, std::vector<Node> below)
    : name(std::move(element)), attributes(std::move(of_it)), children(std::move(below)) {}

Node& Node::set(Attribute attribute) {
  const auto known = std::find_if(attributes.begin(), attributes.end(),
                                  [&](const Attribute& a) { return a.name == attribute.name; });
  if (known == attributes.end()) {
    attributes.push_back(std::move(attribute));
  } else {
    known->value = std::move(attribute.value);
  }
  return *this;
}

const std::string* Node::find(std::string_view attribute) const {
  for (const Attribute& known : attributes) {
    if (known.name == attribute) return &known.value;
  }
  return nullptr;
}

Node& Node::add(Node child) {
  children.push_back(std::move(child));
  return *this;
}

bool Node::operator==(const Node& other) const {
  return name == other.name && attributes == other.attributes && children == other.children;
}

}  // namespace throng::crowd
