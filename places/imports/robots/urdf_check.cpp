#include "places/imports/robots/urdf_check.h"

#include <fmt/core.h>
#include <tinyxml2.h>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/text/suggest.h"
#include "places/imports/parts/xml_words.h"

namespace throng::imports {

using tinyxml2::XMLElement;

namespace {

std::string value_or(const char* text, const char* otherwise) { return text ? text : otherwise; }

std::optional<double> parse_number(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

class UrdfCheck {
 public:
  explicit UrdfCheck(const std::string& name) : name_(name) {}

  UrdfFacts run(const std::string& text) {
    tinyxml2::XMLDocument document;
    if (document.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
      throw InputError({name_, fmt::format("line {}", document.ErrorLineNum()),
                        tinyxml_fault(document.ErrorID()), "a robot of URDF (XML)"});
    }
    const XMLElement& root = *document.RootElement();
    reject_xacro(root);
    collect(root);
    for (const XMLElement* link : children(root, "link")) check_link(*link);
    if (links_.empty()) problem(root, "no <link>", "a robot with links");
    for (const XMLElement* joint : children(root, "joint")) check_joint(*joint);
    check_single_root(root);
    if (!problems_.empty()) throw InputError(std::move(problems_));
    return std::move(facts_);
  }

 private:
  static std::vector<const XMLElement*> children(const XMLElement& parent, const char* name) {
    std::vector<const XMLElement*> found;
    for (auto* child = parent.FirstChildElement(name); child != nullptr;
         child = child->NextSiblingElement(name)) {
      found.push_back(child);
    }
    return found;
  }

  void problem(const XMLElement& element, const std::string& found, const std::string& expected) {
    problems_.push_back({name_, fmt::format("line {}, <{}>", element.GetLineNum(), element.Name()),
                         found, expected});
  }

  void reject_xacro(const XMLElement& element) const {
    if (std::string_view(element.Name()).starts_with("xacro:")) {
      const std::string stem = std::filesystem::path(name_).stem().string();
      const std::string target = stem.ends_with(".urdf") ? stem : stem + ".urdf";
      throw InputError({name_, fmt::format("line {}", element.GetLineNum()),
                        fmt::format("<{}>: a xacro file", element.Name()),
                        fmt::format("its expansion: xacro {} -o {}", name_, target)});
    }
    for (auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      reject_xacro(*child);
    }
  }

  void collect(const XMLElement& element) {
    if (const char* name = element.Attribute("name")) {
      facts_.lines.try_emplace(name, element.GetLineNum());
    }
    for (auto* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      collect(*child);
    }
  }

  double number(const XMLElement& element, const char* attribute) {
    const char* text = element.Attribute(attribute);
    const std::optional<double> value = text ? parse_number(text) : std::nullopt;
    if (!value) {
      problem(element,
              text ? fmt::format("{}=\"{}\"", attribute, text) : fmt::format("no {}", attribute),
              fmt::format("a number as {}", attribute));
    }
    return value.value_or(0);
  }

  void check_origin(const XMLElement& parent) {
    const XMLElement* origin = parent.FirstChildElement("origin");
    if (origin == nullptr) return;
    for (const char* attribute : {"xyz", "rpy"}) {
      const char* text = origin->Attribute(attribute);
      if (text == nullptr) continue;
      std::vector<std::string> words;
      std::string_view rest(text);
      while (!rest.empty()) {
        const std::size_t end = std::min(rest.find_first_of(" \t\n"), rest.size());
        if (end > 0) words.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
      }
      const bool good = words.size() == 3 && std::all_of(words.begin(), words.end(), [](auto& w) {
                          return parse_number(w).has_value();
                        });
      if (!good) {
        problem(*origin, fmt::format("{}=\"{}\"", attribute, text), "three numbers");
      }
    }
  }

  void check_link(const XMLElement& link) {
    const char* name = link.Attribute("name");
    if (name == nullptr) return problem(link, "no name", "a link with a name");
    if (!links_.insert(name).second) {
      return problem(link, fmt::format("a second link \"{}\"", name), "one link of each name");
    }
    const XMLElement* inertial = link.FirstChildElement("inertial");
    if (inertial == nullptr) return;
    check_origin(*inertial);
    const XMLElement* mass = inertial->FirstChildElement("mass");
    if (mass == nullptr) return problem(*inertial, "no <mass>", "<mass value=\"...\"/>");
    const std::size_t before = problems_.size();
    const double mass_kg = number(*mass, "value");
    if (problems_.size() == before && !(mass_kg > 0 && mass_kg < 1000)) {
      problem(*mass, fmt::format("a mass of {:g} kg", mass_kg), "above 0, and below 1000 kg");
    }
    facts_.mass_kg += mass_kg;
    const XMLElement* inertia = inertial->FirstChildElement("inertia");
    if (inertia == nullptr) return problem(*inertial, "no <inertia>", "<inertia ixx=\"...\" .../>");
    check_inertia(*inertia);
  }

  void check_inertia(const XMLElement& inertia) {
    const std::size_t before = problems_.size();
    Eigen::Matrix3d matrix;
    constexpr std::array<std::array<const char*, 3>, 3> kNames = {
        {{"ixx", "ixy", "ixz"}, {"ixy", "iyy", "iyz"}, {"ixz", "iyz", "izz"}}};
    for (int row = 0; row < 3; ++row) {
      for (int column = row; column < 3; ++column) {
        const char* name = kNames[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
        matrix(row, column) = number(inertia, name);
        matrix(column, row) = matrix(row, column);
      }
    }
    if (problems_.size() > before) return;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(matrix);
    if (!(principal.eigenvalues().minCoeff() > 0)) {
      problem(
          inertia,
          fmt::format("a least principal moment of {:g} kg m²", principal.eigenvalues().minCoeff()),
          "moments above 0");
    }
  }

  void check_joint(const XMLElement& joint) {
    constexpr std::array<std::string_view, 6> kTypes = {"revolute", "continuous", "prismatic",
                                                        "fixed",    "floating",   "planar"};
    const std::string type = value_or(joint.Attribute("type"), "");
    if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end()) {
      problem(joint, fmt::format("type \"{}\"", type),
              "revolute, continuous, prismatic, fixed, floating or planar");
    }
    check_origin(joint);
    for (const char* end : {"parent", "child"}) {
      const XMLElement* element = joint.FirstChildElement(end);
      const char* link = element ? element->Attribute("link") : nullptr;
      if (link == nullptr) {
        problem(joint, fmt::format("no <{} link=...>", end), "a parent and a child");
      } else if (!links_.contains(link)) {
        const std::vector<std::string_view> names(links_.begin(), links_.end());
        Problem unknown = unknown_name(
            name_, fmt::format("line {}, <{}>", element->GetLineNum(), end), "link", link, names);
        problems_.push_back(std::move(unknown));
      } else if (std::string_view(end) == "child" && !children_.insert(link).second) {
        problem(joint, fmt::format("a second joint with the child \"{}\"", link),
                "one parent of each link");
      }
    }
  }

  void check_single_root(const XMLElement& root) {
    if (!problems_.empty()) return;
    std::vector<std::string> roots;
    for (const std::string& link : links_) {
      if (!children_.contains(link)) roots.push_back(link);
    }
    if (roots.empty()) problem(root, "joints in a circle", "a tree of links");
    if (roots.size() > 1) {
      problem(root, fmt::format("links \"{}\" and \"{}\" without a parent", roots[0], roots[1]),
              "one root");
    }
  }

  const std::string& name_;
  UrdfFacts facts_;
  std::set<std::string, std::less<>> links_;
  std::set<std::string, std::less<>> children_;
  std::vector<Problem> problems_;
};

}  // namespace

UrdfFacts check_urdf(const std::string& name, const std::string& text) {
  return UrdfCheck(name).run(text);
}

}  // namespace throng::imports
