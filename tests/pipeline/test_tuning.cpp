// Tests parameters that change while a shipped pipeline moves its arm: no command steps, and what
// is refused changes nothing.
#include <algorithm>
#include <cstring>

#include "tests/pipeline/tuning_bench.hpp"

namespace tactus {
namespace {

constexpr double kRun_s = 7.0;
constexpr double kMoving_s = 3.0;  // from here on the arms are on their way
constexpr double kSettles_s = 9.0;

/// Largest step of each joint's command from one cycle to the next in a run without changes.
JointVector own_steps(const std::string& name, std::uint32_t& limited) {
  const auto run = std::make_unique<TuningBench>();
  run->start(name);
  JointVector most = JointVector::Zero();
  run->bench.cycle();
  while (run->bench.time_s() < kRun_s) {
    const JointVector last = run->command();
    run->bench.cycle();
    most = most.cwiseMax((run->command() - last).cwiseAbs());
  }
  limited = run->bench.limited();
  return most;
}

// Proves PAR-4.

/// Sets of parameters from half to twice those of the file, at random moments of a motion. A law is
/// linear in its gains: with gains twice as large its own steps are at most twice as large, on a
/// way that differs by as much again; torques have the fade besides, half the torque rate. Position
/// and velocity laws keep their acceleration limit in every cycle. So the guard limits no more
/// often than without changes.
void no_command_steps_when_gains_change_at_any_moment(void**) {
  for (const std::string& name : tuned_pipelines()) {
    std::uint32_t limited = 0;
    const JointVector own = own_steps(name, limited);
    Random random{1};
    const auto run = std::make_unique<TuningBench>();
    run->start(name);
    const JointLimits& limits = run->bench.pipeline.guard.limits;
    const double dt = run->bench.pipeline.robot.period_s();
    run->bench.cycle();
    int sets = 0;
    double worst = 0.0;
    while (run->bench.time_s() < kRun_s) {
      const JointVector last = run->command();
      if (random.below(static_cast<int>(0.15 / dt)) == 0)
        sets += run->change(run->scaled(random, 0.5, 0.5, 2.0)).status == Status::kOk;
      run->bench.cycle();
      const JointVector fade = run->gives_torques() ? JointVector(0.5 * dt * limits.dtau_max)
                                                    : JointVector(JointVector::Zero());
      const JointVector bound = 4.0 * own + fade;
      worst =
          std::max(worst, ((run->command() - last).cwiseAbs().array() / bound.array()).maxCoeff());
    }
    print_message("%s: %d sets, largest step %.2g of the bound, limited %u cycles, without %u\n",
                  name.c_str(), sets, worst, run->bench.limited(), limited);
    assert_true(sets > 15);
    assert_true(worst <= 1.0);
    assert_true(run->bench.limited() <= limited);
  }
}

/// The joint velocities that the pose law commands, in every cycle, whatever gains are set.
void the_pose_law_keeps_its_acceleration_limit_with_the_extremes_of_its_gains(void**) {
  need_one_of({"fer_trg_cpc", "ur10_trg_cpc"});
  const std::string name = of_this_robot("_trg_cpc");
  const auto run = std::make_unique<TuningBench>();
  run->start(name);
  const JointVector most = run->bench.pipeline.guard.limits.ddq_max *
                           run->bench.pipeline.robot.period_s() * (1.0 + 1e-9);
  Random random{9};
  while (run->bench.time_s() < kRun_s) {
    const JointVector last = run->bench.output<JointVector>("cpc.dq_c");
    if (random.below(100) == 0) {
      const char* gain = random.below(2) == 0 ? "0" : "490 490 490";
      const Status taken =
          run->change({{"cpc", "position_gain", gain[0] == '0' ? "0 0 0" : gain}}).status;
      ASSERT_OK(taken);
    }
    run->bench.cycle();
    const JointVector now = run->bench.output<JointVector>("cpc.dq_c");
    assert_true(((now - last).cwiseAbs().array() <= most.array()).all());
  }
}

/// True if a law of torques has an error that 1e9 N m/rad would turn into more than any joint has.
bool errs(const PipelineBench& bench) {
  if (!bench.pipeline.robot.tau_c.wired()) return false;
  const bool joints = bench.pipeline.ports.find("jrg.q_d") != nullptr;
  const JointVector e = bench.output<JointVector>(joints ? "jrg.q_d" : "cpc.q_c") -
                        bench.output<JointVector>("robot.q");
  return e.cwiseAbs().maxCoeff() > 1e-6;
}

// Proves PAR-3.

/// Two runs, one of which is asked for what is refused: outside the cycle, and in it. The bits of
/// their commands are the same.
void refused_sets_change_no_bit_of_the_commands(void**) {
  for (const std::string& name : tuned_pipelines()) {
    const auto run = std::make_unique<TuningBench>(), twin = std::make_unique<TuningBench>();
    run->start(name);
    twin->start(name);
    Random random{4};
    int refused = 0, in_cycle = 0;
    const std::string law = name.find("pdgc") != std::string::npos ? "pd" : "pid";
    while (run->bench.time_s() < kMoving_s + 2.0) {
      auto set = run->scaled(random, 0.5, 0.5, 2.0);
      set.insert(set.begin() + random.below(static_cast<int>(set.size()) + 1),
                 {"guard", "max_torque", "1"});
      if (random.below(3) == 0 && errs(run->bench)) {
        set = {{law, "kp", "1e9"}};
        ++in_cycle;
      }
      assert_true(run->change(set).status != Status::kOk);
      ++refused;
      run->bench.cycle();
      twin->bench.cycle();
      assert_memory_equal(run->command().data(), twin->command().data(), sizeof(JointVector));
      assert_memory_equal(run->position().data(), twin->position().data(), sizeof(JointVector));
    }
    print_message("%s: %d sets refused, %d of them in the cycle\n", name.c_str(), refused,
                  in_cycle);
    if (run->gives_torques()) assert_true(in_cycle > 100);
    assert_true(refused > 500);
  }
}

// Proves PAR-5.

/// Some time after gains were changed there and back, the arm is where its twin is.
void gains_that_are_changed_and_changed_back_leave_the_steady_state(void**) {
  for (const std::string& name : tuned_pipelines()) {
    const auto run = std::make_unique<TuningBench>(), twin = std::make_unique<TuningBench>();
    run->start(name);
    twin->start(name);
    Random random{6};
    const auto there = run->scaled(random, 2.0, 1.5, 1.5),
               back = run->scaled(random, 2.0, 1.0, 1.0);
    const double period_s = run->bench.pipeline.robot.period_s();
    const std::int64_t first = std::lround(kMoving_s / period_s), last = 2 * first;
    while (run->bench.cycles <= last) {
      if (run->bench.cycles == first) ASSERT_OK(run->change(there).status);
      if (run->bench.cycles == last) ASSERT_OK(run->change(back).status);
      run->bench.cycle();
      twin->bench.cycle();
    }
    while (run->bench.time_s() < 2.0 * kMoving_s + kSettles_s) {
      run->bench.cycle();
      twin->bench.cycle();
    }
    const double apart = (run->position() - twin->position()).cwiseAbs().maxCoeff();
    print_message("%s: %.2g rad apart\n", name.c_str(), apart);
    assert_true(apart < 1e-3);
  }
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_command_steps_when_gains_change_at_any_moment),
      cmocka_unit_test(the_pose_law_keeps_its_acceleration_limit_with_the_extremes_of_its_gains),
      cmocka_unit_test(refused_sets_change_no_bit_of_the_commands),
      cmocka_unit_test(gains_that_are_changed_and_changed_back_leave_the_steady_state),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
