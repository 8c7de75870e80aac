#include "skinning/import/rig_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "base/error.h"
#include "base/text/suggest.h"

namespace throng::skinning {

namespace {

// Meaning of a bone name: a part of the body and its side.
struct Meaning {
  std::string part;  // lower case, words joined: "upleg"
  char side = 'm';   // 'l', 'r' or 'm' for the middle
};

enum class BodyPart : std::uint8_t {
  hips,
  spine,  // any of the bones between hips and neck
  neck,
  head,
  clavicle,
  upper_arm,
  forearm,
  hand,
  thigh,
  shin,
  foot,
  toe,
};

bool is(char c, int (*kind)(int)) { return kind(static_cast<unsigned char>(c)) != 0; }

// "mixamorig:LeftUpLeg" to left, up, leg: words end at other signs, digits and small letters that
// a capital follows.
std::vector<std::string> split_words(const std::string& name) {
  const std::size_t space = name.find_last_of(":|");
  std::vector<std::string> words;
  bool begins = true;
  char before = ' ';
  for (const char c : name.substr(space == std::string::npos ? 0 : space + 1)) {
    const bool capital = is(c, std::isupper) && is(before, std::islower);
    const bool kind = is(c, std::isalpha) != is(before, std::isalpha);
    if (!is(c, std::isalnum)) {
      begins = true;
    } else {
      if (begins || capital || kind) words.emplace_back();
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
      begins = false;
    }
    before = c;
  }
  return words;
}

bool is_among(const std::string& word, std::initializer_list<const char*> words) {
  return std::any_of(words.begin(), words.end(), [&](const char* w) { return word == w; });
}

// Handles of animators, ends of chains and helpers are no bones of the body.
bool is_helper(const std::string& word) {
  return is_among(word, {"ik", "fk", "pole", "ctrl", "control", "target", "twist", "roll", "end",
                         "nub", "helper", "mch", "org", "tweak", "goal", "site", "effector"});
}

bool is_filler(const std::string& word) {
  return is(word.front(), std::isdigit) || word.rfind("mixamorig", 0) == 0 ||
         is_among(word,
                  {"bip", "def", "j", "c", "cc", "base", "b", "bn", "bone", "jnt", "joint", "jt",
                   "rig", "sk", "valvebiped", "character", "human", "skeleton", "armature"});
}

std::optional<Meaning> parse_bone_name(const std::string& name) {
  Meaning meaning;
  for (std::string word : split_words(name)) {
    if (is_helper(word)) return {};
    if (is_among(word, {"l", "left"})) {
      meaning.side = 'l';
    } else if (is_among(word, {"r", "right"})) {
      meaning.side = 'r';
    } else if (!is_filler(word)) {
      if (meaning.side == 'm' && word.rfind("left", 0) == 0) {
        meaning.side = 'l';
        word = word.substr(4);
      } else if (meaning.side == 'm' && word.rfind("right", 0) == 0) {
        meaning.side = 'r';
        word = word.substr(5);
      }
      meaning.part += word;
    }
  }
  return meaning;
}

bool is_forearm(const std::string& part) {
  return is_among(part, {"forearm", "lowerarm", "lowarm", "elbow", "forearmbend", "armlower"});
}

/// A shoulder that bears the elbow is the upper arm (SMPL, Synty, Daz), another one the collar bone
/// (Mixamo).
std::optional<BodyPart> sided_part(const std::string& part, bool thigh_is_named, bool bears_elbow) {
  if (is_among(part, {"clavicle", "collar", "collarbone", "shouldergirdle"}))
    return BodyPart::clavicle;
  if (is_among(part, {"shoulder", "shldr"})) {
    return bears_elbow ? BodyPart::upper_arm : BodyPart::clavicle;
  }
  if (is_among(part, {"arm", "upperarm", "uparm", "shoulderbend", "shldrbend", "humerus"})) {
    return BodyPart::upper_arm;
  }
  if (is_forearm(part)) return BodyPart::forearm;
  if (is_among(part, {"hand", "wrist", "palm"})) return BodyPart::hand;
  if (is_among(part, {"upleg", "thigh", "upperleg", "hip", "thighbend", "femur", "legupper"})) {
    return BodyPart::thigh;
  }
  if (part == "leg") return thigh_is_named ? BodyPart::shin : BodyPart::thigh;
  if (is_among(part,
               {"shin", "calf", "lowerleg", "lowleg", "knee", "shank", "tibia", "leglower"})) {
    return BodyPart::shin;
  }
  if (is_among(part, {"foot", "ankle"})) return BodyPart::foot;
  if (is_among(part, {"toe", "toes", "toebase", "ball", "football", "metatarsals"}))
    return BodyPart::toe;
  return {};
}

std::optional<BodyPart> middle_part(const std::string& part) {
  if (is_among(part, {"hips", "hip", "pelvis"})) return BodyPart::hips;
  if (part.rfind("spine", 0) == 0 ||
      is_among(part, {"chest", "upperchest", "torso", "abdomen", "waist", "ribcage", "lowerback",
                      "thorax", "back"})) {
    return BodyPart::spine;
  }
  if (part.rfind("neck", 0) == 0) return BodyPart::neck;
  if (part == "head") return BodyPart::head;
  return {};
}

bool names_thigh(const std::vector<std::optional<Meaning>>& meanings) {
  return std::any_of(meanings.begin(), meanings.end(), [&](const auto& meaning) {
    return meaning && meaning->side != 'm' &&
           is_among(meaning->part, {"upleg", "thigh", "upperleg", "hip", "legupper"});
  });
}

std::string listed_names(const std::vector<std::string>& names) {
  constexpr std::size_t kMaxShown = 40;
  const std::size_t shown = std::min(names.size(), kMaxShown);
  const std::string text = fmt::format(
      "{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  return shown < names.size() ? fmt::format("{} and {} more", text, names.size() - shown) : text;
}

/// The beginning that most of many names share, such as "Hero_Rig:": it says nothing of a bone.
std::string common_prefix(const std::vector<std::string>& names) {
  constexpr std::size_t kMany = 8;
  constexpr double kMinShare = 0.8;
  if (names.size() < kMany) return "";
  std::map<std::string, std::size_t> counts;
  for (const std::string& name : names) {
    for (std::size_t length = 1; length < name.size(); ++length) ++counts[name.substr(0, length)];
  }
  std::string longest;
  for (const auto& [prefix, count] : counts) {
    const bool is_common =
        static_cast<double>(count) >= kMinShare * static_cast<double>(names.size());
    if (is_common && prefix.size() > longest.size()) longest = prefix;
  }
  return longest;
}

std::string without_prefix(const std::string& name, const std::string& prefix) {
  const bool has_it = name.size() > prefix.size() && name.starts_with(prefix);
  return has_it ? name.substr(prefix.size()) : name;
}

class Mapper {
 public:
  Mapper(const RiggedModel& model, const std::map<std::string, std::string>& overrides,
         std::string where)
      : model_(&model), where_(std::move(where)), depth_(model.nodes.size(), 0) {
    nodes_.fill(-1);
    taken_.resize(model.nodes.size(), false);
    for (std::size_t i = 1; i < depth_.size(); ++i) {
      depth_[i] = depth_[static_cast<std::size_t>(model.nodes[i].parent)] + 1;
    }
    apply_overrides(overrides);
    guess();
    place_spine();
    complain();
  }

  BoneNodes nodes() const { return nodes_; }

 private:
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const ModelNode& node : model_->nodes) {
      if (node.deforms || !any_deforms()) names.push_back(node.name);
    }
    return names;
  }

