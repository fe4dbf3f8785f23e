// Tests the pairs of capsules that the collision check leaves out because they cannot meet: by
// branch and bound over the joints between them.
#include <vector>

#include "kernel/guard/collision_pairs.hpp"
#include "kernel/guard/separation.hpp"
#include "kernel/model/link_frames.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr double kBeyond = 0.05;  // rad, of the limits

/// Positions of the joints, middle +- half.
struct Region {
  JointVector middle = JointVector::Zero(), half = JointVector::Zero();
};

struct TablePair {
  const LinkCapsule& first;
  const LinkCapsule& second;

  /// No point of the second capsule is farther from axis `joint`, from 0, at any position.
  double reach(int joint) const {
    double sum = second.radius + std::max(Vector3(second.a).norm(), Vector3(second.b).norm());
    for (int i = joint + 1; i < second.link; ++i) {
      const JointFrame& next = Robot::kJoints[static_cast<std::size_t>(i)];
      sum += Vector3(next.x, next.y, next.z).norm();
    }
    return sum;
  }
  double distance(const JointVector& q) const {
    const LinkFrames<Robot> frames = link_frames<Robot>(joint_trig<Robot>(q));
    return separation(placed(second, frames), placed(first, frames));
  }

 private:
  static Capsule placed(const LinkCapsule& capsule, const LinkFrames<Robot>& frames) {
    const LinkFrame& frame = frames[static_cast<std::size_t>(capsule.link)];
    return {frame.at(Vector3(capsule.a)), frame.at(Vector3(capsule.b)), capsule.radius};
  }
};

/// True if the two are more than the margin apart at every position: a region in which they may
/// move by more than what is left is divided at its joint that moves them most.
bool never_meet(const TablePair& pair, double margin, int& regions) {
  Region all;
  for (int i = pair.first.link; i < pair.second.link; ++i) {
    const JointLimit& limit = Robot::kLimits[static_cast<std::size_t>(i)];
    all.middle[i] = 0.5 * (limit.q_min + limit.q_max);
    all.half[i] = 0.5 * (limit.q_max - limit.q_min) + kBeyond;
  }
  std::vector<Region> left = {all};
  for (; !left.empty(); ++regions) {
    Region region = left.back();
    left.pop_back();
    double way = 0.0, most = 0.0;
    int widest = pair.first.link;
    for (int i = pair.first.link; i < pair.second.link; ++i) {
      const double own = pair.reach(i) * region.half[i];
      way += own;
      if (own > most) {
        most = own;
        widest = i;
      }
    }
    const double distance = pair.distance(region.middle);
    if (!(distance > margin)) return false;
    if (distance > margin + way) continue;
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
    const TablePair pair = {RobotCapsules::kCapsules[first], RobotCapsules::kCapsules[second]};
    assert_true(never_meet(pair, 0.01, regions));
    int tried = 0;
    assert_false(never_meet(pair, 0.5, tried));  // the proof can fail
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
