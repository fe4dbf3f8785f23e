// Measures one cycle's part of a collision check of the arm, a tool and two boxes, over seeded
// states at up to 0.3 of the speed limits. The states are free of contact, so the check looks at
// every pair.
#include <benchmark/benchmark.h>

#include "kernel/guard/collision.hpp"
#include "tests/support/model_cases.hpp"

namespace tactus {
namespace {

constexpr std::size_t kStates = 256;

void collision_check(benchmark::State& bench) {
  std::array<Cuboid, 2> boxes;
  boxes[0].pose.p = {0.55, 0.0, -0.02};
  boxes[0].size = {0.5, 0.8, 0.1};
  boxes[1].pose = {{-0.2, 0.5, 0.6}, Eigen::Quaterniond(0.8, 0.3, -0.4, 0.2).normalized()};
  boxes[1].size = {0.1, 0.2, 1.2};
  static CollisionSection section;
  section.lateness.setZero();
  section.overshoot.setZero();
  section.compliance.setZero();
  section.scene = CollisionScene();
  for (const Cuboid& box : boxes) {
    section.scene.boxes[static_cast<std::size_t>(section.scene.box_count())] = &box;
    section.scene.names[static_cast<std::size_t>(section.scene.body_count++)] = "box";
  }
  static Collision collision;
  collision.start(section, JointLimits(), {0.03, -0.02, 0.12}, 0.001);
  std::array<RobotState, kStates> states;
  RandomStates random;
  for (RobotState& state : states) {
    do {
      random.next();
      state.q = random.q;
      state.dq = 0.3 * random.dq;
    } while (collision.check(state, {0.0, 0.0, -9.81}) != Status::kOk);
  }
  std::size_t i = 0;
  for (auto _ : bench) benchmark::DoNotOptimize(collision.step(states[i++ % kStates]));
}
BENCHMARK(collision_check);

}  // namespace
}  // namespace tactus
