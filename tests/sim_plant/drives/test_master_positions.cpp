// Positions and velocities over the bus: the cyclic synchronous modes CSP and CSV, with what
// travels beside the target.
#include "tests/sim_plant/drives/fault_bench.hpp"

namespace tactus::can {
namespace {

constexpr double kStep_rad = 6.283185307179586 / 16777216.0;  // an increment
constexpr double kSpeed_rad_s = 0.1;
constexpr double kLine_s = 2.0;

constexpr const char* kPositions =
    "[robot]\nname = fer\nperiod_us = 1000\nq_c = jrg.q_d\ndq_ff = jrg.dq_d\ntau_ff = model.g\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\ntool = robot.tool\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n";
constexpr const char* kBarePositions =
    "[robot]\nname = fer\nperiod_us = 1000\nq_c = jrg.q_d\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n";
constexpr const char* kVelocities =
    "[robot]\nname = fer\nperiod_us = 1000\ndq_c = jrg.dq_d\ntau_ff = model.g\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\ntool = robot.tool\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n";
constexpr const char* kPipelines[] = {kPositions, kVelocities};

MasterBench& started(const char* pipeline, Buses buses = Buses::kFdPlain,
                     std::uint32_t velocity_unit = drives::kIncrementsPerSecond) {
  MasterBench& bench = fresh_bench(buses);
  bench.plant.velocity_unit = velocity_unit;
  ASSERT_OK(bench.load(pipeline));
  const Status status = bench.start();
  if (status != Status::kOk) print_error("%s\n", bench.hal.master.trouble().c_str());
  ASSERT_OK(status);
  return bench;
}

const JointVector& port(MasterBench& bench, const char* name) {
  return *static_cast<const JointVector*>(bench.pipeline.ports.find(name)->value);
}
std::int64_t object(MasterBench& bench, int j, std::uint16_t index) {
  return bench.hal.arm.node(j).dictionary().get(drives::find(index, 0).slot);
}

/// A straight line of joint 4.
void send_line(MasterBench& bench) {
  Trajectory<JointSpace>* line = bench.client.acquire();
  assert_non_null(line);
  line->count = 2;
  line->fields = 0;
  for (int i = 0; i < 2; ++i) {
    Waypoint<JointSpace> waypoint;
    waypoint.time_s = kLine_s * i;
    waypoint.point.q = port(bench, "jrg.q_d");
    waypoint.point.q[3] += kSpeed_rad_s * waypoint.time_s;
    line->set(i, waypoint);
  }
  std::uint32_t id = 0;
  ASSERT_OK(bench.client.send(*line, id).status);
}

/// The farthest that a joint is from where it stood before it was taken over, rad.
double moved_by_takeover(const char* pipeline, Buses buses) {
  MasterBench& bench = fresh_bench(buses);
  ASSERT_OK(bench.load(pipeline));
  const JointVector before = bench.hal.arm.arm().q();
  SafetyWatch watch(bench);
  ASSERT_OK(bench.start());
  double worst = 0.0;
  for (int i = 0; i < 1000; ++i) {
    ASSERT_OK(watch.cycle());
    const JointVector moved = bench.hal.arm.arm().q() - before;
    worst = std::max(worst, moved.cwiseAbs().maxCoeff());
  }
  for (int j = 0; j < kDof; ++j) assert_false(bench.hal.arm.node(j).axis().braked());
  return worst;
}

// Proves CAN-13.
// A torque beside the target begins at zero and reaches the weight of the arm within 20 ms, which
// the loops of the drives have carried until then and give up more slowly; a loop of velocities
// does not go back.
void the_arm_is_taken_over_without_a_step(void**) {
  for (const Buses buses : {Buses::kFdPlain, Buses::kClassicPlain}) {
    const double bare = moved_by_takeover(kBarePositions, buses);
    const double fed = moved_by_takeover(kPositions, buses);
    const double velocities = moved_by_takeover(kVelocities, buses);
    print_message("CSP %.1e rad, with a torque %.1e rad, CSV with a torque %.1e rad\n", bare, fed,
                  velocities);
    assert_true(bare < 1e-4 && fed < 3e-3 && velocities < 6e-3);
  }
}

// The targets of a cycle are in force at its SYNC; in the dictionary they stay until the next one.
void targets_and_offsets_reach_the_objects_of_the_drives(void**) {
  MasterBench& bench = started(kPositions);
  send_line(bench);
  for (int i = 0; i < 1500; ++i) {
    ASSERT_OK(bench.cycle());
    if (i < 1000) continue;
    for (int j = 0; j < kDof; ++j) {
      const double q = static_cast<double>(object(bench, j, 0x607A)) * kStep_rad;
      const double dq = static_cast<double>(object(bench, j, 0x60B1)) * kStep_rad;
      const double tau =
          1e-3 * static_cast<double>(object(bench, j, 0x60B2)) * bench.drive.rated_torque[j];
      ASSERT_NEAR(q, port(bench, "jrg.q_d")[j], kStep_rad);
      ASSERT_NEAR(dq, port(bench, "jrg.dq_d")[j], kStep_rad);
      ASSERT_NEAR(tau, port(bench, "model.g")[j], 0.51e-3 * bench.drive.rated_torque[j]);
    }
    ASSERT_NEAR(port(bench, "jrg.dq_d")[3], kSpeed_rad_s, 1e-9);
    assert_true(std::abs(object(bench, 3, 0x60B2)) > 1000);
  }
}

void target_velocities_reach_the_objects_of_the_drives(void**) {
  MasterBench& bench = started(kVelocities);
  send_line(bench);
  for (int i = 0; i < 1500; ++i) {
    ASSERT_OK(bench.cycle());
    if (i < 1000) continue;
    const double dq = static_cast<double>(object(bench, 3, 0x60FF)) * kStep_rad;
    ASSERT_NEAR(dq, kSpeed_rad_s, kStep_rad);
    ASSERT_NEAR(1e-3 * static_cast<double>(object(bench, 3, 0x60B2)) * bench.drive.rated_torque[3],
                port(bench, "model.g")[3], 0.51e-3 * bench.drive.rated_torque[3]);
  }
}

// With its velocity beside it a position is followed without a lag that grows with the speed; a
// velocity leaves the drift of an open loop. So it is with drives whose velocities are in
// thousandths of a revolution per minute.
void a_slow_line_is_followed(void**) {
  constexpr double kMost_rad[] = {2e-3, 5e-3};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t i = k % 2;
    MasterBench& bench =
        started(kPipelines[i], Buses::kFdPlain, k < 2 ? drives::kIncrementsPerSecond : 0xFDB44700U);
    send_line(bench);
    double worst = 0.0;
    for (int cycle = 0; cycle < 2500; ++cycle) {
      ASSERT_OK(bench.cycle());
      const double error = (port(bench, "jrg.q_d") - bench.hal.arm.arm().q()).cwiseAbs().maxCoeff();
      if (error > worst) worst = error;
    }
    print_message("%s: within %.1e rad\n", i == 0 ? "CSP" : "CSV", worst);
    assert_true(worst < kMost_rad[i]);
  }
}

// A drive that stops must not be pulled by the last target; after the rearm the first is where it
// is.
void a_fault_on_a_line_stops_and_a_rearm_moves_nothing(void**) {
  for (const char* pipeline : kPipelines) {
    MasterBench& bench = started(pipeline);
    SafetyWatch watch(bench);
    send_line(bench);
    for (int k = 0; k < 1000; ++k) ASSERT_OK(watch.cycle());
    inject(bench, 5, drives::FaultKind::kEmergency, 0x3210);
    for (int k = 0; k < 300; ++k) (void)watch.cycle();
    assert_false(powered(bench));
    heal(bench);
    const JointVector before = bench.hal.arm.arm().q();
    ASSERT_OK(bench.arm());
    for (int k = 0; k < 300; ++k) ASSERT_OK(watch.cycle());
    // The reference is where the arm is; what moves is the torque that comes beside it.
    assert_true((port(bench, "jrg.q_d") - before).cwiseAbs().maxCoeff() < 1e-3);
    assert_true((bench.hal.arm.arm().q() - before).cwiseAbs().maxCoeff() < 4e-3);
  }
}

void packed_commands_are_refused_for_positions(void**) {
  MasterBench& bench = fresh_bench(Buses::kFdPacked);
  ASSERT_STATUS(bench.load(kPositions), Status::kBadValue);
}

}  // namespace
}  // namespace tactus::can

int main() {
  using namespace tactus::can;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_arm_is_taken_over_without_a_step),
      cmocka_unit_test(targets_and_offsets_reach_the_objects_of_the_drives),
      cmocka_unit_test(target_velocities_reach_the_objects_of_the_drives),
      cmocka_unit_test(a_slow_line_is_followed),
      cmocka_unit_test(a_fault_on_a_line_stops_and_a_rearm_moves_nothing),
      cmocka_unit_test(packed_commands_are_refused_for_positions),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
