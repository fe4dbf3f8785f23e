// Tests JRG -> PD with gravity compensation -> simulated robot against closed-form solutions.
#include "program/heap_count.hpp"
#include "tests/oracles/kdl.hpp"
#include "tests/support/closed_loop.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

void make_ideal(PlantParams& plant) {
  plant.friction = 0.0;
  plant.rotor_inertia = JointVector::Constant(0.1);
}

// Proves SIM-4, EXE-2.

void attaching_moves_nothing(void**) {
  static ClosedLoop loop;
  make_ideal(loop.plant);
  ASSERT_OK(loop.start(1000, 1));
  ASSERT_OK(loop.run(1.0));
  for (int j = 0; j < kDof; ++j) ASSERT_NEAR(loop.hal.arm().q()[j], loop.plant.initial_q[j], 1e-9);
}

// Proves LOOP-1.

void at_rest_gravity_compensation_is_exact(void**) {
  static ClosedLoop loop;
  make_ideal(loop.plant);
  ASSERT_OK(loop.start(1000, 1));
  assert_true(loop.go(0.4, 2.0).ok());
  ASSERT_OK(loop.run(15.0));  // the UR10's last wrist joint swings with a time constant of 1 s
  for (int j = 0; j < kDof; ++j) {
    ASSERT_NEAR(loop.q_d()[j], loop.plant.initial_q[j] + 0.4, 1e-12);
    ASSERT_NEAR(loop.hal.arm().q()[j], loop.q_d()[j], 1e-6);
  }
  assert_int_equal(loop.executive.guard().telemetry().limited_cycles, 0);
}

void an_unknown_payload_sags_by_what_the_stiffness_predicts(void**) {
  static ClosedLoop loop;
  make_ideal(loop.plant);
  loop.plant.payload_kg = 1.0;
  loop.plant.payload_com = Vector3(0.02, 0.0, 0.08);
  ASSERT_OK(loop.start(1000, 1));
  ASSERT_OK(loop.run(15.0));
  const JointVector q = loop.hal.arm().q();
  const KdlTool payload = {1.0, {0.02, 0.0, 0.08}}, nothing;
  const JointVector kp = pd_stiffness();
  double with[kDof], without[kDof];
  kdl_gravity(q.data(), payload, with);
  kdl_gravity(q.data(), nothing, without);
  for (int j = 0; j < kDof; ++j) {
    ASSERT_NEAR(loop.q_d()[j] - q[j], (with[j] - without[j]) / kp[j], 1e-6);
  }
  assert_true((loop.q_d() - q).cwiseAbs().maxCoeff() > 1e-3);
}

// Proves MOD-2.

void the_tool_of_the_file_compensates_the_same_payload(void**) {
  static ClosedLoop loop;
  make_ideal(loop.plant);
  loop.plant.payload_kg = 1.0;
  loop.plant.payload_com = Vector3(0.02, 0.0, 0.08);
  ASSERT_OK(loop.start(1000, 1));
  static_cast<void>(loop.executive.stop());
  loop.pipeline.robot.tool.value.mass_kg = 1.0;
  loop.pipeline.robot.tool.value.com = loop.plant.payload_com;
  ASSERT_OK(loop.attach());
  ASSERT_OK(loop.run(3.0));
  for (int j = 0; j < kDof; ++j) ASSERT_NEAR(loop.hal.arm().q()[j], loop.plant.initial_q[j], 1e-9);
}

// Proves LOOP-4.

/// An arm that hangs from a ceiling, or stands on a wall, is held as exactly as an upright one; one
/// that is not mounted as the file says leaves its place.
void gravity_is_compensated_as_the_arm_is_mounted(void**) {
  struct Case {
    const char* key;
    Vector3 mounting;
    bool known;
  };
  static std::array<ClosedLoop, 4> loops;
  const std::array<Case, 4> cases = {{{"mounting = 3.14159265358979 0 0\n", {M_PI, 0, 0}, true},
                                      {"mounting = 0.2 1.5708 -0.7\n", {0.2, 1.5708, -0.7}, true},
                                      {"", {M_PI, 0, 0}, false},
                                      {"", {0.2, 1.5708, -0.7}, false}}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    ClosedLoop& loop = loops[i];
    const std::string blocks = std::string(cases[i].key) + kClosedLoopBlocks;
    loop.blocks = blocks.c_str();
    make_ideal(loop.plant);
    loop.plant.mounting = cases[i].mounting;
    ASSERT_OK(loop.start(1000, 1));
    const Status status = loop.run(1.0);
    const double moved = (loop.hal.arm().q() - loop.plant.initial_q).cwiseAbs().maxCoeff();
    if (cases[i].known) ASSERT_OK(status);
    print_message("moved by %.1e rad\n", moved);
    assert_true(cases[i].known ? moved < 1e-9 : moved > 5e-3);
  }
}

