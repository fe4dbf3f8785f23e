// The same pipeline and the same trajectory over the segment, and with the simulated robot that is
// linked in, whose measurements are as old as those of the segment: one cycle.
//
// What is left is what the process data round: torques to a permille of the rated torque, positions
// to 2^-24 of a turn, velocities to one of them per second.
#include "sim_plant/arm/sim_hal.hpp"
#include "tests/ethercat/master_bench.hpp"

namespace tactus::ethercat {
namespace {

constexpr int kRows = 4500;
using Log = std::array<JointVector, kRows>;

struct Rig {
  ChannelMemory<JointSpace> channel;
  std::array<Waypoint<JointSpace>, 16> waypoints;
  RoomyPipeline pipeline;
  ReferenceClient<JointSpace> client{channel};
};

/// There and back within 4 s, each joint by another amount.
void send_motion(ReferenceClient<JointSpace>& client, const JointVector& from) {
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

template <class Cycle>
void record(Cycle cycle, const Pipeline& pipeline, Log& log) {
  for (JointVector& row : log) {
    ASSERT_OK(cycle());
    row = pipeline.robot.q.value;
  }
}

void record_over_the_segment(MasterBench& bench, const JointVector& from, Log& log) {
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  send_motion(bench.client, from);
  record([&] { return bench.cycle(); }, bench.pipeline, log);
}

void record_in_the_process(const PlantParams& segment_plant, const JointVector& from, Log& log) {
  static Rig rig;
  static SimHal hal;
  static Executive executive{hal, rig.pipeline};
  rig.channel.stores[0].waypoints = rig.waypoints.data();
  rig.channel.stores[0].capacity = static_cast<int>(rig.waypoints.size());
  PlantParams plant = segment_plant;
  plant.delay_cycles = 1;
  ASSERT_OK(hal.load(plant, 1));
  hal.set_period(1e-3);
  Loader loader({&rig.channel}, hal.capabilities());
  LoadError error;
  ASSERT_OK(loader.load(kHoldingPipeline, rig.pipeline, error));
  ASSERT_OK(executive.start());
  std::int64_t now_ns = -1'000'000;
  const auto cycle = [&] { return executive.cycle({now_ns += 1'000'000}); };
  Status status = executive.arm();
  while (status == Status::kArming) {
    (void)cycle();
    status = executive.arm();
  }
  ASSERT_OK(status);
  send_motion(rig.client, from);
  record(cycle, rig.pipeline, log);
}

/// Half a step of the torque, as far as it moves the spring that the controller is, and an
/// increment of the position, rad.
double bound(const cia402::Cia402Settings& drive, int j) {
  constexpr double kStiffness_Nm_rad[] = {500, 400, 400, 300, 20, 20, 10};  // of kHoldingPipeline
  const double step_Nm = 1e-3 * drive.rated_torque[j];
  return 0.5 * step_Nm / kStiffness_Nm_rad[j] + 6.2832 / drive.increments[j];
}

// Proves ECAT-7.
void the_segment_changes_a_motion_by_no_more_than_it_rounds(void**) {
  static Log segment, process;
  static MasterBench bench;
  const PlantParams plant = bench.plant.plant;
  record_over_the_segment(bench, plant.initial_q, segment);
  record_in_the_process(plant, plant.initial_q, process);
  JointVector largest = JointVector::Zero(), way = JointVector::Zero();
  for (std::size_t i = 0; i < kRows; ++i) {
    largest = largest.cwiseMax((segment[i] - process[i]).cwiseAbs());
    way = way.cwiseMax((segment[i] - plant.initial_q).cwiseAbs());
  }
  for (int j = 0; j < kDof; ++j) {
    print_message("joint %d: moved %.3f rad, differs by %.1e rad of %.1e\n", j + 1, way[j],
                  largest[j], bound(bench.drive, j));
    assert_true(way[j] > 0.29);
    assert_true(largest[j] <= bound(bench.drive, j));
  }
  const LineCounts& counts = bench.hal.master.counts();
  assert_true(counts.frames > kRows);
  assert_int_equal(counts.lost + counts.late + counts.counter + counts.strange, 0);
}

}  // namespace
}  // namespace tactus::ethercat

int main() {
  using namespace tactus::ethercat;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_segment_changes_a_motion_by_no_more_than_it_rounds),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
