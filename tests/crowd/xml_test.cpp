// Files that are no proper XML, and names that are nearly right.
#include "crowd/description/menge_files/read.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "crowd/elements/element.h"
#include "crowd/elements/suggest.h"
#include "tests/crowd/crowd_files.h"

namespace throng::crowd {
namespace {

using test::agent_at;
using test::mirror_behavior;
using test::scene_with;
using testing::HasSubstr;

/// The problem of reading `text` as a file with the root <Root>.
Problem caught_problem(const std::string& text) {
  const test::TemporaryFolder folder;
  try {
    const Description file = read_description(folder.write("file.xml", text), "Root");
    Reading(file, "Root");
  } catch (const InputError& error) {
    return error.problems().front();
  }
  ADD_FAILURE() << "accepted: " << text.substr(0, 200);
  return {};
}

TEST(Xml, ThatIsNoneIsRefusedWithItsLine) {
  EXPECT_EQ(caught_problem("").found, "no element");
  EXPECT_EQ(caught_problem("\n \n").found, "no element");
  EXPECT_EQ(caught_problem("<!-- only a comment -->").where, "line 1");
  EXPECT_EQ(caught_problem("<Root>\n<a>\n</Root>").found, "an element that another one ends");
  EXPECT_THAT(caught_problem("<Root>\n<a b='1' b='2'/></Root>").found, HasSubstr("twice"));
  EXPECT_EQ(caught_problem("<Root>\n<a b='1' b='2'/></Root>").where, "line 2");
  EXPECT_THAT(caught_problem("<Root a=1/>").found, HasSubstr("without quotes"));
  EXPECT_THAT(caught_problem(std::string("<Root>\n") + '\0' + "</Root>").found, HasSubstr("byte"));
  EXPECT_THAT(caught_problem("<Other/>").expected, HasSubstr("<Root>"));
  EXPECT_THAT(caught_problem("<Rot/>").found, HasSubstr("did you mean Root?"));
  EXPECT_THAT(caught_problem("\xFF\xFE<\0R\0").expected, HasSubstr("XML"));
}

TEST(Xml, NestedTooDeepIsRefused) {
  std::string text = "<Root>";
  for (int i = 0; i < 100'000; ++i) text += "<a>";
  EXPECT_THAT(caught_problem(text).found, HasSubstr("deep"));
}

TEST(Xml, EntitiesOfItsOwnAreRefused) {
  const Problem problem = caught_problem(R"(<!DOCTYPE Root [
<!ENTITY a "aaaaaaaaaa">
<!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>
<Root x="&b;&b;&b;"/>)");
  EXPECT_EQ(problem.where, "line 2");
  EXPECT_THAT(problem.found, HasSubstr("entity"));
}

TEST(Xml, MayBeginWithAByteOrderMark) {
  const test::TemporaryFolder folder;
  const Description file = read_description(
      folder.write("file.xml", "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<Root/>"), "Root");
  EXPECT_EQ(file.root.name, "Root");
}

TEST(Xml, OfOldEditorsIsReadAsLatin1) {
  const test::TemporaryFolder folder;
  const Description file = read_description(
      folder.write("file.xml", "<Root>\n<!-- caf\xE9 --><a n=\"\xE9\"/></Root>"), "Root");
  EXPECT_EQ(file.root.children.front().attributes.front().value, "\xC3\xA9");
  ASSERT_EQ(file.warnings.size(), 1U);
  EXPECT_EQ(file.warnings.front().where, "line 2");
}

TEST(Xml, BrokenUtf8IsNeverPassedOn) {
  const test::TemporaryFolder folder;
  for (const char* bytes : {"\xC0\xAF", "\xED\xA0\x80", "\xF5\x80\x80\x80", "\xE2\x82", "\x80"}) {
    const Description file = read_description(
        folder.write("file.xml", std::string("<Root a=\"") + bytes + "\"/>"), "Root");
    EXPECT_FALSE(file.warnings.empty());
  }
}

TEST(Suggestions, NameTheNearestWord) {
  const std::vector<std::string_view> words = {"max_speed", "max_accel", "pref_speed", "r"};
  EXPECT_EQ(closest("max_sped", words), "max_speed");
  EXPECT_EQ(closest("maxSpeed", words), "max_speed");
  EXPECT_EQ(closest("MAX_ACCEL", words), "max_accel");
  EXPECT_EQ(closest("perf_speed", words), "pref_speed");
  EXPECT_EQ(closest("R", words), "r");
  EXPECT_EQ(closest("colour", words), std::nullopt);
  EXPECT_EQ(closest("", words), std::nullopt);
  EXPECT_EQ(closest(std::string(10'000, 'x'), words), std::nullopt);
  EXPECT_EQ(closest("x", {}), std::nullopt);
}

TEST(Suggestions, AreMadeForAttributesElementsTypesAndWords) {
  const Simulation crowd =
      test::load(scene_with(agent_at(0, 0), R"(max_sped="2" colour="red")"), mirror_behavior());
  ASSERT_EQ(crowd.warnings().size(), 2U);
  EXPECT_THAT(crowd.warnings()[0].where, HasSubstr("max_sped"));
  EXPECT_THAT(crowd.warnings()[0].found, HasSubstr("did you mean max_speed?"));
  EXPECT_THAT(crowd.warnings()[1].found, Not(HasSubstr("did you mean")));

  const auto found_in = [](const std::string& extra, const std::string& behavior) {
    try {
      test::load(scene_with(agent_at(0, 0), "", "Start", extra), behavior);
    } catch (const InputError& error) {
      return error.problems().front().found;
    }
    return std::string("nothing wrong");
  };
  EXPECT_THAT(found_in(R"(<ObstacelSet/>)", mirror_behavior()),
              HasSubstr("did you mean ObstacleSet?"));
  EXPECT_THAT(found_in("", R"(<BFSM><State name="Start" final="0">
    <GoalSelector type="nearst" goal_set="0"/></State></BFSM>)"),
              HasSubstr("did you mean nearest?"));
  EXPECT_THAT(found_in(R"(<SpatialQuery type="kdtree"/>)", mirror_behavior()), HasSubstr("second"));
}

TEST(Xml, ReportsIgnoredPartsOnce) {
  // States' names are read before the states, and a transition once for each state that it leaves.
  const std::string behavior = R"(<BFSM>
  <State name="Start" final="0" speedPolicy="min"/><State name="B" final="0"/>
  <State name="End" final="1"/>
  <Transition from="Start,B" to="End" order="0"><Condition type="auto" weight="1"/></Transition>
</BFSM>)";
  const Simulation crowd = test::load(scene_with(agent_at(0, 0)), behavior);
  const auto ignored = std::count_if(
      crowd.warnings().begin(), crowd.warnings().end(),
      [](const Problem& p) { return p.found.find("unknown attribute") != std::string::npos; });
  EXPECT_EQ(ignored, 3);
}

TEST(Attributes, TakeWholeNumbersAndTruthAsMengesFilesWriteThem) {
  const std::string behavior = R"(<BFSM>
  <State name="Start" final="2"/>
</BFSM>)";
  Simulation crowd = test::load(scene_with(agent_at(0, 0), R"(max_neighbors="10.0")"), behavior);
  EXPECT_TRUE(crowd.all_final());
}

}  // namespace
}  // namespace throng::crowd
