// The list of what the files may say is the tables that read them.
#include "crowd/project/vocabulary.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "crowd/state/behavior.h"
#include "crowd/state/model.h"

namespace throng::crowd {
namespace {

const VocabularyKind& find_kind(const std::vector<VocabularyKind>& all, const std::string& title) {
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const VocabularyKind& kind) { return kind.title == title; });
  EXPECT_NE(found, all.end()) << title;
  return found != all.end() ? *found : all.front();
}

const VocabularyEntry& find_entry(const VocabularyKind& kind, const std::string& name) {
  const auto found = std::find_if(kind.entries.begin(), kind.entries.end(),
                                  [&](const VocabularyEntry& entry) { return entry.name == name; });
  EXPECT_NE(found, kind.entries.end()) << name;
  return found != kind.entries.end() ? *found : kind.entries.front();
}

TEST(Vocabulary, HasEveryConditionWithItsAttributes) {
  const std::vector<VocabularyKind> all = vocabulary();
  const VocabularyKind& conditions = find_kind(all, "Conditions");
  EXPECT_EQ(conditions.entries.size(), condition_registry().entries().size());
  const VocabularyEntry& reached = find_entry(conditions, "goal_reached");
  ASSERT_EQ(reached.attributes.size(), 1U);
  EXPECT_EQ(reached.attributes[0].name, "distance");
  EXPECT_EQ(reached.attributes[0].type, "number");
  EXPECT_EQ(reached.attributes[0].range, "at least 0");
  EXPECT_FALSE(reached.attributes[0].required);
  EXPECT_FALSE(reached.attributes[0].help.empty());
  const VocabularyEntry& timer = find_entry(conditions, "timer");
  ASSERT_EQ(timer.attributes.size(), 3U);
  EXPECT_TRUE(timer.attributes[0].required);
  EXPECT_EQ(timer.attributes[2].name, "dist ...");
}

TEST(Vocabulary, HasEveryModelWithItsParameters) {
  const std::vector<VocabularyKind> all = vocabulary();
  EXPECT_EQ(find_kind(all, "Pedestrian models").entries.size(), models().size());
  const VocabularyEntry& orca = find_entry(find_kind(all, "Models in a profile"), "ORCA");
  ASSERT_EQ(orca.attributes.size(), 2U);
  EXPECT_EQ(orca.attributes[0].name, "tau");
  EXPECT_EQ(orca.attributes[0].default_text, "2.5");
}

TEST(Vocabulary, SaysSomethingOfEverything) {
  for (const VocabularyKind& kind : vocabulary()) {
    EXPECT_FALSE(kind.entries.empty()) << kind.title;
    for (const VocabularyEntry& entry : kind.entries) {
      EXPECT_FALSE(entry.help.empty()) << kind.title << " " << entry.name;
      for (const VocabularyAttribute& attribute : entry.attributes) {
        EXPECT_FALSE(attribute.help.empty())
            << kind.title << " " << entry.name << " " << attribute.name;
      }
    }
  }
}

}  // namespace
}  // namespace throng::crowd