  bool any_deforms() const {
    return std::any_of(model_->nodes.begin(), model_->nodes.end(),
                       [](const ModelNode& node) { return node.deforms; });
  }

  void take(Bone bone, int node) {
    nodes_[index_from(bone)] = node;
    taken_[static_cast<std::size_t>(node)] = true;
  }

  void apply_overrides(const std::map<std::string, std::string>& overrides) {
    for (const auto& [ours, theirs] : overrides) {
      const std::string where = "/bones/" + ours;
      const auto bone = std::find(kBoneNames.begin(), kBoneNames.end(), ours);
      if (bone == kBoneNames.end()) {
        const std::vector<std::string> all(kBoneNames.begin(), kBoneNames.end());
        problems_.push_back(
            {where_, where, "no bone of ours",
             fmt::format("one of {} (\"{}\"?)", fmt::join(all, ", "), most_similar(ours, all))});
        continue;
      }
      const auto node =
          std::find_if(model_->nodes.begin(), model_->nodes.end(),
                       [&, &name = theirs](const ModelNode& n) { return n.name == name; });
      if (node == model_->nodes.end()) {
        problems_.push_back(
            {where_, where, fmt::format("\"{}\", which {} does not have", theirs, model_->file),
             fmt::format("one of its bones, e.g. \"{}\"", most_similar(theirs, names()))});
        continue;
      }
      take(static_cast<Bone>(bone - kBoneNames.begin()),
           static_cast<int>(node - model_->nodes.begin()));
    }
  }

