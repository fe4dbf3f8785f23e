// Measures the motion law over 64 seeded states of the FER: one plan, one stretched plan, and the
// work of a cycle for seven synchronised axes.
#include <benchmark/benchmark.h>

#include "tests/math/axis_cases.hpp"

namespace tactus {
namespace {

constexpr std::size_t kStates = 64, kAxes = kFerAxes.size();

struct Case {
  std::array<AxisState, kAxes> state;
  std::array<double, kAxes> target;
};

std::array<Case, kStates> random_arms() {
  AxisRandom random;
  std::array<Case, kStates> arms;
  for (Case& arm : arms)
    for (std::size_t i = 0; i < kAxes; ++i) {
      arm.state[i] = random_inside(random, kFerAxes[i]);
      arm.target[i] = random.between(-2.5, 2.5);
    }
  return arms;
}
const std::array<Case, kStates> kArms = random_arms();

void axis_plan_to(benchmark::State& loop) {
  std::size_t n = 0;
  for (auto _ : loop) {
    const Case& arm = kArms[n++ % kStates];
    benchmark::DoNotOptimize(plan_to(arm.state[0], arm.target[0], 0.0, kFerAxes[0]));
  }
}
void axis_plan_inside(benchmark::State& loop) {
  std::size_t n = 0;
  for (auto _ : loop) {
    const Case& arm = kArms[n++ % kStates];
    benchmark::DoNotOptimize(plan_inside(arm.state[0], arm.target[0], kFerAxes[0], -2.9, 2.9));
  }
}
void seven_axes_planned_stretched_and_sampled(benchmark::State& loop) {
  std::size_t n = 0;
  for (auto _ : loop) {
    const Case& arm = kArms[n++ % kStates];
    std::array<AxisPlan, kAxes> plans;
    double longest = 0.0;
    for (std::size_t i = 0; i < kAxes; ++i) {
      plans[i] = plan_to(arm.state[i], arm.target[i], 0.0, kFerAxes[i]);
      longest = std::max(longest, plans[i].duration());
    }
    for (std::size_t i = 0; i < kAxes; ++i) {
      stretch(plans[i], arm.state[i], arm.target[i], 0.0, kFerAxes[i], longest);
      benchmark::DoNotOptimize(plans[i].at(1e-3));
    }
  }
}
BENCHMARK(axis_plan_to);
BENCHMARK(axis_plan_inside);
BENCHMARK(seven_axes_planned_stretched_and_sampled);

}  // namespace
}  // namespace tactus
