// The same pipeline and the same trajectory over a wire, and with the simulated robot that is
// linked in, whose measurements are as old as those of the wire: one cycle.
//
// What is left is what the wire rounds: torques to a permille of the rated torque, positions to
// 2^-24 of a turn, velocities to one of them per second.
#pragma once

#include "sim_plant/arm/sim_hal.hpp"
#include "tests/hal/cia402/loop_bench.hpp"

namespace tactus::cia402 {

inline constexpr int kRows = 4500;
using MotionLog = std::array<JointVector, kRows>;

/// There and back within 4 s, each joint by another amount.
inline void send_motion(ReferenceClient<JointSpace>& client, const JointVector& from) {
  JointVector way;
  way << 0.5, -0.3, 0.4, 0.4, -0.5, 0.5, 0.6;
  Trajectory<JointSpace>* motion = client.acquire();
  assert_non_null(motion);
  motion->count = 3;
  motion->fields = kVelocityField | kAccelerationField;
  for (int i = 0; i < 3; ++i) {
    Waypoint<JointSpace> waypoint;
    waypoint.time_s = 2.0 * i;
    waypoint.point.q = i == 1 ? JointVector(from + way) : from;
    motion->set(i, waypoint);
  }
  std::uint32_t id = 0;
  ASSERT_OK(client.send(*motion, id).status);
}

template <class Bench>
void record(Bench& bench, const JointVector& from, MotionLog& log) {
  ASSERT_OK(bench.start());
  send_motion(bench.client, from);
  for (JointVector& row : log) {
    ASSERT_OK(bench.cycle());
    row = bench.pipeline.robot.q.value;
  }
}

inline void record_in_the_process(PlantParams plant, MotionLog& log) {
  static LoopBench<SimHal> bench;
  plant.delay_cycles = 1;
  ASSERT_OK(bench.hal.load(plant, 1));
  bench.hal.set_period(1e-3);
  ASSERT_OK(bench.load(kHoldingPipeline, bench.hal.capabilities()));
  record(bench, plant.initial_q, log);
}

/// Half a step of the torque, as far as it moves the spring that the controller is, and an
/// increment of the position, rad.
inline double rounding(const Cia402Settings& drive, int j) {
  constexpr double kStiffness_Nm_rad[] = {500, 400, 400, 300, 20, 20, 10};  // of kHoldingPipeline
  const double step_Nm = 1e-3 * drive.rated_torque[j];
  return 0.5 * step_Nm / kStiffness_Nm_rad[j] + 6.2832 / drive.increments[j];
}

/// Fails if a motion over the wire of a bench that is loaded differs by more than it rounds.
template <class Bench>
void compare_with_the_linked_in_robot(Bench& bench) {
  static MotionLog wire, process;
  const PlantParams& plant = bench.plant.plant;
  record(bench, plant.initial_q, wire);
  record_in_the_process(plant, process);
  JointVector largest = JointVector::Zero(), way = JointVector::Zero();
  for (std::size_t i = 0; i < kRows; ++i) {
    largest = largest.cwiseMax((wire[i] - process[i]).cwiseAbs());
    way = way.cwiseMax((wire[i] - plant.initial_q).cwiseAbs());
  }
  for (int j = 0; j < kDof; ++j) {
    print_message("joint %d: moved %.3f rad, differs by %.1e rad of %.1e\n", j + 1, way[j],
                  largest[j], rounding(bench.drive, j));
    assert_true(way[j] > 0.29);
    assert_true(largest[j] <= rounding(bench.drive, j));
  }
}

}  // namespace tactus::cia402