  // If a name fits several bones, the one that moves vertices is better, then the one nearest to
  // the root.
  bool better(std::size_t a, int b) const {
    if (b < 0) return true;
    const auto other = static_cast<std::size_t>(b);
    const bool deforms = model_->nodes[a].deforms;
    if (deforms != model_->nodes[other].deforms) return deforms;
    return depth_[a] < depth_[other];
  }

  void guess() {
    std::vector<std::optional<Meaning>> meanings;
    const std::string prefix = common_prefix(names());
    for (const ModelNode& node : model_->nodes) {
      meanings.push_back(parse_bone_name(without_prefix(node.name, prefix)));
    }
    const bool thigh = names_thigh(meanings);
    const std::vector<bool> bears_elbow = bearers_of_elbows(meanings);
    BoneNodes best;
    best.fill(-1);
    for (std::size_t i = 0; i < meanings.size(); ++i) {
      if (!meanings[i] || taken_[i]) continue;
      const Meaning& meaning = *meanings[i];
      if (meaning.side == 'm') {
        const auto part = middle_part(meaning.part);
        if (part == BodyPart::spine) spine_.push_back(i);
        if (!part || part == BodyPart::spine) continue;
        const Bone bone = part == BodyPart::hips   ? Bone::hips
                          : part == BodyPart::neck ? Bone::neck
                                                   : Bone::head;
        consider(bone, i, best);
      } else if (const auto part = sided_part(meaning.part, thigh, bears_elbow[i])) {
        const int first = static_cast<int>(Bone::left_clavicle) + static_cast<int>(*part) -
                          static_cast<int>(BodyPart::clavicle);
        // Four bones of an arm on the left, four on the right, then the legs.
        const bool leg = *part >= BodyPart::thigh;
        const int left = leg ? static_cast<int>(Bone::left_thigh) + static_cast<int>(*part) -
                                   static_cast<int>(BodyPart::thigh)
                             : first;
        consider(static_cast<Bone>(left + (meaning.side == 'l' ? 0 : 4)), i, best);
      }
    }
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      if (best[bone] >= 0 && nodes_[bone] < 0) take(static_cast<Bone>(bone), best[bone]);
    }
  }

  /// By node: whether a forearm follows, with no more than helpers between.
  std::vector<bool> bearers_of_elbows(const std::vector<std::optional<Meaning>>& meanings) const {
    std::vector<bool> bears(meanings.size(), false);
    for (std::size_t i = 0; i < meanings.size(); ++i) {
      if (!meanings[i] || !is_forearm(meanings[i]->part)) continue;
      int at = model_->nodes[i].parent;
      while (at >= 0 && !meanings[static_cast<std::size_t>(at)]) {
        at = model_->nodes[static_cast<std::size_t>(at)].parent;
      }
      if (at >= 0) bears[static_cast<std::size_t>(at)] = true;
    }
    return bears;
  }

  void consider(Bone bone, std::size_t node, BoneNodes& best) const {
    int& held = best[index_from(bone)];
    if (better(node, held)) held = static_cast<int>(node);
  }