// Proves LOOP-2.

void halving_the_period_does_not_change_the_picture(void**) {
  static ClosedLoop slow, fast;
  for (ClosedLoop* loop : {&slow, &fast}) make_ideal(loop->plant);
  ASSERT_OK(slow.start(1000, 1));
  ASSERT_OK(fast.start(500, 1));
  assert_true(slow.go(0.4, 2.0).ok() && fast.go(0.4, 2.0).ok());
  for (int k = 0; k < 60; ++k) {
    ASSERT_OK(slow.run(0.05));
    ASSERT_OK(fast.run(0.05));
    // The loop's delay is half a millisecond shorter, at up to 0.4 rad/s.
    for (int j = 0; j < kDof; ++j)
      ASSERT_NEAR(slow.hal.arm().q()[j], fast.hal.arm().q()[j], 0.5e-3 * 0.4);
  }
}

/// Runs one motion and hashes the true joint positions of every cycle.
std::uint64_t hash_of_run(ClosedLoop& loop, std::uint64_t seed) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  if (loop.start(1000, seed) != Status::kOk || !loop.go(0.3, 1.0).ok()) return 0;
  for (int k = 0; k < 1500; ++k) {
    if (loop.run(1e-3) != Status::kOk) return 0;
    const JointVector q = loop.hal.arm().q();
    const auto* bytes = reinterpret_cast<const unsigned char*>(q.data());
    for (std::size_t i = 0; i < sizeof(double) * kDof; ++i)
      hash = (hash ^ bytes[i]) * 0x100000001b3U;
  }
  return hash;
}

// Proves SIM-3.

void the_same_seed_gives_the_same_bytes_and_another_seed_other_noise(void**) {
  static ClosedLoop first, second, other;
  for (ClosedLoop* loop : {&first, &second, &other}) loop->plant.position_noise_rad = 1e-5;
  const std::uint64_t hash = hash_of_run(first, 1);
  assert_true(hash != 0);
  assert_true(hash_of_run(second, 1) == hash);
  assert_true(hash_of_run(other, 2) != hash);
}

void without_noise_the_seed_changes_nothing(void**) {
  static ClosedLoop first, other;
  const std::uint64_t hash = hash_of_run(first, 1);
  assert_true(hash != 0 && hash_of_run(other, 2) == hash);
}

// Proves EXE-8.

void a_cycle_allocates_nothing(void**) {
  static ClosedLoop loop;
  ASSERT_OK(loop.start(1000, 1));
  assert_true(loop.go(0.3, 0.5).ok());
  const std::uint64_t before = heap_allocations();
  Status status;
  {
    const HeapWatch watch;
    status = loop.run(1.0);
  }
  ASSERT_OK(status);
  assert_true(heap_allocations() == before);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(attaching_moves_nothing),
      cmocka_unit_test(at_rest_gravity_compensation_is_exact),
      cmocka_unit_test(an_unknown_payload_sags_by_what_the_stiffness_predicts),
      cmocka_unit_test(the_tool_of_the_file_compensates_the_same_payload),
      cmocka_unit_test(gravity_is_compensated_as_the_arm_is_mounted),
      cmocka_unit_test(halving_the_period_does_not_change_the_picture),
      cmocka_unit_test(the_same_seed_gives_the_same_bytes_and_another_seed_other_noise),
      cmocka_unit_test(without_noise_the_seed_changes_nothing),
      cmocka_unit_test(a_cycle_allocates_nothing),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
