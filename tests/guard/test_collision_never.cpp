// Tests the pairs of capsules that the collision check leaves out because they cannot meet: by
// branch and bound over the joints between them.
#include <vector>

#include "kernel/guard/collision_pairs.hpp"
#include "tests/guard/arm_capsules.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kBeyond = 0.05;  // rad, of the limits

/// Positions of the joints, middle +- half.
struct Region {
  JointVector middle = JointVector::Zero(), half = JointVector::Zero();
};

double distance(const ArmCapsule& first, const ArmCapsule& second, const JointVector& q) {
  const LinkFrames<Robot> frames = link_frames<Robot>(joint_trig<Robot>(q));
  return separation(second.placed(frames), first.placed(frames));
}

/// True if the two are more than the margin apart at every position: a region in which they may
/// move by more than what is left is divided at its joint that moves them most.
bool never_meet(const ArmCapsule& first, const ArmCapsule& second, double margin, int& regions) {
  Region all;
  for (int i = first.link; i < second.link; ++i) {
    const JointLimit& limit = Robot::kLimits[static_cast<std::size_t>(i)];
    all.middle[i] = 0.5 * (limit.q_min + limit.q_max);
    all.half[i] = 0.5 * (limit.q_max - limit.q_min) + kBeyond;
  }
  std::vector<Region> left = {all};
  for (; !left.empty(); ++regions) {
    Region region = left.back();
    left.pop_back();
    double way = 0.0, most = 0.0;
    int widest = first.link;
    for (int i = first.link; i < second.link; ++i) {
      const double own = second.reach(i) * region.half[i];
      way += own;
      if (own > most) {
        most = own;
        widest = i;
      }
    }
    const double apart = distance(first, second, region.middle);
    if (!(apart > margin)) return false;
    if (apart > margin + way) continue;
    const double half = region.half[widest] *= 0.5, middle = region.middle[widest];
    for (const double side : {-1.0, 1.0}) {
      region.middle[widest] = middle + side * half;
      left.push_back(region);
    }
  }
  return true;
}

// Proves COL-7.

void pairs_that_are_left_out_cannot_meet(void**) {
  int pairs = 0, regions = 0;
  for (const CapsulePair& number : RobotCapsules::kNever) {
    const auto first = static_cast<std::size_t>(number.first),
               second = static_cast<std::size_t>(number.second);
    assert_true(second < RobotCapsules::kCapsules.size());
    const ArmCapsule one(RobotCapsules::kCapsules[first]), other(RobotCapsules::kCapsules[second]);
    assert_true(never_meet(one, other, 0.01, regions));
    int tried = 0;
    assert_false(never_meet(one, other, kWorkspace_m, tried));  // the proof can fail
    ++pairs;
  }
  print_message("%d pairs in %d regions; %d pairs of the arm are checked\n", pairs, regions,
                count_pairs());
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(pairs_that_are_left_out_cannot_meet),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