  bool is_above(std::size_t node, std::size_t ancestor) const {
    for (int at = static_cast<int>(node); at >= 0;
         at = model_->nodes[static_cast<std::size_t>(at)].parent) {
      if (at == static_cast<int>(ancestor)) return true;
    }
    return false;
  }

  // The spine's lowest bone is ours, and its highest one is the chest; what lies between moves
  // with what is below it. Only those that carry the head count.
  void place_spine() {
    const int head = nodes_[index_from(Bone::neck)] >= 0 ? nodes_[index_from(Bone::neck)]
                                                         : nodes_[index_from(Bone::head)];
    std::vector<std::size_t> chain;
    for (const std::size_t node : spine_) {
      if (!taken_[node] && head >= 0 && is_above(static_cast<std::size_t>(head), node)) {
        chain.push_back(node);
      }
    }
    std::sort(chain.begin(), chain.end(),
              [&](std::size_t a, std::size_t b) { return depth_[a] < depth_[b]; });
    if (nodes_[index_from(Bone::chest)] < 0 && !chain.empty()) {
      take(Bone::chest, static_cast<int>(chain.back()));
      chain.pop_back();
    }
    if (nodes_[index_from(Bone::spine)] < 0 && !chain.empty()) {
      take(Bone::spine, static_cast<int>(chain.front()));
    }
  }

  void complain() {
    std::vector<std::string> unknown;
    for (std::size_t i = 0; i < model_->nodes.size(); ++i) {
      const ModelNode& node = model_->nodes[i];
      if (!taken_[i] && (node.deforms || !any_deforms())) unknown.push_back(node.name);
    }
    std::string listed =  // once is enough
        unknown.empty() ? "" : "; not recognized: " + listed_names(unknown);
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      if (nodes_[bone] >= 0 || !is_needed(static_cast<Bone>(bone))) continue;
      const std::string ours(kBoneNames[bone]);
      problems_.push_back(
          {where_, "/bones/" + ours,
           fmt::format("no bone of {} whose name is known{}", model_->file, listed),
           unknown.empty()
               ? "a skeleton with this bone"
               : fmt::format("the name of that bone, e.g. \"bones\": {{\"{}\": \"{}\"}}", ours,
                             most_similar(ours, unknown))});
      listed.clear();
    }
    if (!problems_.empty()) throw InputError(problems_);
  }

  const RiggedModel* model_;
  std::string where_;
  std::vector<int> depth_;
  std::vector<bool> taken_;
  std::vector<std::size_t> spine_;
  BoneNodes nodes_{};
  std::vector<Problem> problems_;
};

// The edit distance between the words of two names, whatever their signs.
std::size_t distance(const std::string& a, const std::string& b) {
  std::string one;
  std::string other;
  for (const std::string& word : split_words(a)) one += word;
  for (const std::string& word : split_words(b)) other += word;
  return edit_distance(one, other);
}

}  // namespace

bool is_needed(Bone bone) {
  switch (bone) {
    case Bone::head:
    case Bone::left_upper_arm:
    case Bone::left_forearm:
    case Bone::right_upper_arm:
    case Bone::right_forearm:
    case Bone::left_thigh:
    case Bone::left_shin:
    case Bone::left_foot:
    case Bone::right_thigh:
    case Bone::right_shin:
    case Bone::right_foot:
    case Bone::hips:
    case Bone::chest:
      return true;
    default:
      return false;
  }
}

BoneNodes map_bones(const RiggedModel& model, const std::map<std::string, std::string>& overrides,
                    const std::string& where) {
  return Mapper(model, overrides, where).nodes();
}

std::string most_similar(const std::string& name, const std::vector<std::string>& names) {
  const std::string prefix = common_prefix(names);
  const auto distance_to = [&](const std::string& other) {
    return distance(name, without_prefix(other, prefix));
  };
  const auto best = std::min_element(names.begin(), names.end(), [&](const auto& a, const auto& b) {
    return distance_to(a) < distance_to(b);
  });
  return best == names.end() ? std::string() : *best;
}

}  // namespace throng::skinning
