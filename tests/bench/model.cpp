// Measures the rigid-body algorithms over 64 seeded states and compares them with Orocos KDL and
// with the C library's sine and cosine. "trig given" shares sines and cosines, as the cycle does;
// our algorithms carry a tool.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <random>

#include "kernel/model/forward_kinematics.hpp"
#include "kernel/model/gravity.hpp"
#include "kernel/model/inverse_dynamics.hpp"
#include "kernel/model/robot_model.hpp"
#include "tests/bench/kdl_peer.hpp"

namespace tactus {
namespace {

struct JointState {
  JointVector q, dq, ddq;
  JointTrig<Robot> trig;
};

constexpr std::size_t kStates = 64;

std::array<JointState, kStates> random_states() {
  std::mt19937_64 random(20250607);
  std::uniform_real_distribution<double> angle(-2.9, 2.9), rate(-2.0, 2.0);
  std::array<JointState, kStates> states;
  for (JointState& state : states) {
    for (int i = 0; i < kDof; ++i) {
      state.q[i] = angle(random);
      state.dq[i] = rate(random);
      state.ddq[i] = rate(random);
    }
    state.trig = joint_trig<Robot>(state.q);
  }
  return states;
}

const std::array<JointState, kStates> kJointStates = random_states();

Tool hand() {
  Tool tool;
  tool.mass_kg = 0.73;
  tool.com = {-0.01, 0.0, 0.03};
  tool.tip.p = {0.0, 0.0, 0.1034};
  return tool;
}
const Tool kHand = hand();

/// Times `compute(state)`, which returns its result, over all states in turn.
template <class Compute>
void over_states(benchmark::State& loop, Compute compute) {
  std::size_t n = 0;
  for (auto _ : loop) {
    auto result = compute(kJointStates[n++ % kStates]);
    benchmark::DoNotOptimize(result);
  }
}

struct Tip {
  Pose x;
  Jacobian J;
};

void sincos_of_all_joints(benchmark::State& loop) {
  over_states(loop, [](const JointState& s) { return joint_trig<Robot>(s.q); });
}
void sincos_of_all_joints_libm(benchmark::State& loop) {
  over_states(loop, [](const JointState& s) {
    JointTrig<Robot> trig;
    for (std::size_t i = 0; i < kDof; ++i) {
      const double angle = s.q[static_cast<int>(i)];
      trig[i] = {std::sin(angle), std::cos(angle)};
    }
    return trig;
  });
}
BENCHMARK(sincos_of_all_joints);
BENCHMARK(sincos_of_all_joints_libm);

void kinematics_trig_given(benchmark::State& loop) {
  over_states(loop, [](const JointState& s) {
    Tip tip;
    tip.x = forward_kinematics<Robot>(s.trig, kHand.tip, tip.J);
    return tip;
  });
}
void kinematics(benchmark::State& loop) {
  over_states(loop, [](const JointState& s) {
    Tip tip;
    tip.x = forward_kinematics<Robot>(joint_trig<Robot>(s.q), kHand.tip, tip.J);
    return tip;
  });
}
void kinematics_kdl(benchmark::State& loop) {
  over_states(loop, [](const JointState& s) {
    std::array<double, 3 + 9 + 6 * kDof> tip;
    kdl_peer_forward_kinematics(s.q.data(), &tip[0], &tip[3], &tip[12]);
    return tip;
  });
}
BENCHMARK(kinematics_trig_given);
BENCHMARK(kinematics);
BENCHMARK(kinematics_kdl);

void gravity_trig_given(benchmark::State& loop) {
  over_states(loop, [](const JointState& s) { return gravity<Robot>(s.trig, kHand); });
}
void gravity_alone(benchmark::State& loop) {
  over_states(loop,
              [](const JointState& s) { return gravity<Robot>(joint_trig<Robot>(s.q), kHand); });
}
void gravity_kdl(benchmark::State& loop) {
  over_states(loop, [](const JointState& s) {
    JointVector g;
    kdl_peer_gravity(s.q.data(), g.data());
    return g;
  });
}
BENCHMARK(gravity_trig_given);
BENCHMARK(gravity_alone);
BENCHMARK(gravity_kdl);

void inverse_dynamics_trig_given(benchmark::State& loop) {
  over_states(loop, [](const JointState& s) {
    return inverse_dynamics<Robot>(s.trig, s.dq, s.ddq, kHand);
  });
}
void inverse_dynamics_alone(benchmark::State& loop) {
  over_states(loop, [](const JointState& s) {
    return inverse_dynamics<Robot>(joint_trig<Robot>(s.q), s.dq, s.ddq, kHand);
  });
}
void inverse_dynamics_kdl(benchmark::State& loop) {
  over_states(loop, [](const JointState& s) {
    JointVector tau;
    kdl_peer_inverse_dynamics(s.q.data(), s.dq.data(), s.ddq.data(), tau.data());
    return tau;
  });
}
BENCHMARK(inverse_dynamics_trig_given);
BENCHMARK(inverse_dynamics_alone);
BENCHMARK(inverse_dynamics_kdl);

/// The whole block as the cycle calls it: trig, pose, Jacobian, twist, gravity, checks.
void robot_model_step(benchmark::State& loop) {
  RobotModel model;
  model.tool.source = &kHand;
  over_states(loop, [&model](const JointState& s) {
    model.q.source = &s.q;
    model.dq.source = &s.dq;
    const Status status = model.step(1e-3);
    benchmark::ClobberMemory();
    return status;
  });
}
BENCHMARK(robot_model_step);

}  // namespace
}  // namespace tactus

BENCHMARK_MAIN();
