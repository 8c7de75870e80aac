#include "skinning/animate/acts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/geometry/angle.h"
#include "skinning/animate/sitting.h"
#include "skinning/animate/spectator_pose.h"
#include "skinning/animate/standing.h"
#include "tests/skinning/walkers.h"

namespace throng::skinning {
namespace {

const Act& act_named(const char* clip) {
  const Act* act = find_act(clip);
  EXPECT_NE(act, nullptr) << clip;
  return *act;
}

Joints acting(const Walker& walker, const char* clip, double at) {
  return pose_joints(walker.joints, solve(walker, act_figure(walker, act_named(clip), 1, at)));
}

Eigen::Vector3f of(const Joints& joints, Bone bone) { return joints[index_from(bone)]; }

TEST(Acts, BeginReadyAndRepeatWithoutAJump) {
  const Walker walker = made_up_walker();
  const Joints at_ease = pose_joints(walker.joints, solve(walker, ready(walker)));
  for (const Act& act : acts()) {
    const Joints first = pose_joints(walker.joints, solve(walker, act_figure(walker, act, 0, 0)));
    const Joints begins = pose_joints(walker.joints, solve(walker, act_figure(walker, act, 1, 0)));
    const Joints ends = pose_joints(walker.joints, solve(walker, act_figure(walker, act, 1, 1)));
    for (std::size_t bone = 0; bone < kBoneCount; ++bone) {
      EXPECT_LT((first[bone] - at_ease[bone]).norm(), 0.01F) << act.clip;
      if (act.cycle_s > 0) {
        EXPECT_LT((begins[bone] - ends[bone]).norm(), 0.002F) << act.clip;
      }
    }
  }
}

TEST(Acts, FeetStayWhereTheyAre) {
  for (const float scale : {0.65F, 1.0F}) {
    const Walker walker = made_up_walker(scale);
    const Joints at_ease = pose_joints(walker.joints, solve(walker, ready(walker)));
    for (const Act& act : acts()) {
      if (is_airborne(act)) continue;
      for (double at = 0; at <= 1; at += 0.125) {
        const Joints joints =
            pose_joints(walker.joints, solve(walker, act_figure(walker, act, 1, at)));
        for (const Bone foot : {Bone::left_foot, Bone::right_foot}) {
          EXPECT_LT((of(joints, foot) - of(at_ease, foot)).norm(), 0.004F) << act.clip << at;
        }
      }
    }
  }
}

TEST(Acts, HandsAreWhereTheActNeedsThem) {
  const Walker walker = made_up_walker();
  const float s = walker.stature_m;
  const auto hand = [&](const char* clip, double at) {
    return of(acting(walker, clip, at), on(phone_hand(walker.manner), Bone::left_hand));
  };
  const Joints rest = walker.joints;
  const float head_m = of(rest, Bone::head).z();
  EXPECT_GT(hand("act_film_high", 0).z(), head_m + 0.02F * s) << "above the head";
  EXPECT_GT(hand("act_arms_up", 0).z(), head_m);
  EXPECT_GT(hand("act_wave", 0).z(), head_m);
  EXPECT_NEAR(hand("act_call", 0).z(), head_m, 0.09F * s);
  EXPECT_GT(hand("act_film", 0).x(), 0.1F * s) << "ahead of the eyes";
  EXPECT_GT(hand("act_point", 0).x(), 0.25F * s);
  EXPECT_LT(hand("act_behind", 0).x(), 0);
  EXPECT_LT(hand("act_pockets", 0).z(), of(rest, Bone::spine).z() + 0.06F * s);
  // Up to the mouth and down again.
  EXPECT_LT(hand("act_drink", 0).z(), head_m - 0.1F * s);
  EXPECT_GT(hand("act_drink", 0.5).z(), head_m - 0.09F * s);
  const Joints cowers = acting(walker, "act_cower", 0);
  EXPECT_LT(of(cowers, Bone::head).z(), 0.75F * head_m);
  EXPECT_LT(of(acting(walker, "act_squat", 0), Bone::hips).z(), 0.5F * of(rest, Bone::hips).z());
  // Palms meet and part.
  const auto apart = [&](double at) {
    const Joints joints = acting(walker, "act_clap", at);
    return (of(joints, Bone::left_hand) - of(joints, Bone::right_hand)).norm();
  };
  EXPECT_GT(std::abs(apart(0.25) - apart(0.75)), 0.08F * s);
}

TEST(Acts, ChildrenHopOffTheGroundAndComeDown) {
  const Walker walker = made_up_walker(0.65F);
  const auto foot_m = [&](double at) {
    return of(acting(walker, "act_hop", at), Bone::left_foot).z();
  };
  EXPECT_GT(foot_m(0.25), foot_m(0) + 0.05F);
  EXPECT_NEAR(foot_m(0.75), foot_m(0), 0.002F);
}

/// The share of time that people stand in each clip, by the setting.
std::map<std::string, double> shares(Setting setting, float age_years, Carry carries) {
  Population people = make_population({made_up_walker()});
  people.characters.front().age_years = age_years;
  people.characters.front().carries = carries;
  std::vector<Moment> moments = straight_trajectory(std::vector<double>(600, 0), 0.1);
  for (Moment& moment : moments) moment.setting = setting;
  std::map<std::string, double> found;
  double all = 0;
  for (std::uint64_t key = 0; key < 120; ++key) {
    Appearance appearance;
    appearance.phase_offset = static_cast<float>(std::fmod(0.618 * static_cast<double>(key), 1));
    const MotionPlan plan(people, appearance, key, moments, 0.1);
    for (double step = 0; step < 600; step += 25, ++all) {
      const std::uint32_t palette = plan.at(step).a;
      std::string name;
      for (const Clip& clip : people.clips) {
        if (clip.first <= palette) name = clip.name;
      }
      ++found[name];
    }
  }
  for (auto& [name, count] : found) count /= all;
  return found;
}

TEST(Acts, FollowTheSetting) {
  std::map<std::string, double> alone = shares(Setting::alone, 35, Carry::nothing);
  std::map<std::string, double> company = shares(Setting::company, 35, Carry::nothing);
  std::map<std::string, double> audience = shares(Setting::audience, 35, Carry::nothing);
  std::map<std::string, double> fear = shares(Setting::fear, 35, Carry::nothing);
  EXPECT_EQ(alone["act_talk"], 0);
  EXPECT_GT(company["act_talk"], 0.05);
  EXPECT_GT(audience["act_clap"] + audience["act_arms_up"] + audience["act_dance"], 0.15);
  EXPECT_EQ(company["act_clap"], 0);
  EXPECT_GT(fear["act_cower"], 0.08);
  EXPECT_EQ(alone["act_cower"], 0);
  // Everybody varies, and many just stand.
  for (auto& in_setting : {&alone, &company, &audience}) {
    EXPECT_GT(in_setting->size(), 10U);
    double idle = 0;
    for (const auto& [name, share] : *in_setting) idle += name.starts_with("idle") ? share : 0;
    EXPECT_GT(idle, 0.2);
    EXPECT_LT(idle, 0.75);
  }
}

TEST(Acts, FollowAgeAndFreeHands) {
  std::map<std::string, double> child = shares(Setting::alone, 8, Carry::nothing);
  EXPECT_EQ(child["act_smoke"] + child["act_call"] + child["act_behind"], 0);
  EXPECT_GT(child["act_hop"], 0.03);
  EXPECT_EQ(shares(Setting::alone, 35, Carry::nothing)["act_hop"], 0);
  for (const auto& [name, share] : shares(Setting::audience, 35, Carry::umbrella)) {
    const Act* act = find_act(name);
    EXPECT_TRUE(act == nullptr || act->hands < 2) << name;
  }
}

TEST(Acts, PlansNameThem) {
  Population people = make_population({made_up_walker()});
  std::vector<Moment> moments = straight_trajectory(std::vector<double>(600, 0), 0.1);
  for (Moment& moment : moments) moment.setting = Setting::audience;
  int checked = 0;
  for (std::uint64_t key = 0; key < 40; ++key) {
    const MotionPlan plan(people, {}, key, moments, 0.1);
    for (double step = 0; step < 600; step += 10) {
      const std::uint32_t palette = plan.at(step).a;
      for (const Act& act : acts()) {
        const Clip* clip = ClipSet(people).find(act.clip);
        if (palette < clip->first || palette >= clip->first + clip->frames) continue;
        EXPECT_EQ(plan.actions_at(step), act.actions) << act.clip;
        ++checked;
      }
    }
  }
  EXPECT_GT(checked, 200);
}

TEST(Sitting, EveryWayKeepsHipsOnTheSeatAndSolesOnTheFloor) {
  for (const float scale : {0.75F, 1.0F}) {
    const Walker walker = made_up_walker(scale);
    for (const std::string_view name : kSeatedClips) {
      const Joints joints =
          pose_joints(walker.joints, solve(walker, sit(walker, *find_seat(name), 0)));
      EXPECT_NEAR(of(joints, Bone::left_thigh).z(), kSeatM + 0.05 * walker.stature_m, 0.01) << name;
      EXPECT_LT(of(joints, Bone::left_foot).z(), 0.12F) << name;
      const Eigen::Vector3f knee = of(joints, Bone::left_shin);
      EXPECT_GT(knee.x(), 0.2F * scale) << name;
      const bool is_crossed = name == "sit_crossed";
      EXPECT_EQ(of(joints, Bone::right_foot).z() > 0.2F * scale, is_crossed) << name;
    }
  }
  EXPECT_FALSE(find_seat("idle").has_value());
}

TEST(Sitting, PeopleSitInSeveralPosturesAndPhonesAreNamed) {
  const Population people = make_population({made_up_walker()});
  const SpectatorPoses poses(people);
  std::set<std::string> found;
  int phones = 0;
  for (int person = 0; person < 100; ++person) {
    const double phase = std::fmod(0.618 * person, 1);
    const PostureTime posture{StandPosture::sitting, StandPosture::sitting, 30};
    const std::uint32_t palette = poses.at(posture, phase, 30).a;
    for (const std::string_view name : kSeatedClips) {
      const Clip* clip = ClipSet(people).find(name);
      if (palette < clip->first || palette >= clip->first + clip->frames) continue;
      found.insert(std::string(name));
      const Actions actions = SpectatorPoses::actions(posture, phase);
      EXPECT_TRUE(actions.has(Action::sit));
      EXPECT_EQ(actions.has(Action::use_phone), name == "sit_phone");
      phones += name == "sit_phone" ? 1 : 0;
    }
  }
  EXPECT_EQ(found.size(), kSeatedClips.size());
  EXPECT_GT(phones, 4);
}

}  // namespace
}  // namespace throng::skinning
