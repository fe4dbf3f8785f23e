// The bench of the UR HAL's tests: the HAL between an executive, whose pipeline has one block, and
// a controller.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <optional>

#include "gateway/reference_client.hpp"
#include "hal/ur/ur_hal.hpp"
#include "kernel/cycle/executive.hpp"
#include "kernel/load/loader.hpp"
#include "tests/ur/hal/ur_fake_controller.hpp"

namespace tactus::ur {

/// The pipeline file after the period.
inline constexpr std::string_view kUrPipeline = R"(
name = ur10
q_c  = jrg.q_d
[jrg]
type          = joint_reference_generator
q             = robot.q
speed_scaling = robot.speed_scaling
)";

/// Executive, pipeline and HAL; the controller is whichever answers at the ports.
struct UrArmBench {
  Text<255> file{"[robot]\nperiod_us = "};
  UrSettings settings;
  UrHal hal;
  std::array<Waypoint<JointSpace>, 8> waypoints;
  ChannelMemory<JointSpace> channel;
  ReferenceClient<JointSpace> client{channel};
  RoomyPipeline pipeline;
  Executive executive{hal, pipeline};

  /// With `outputs` the pipeline puts digital outputs out.
  explicit UrArmBench(int period_us = 8000, bool outputs = false) {
    file << period_us << (outputs ? "\noutputs = jrg.outputs" : "") << kUrPipeline;
    channel.stores[0].waypoints = waypoints.data();
    channel.stores[0].capacity = static_cast<int>(waypoints.size());
    Loader loader({&channel}, hal.capabilities());
    LoadError error;
    if (loader.load(file, pipeline, error) != Status::kOk) {
      std::fprintf(stderr, "%s\n", error.message().c_str());
      std::abort();
    }
    settings.address = Value("127.0.0.1");
    settings.connect_ms = 1000;  // however busy the host is
    settings.program_ms = settings.power_ms = 300;
  }

  Status run_cycle() {
    CycleTime now;
    const Status status = hal.wait(now);
    return status == Status::kOk ? executive.cycle(now) : status;
  }
  /// Asks for the drives, and runs `cycle` until they are commanded or will not be.
  template <class Cycle>
  Status arm(Cycle cycle) {
    Status status = executive.arm();
    while (status == Status::kArming) {
      status = cycle();
      if (status == Status::kArming) status = executive.arm();
    }
    return status;
  }
  bool drives_are(DriveState state) {
    RobotState read;
    ASSERT_OK(hal.read({}, read));
    return std::all_of(read.drives.begin(), read.drives.end(),
                       [&](const Drive& drive) { return drive.state == state; });
  }
  double reference() const {
    return (*static_cast<const JointVector*>(pipeline.ports.find("jrg.q_d")->value))[0];
  }
  /// Sends a line of one radian of joint 1 in three seconds, from rest to rest, which begins with
  /// the next cycle.
  std::uint32_t send_line() {
    Trajectory<JointSpace>* line = client.acquire();
    assert_non_null(line);
    line->count = 2;
    line->fields = kVelocityField | kAccelerationField;
    for (Waypoint<JointSpace>& waypoint : waypoints) {
      waypoint = {};
      waypoint.point.q = hal.state().q;
    }
    waypoints[1].time_s = 3.0;
    waypoints[1].point.q[0] += 1.0;
    std::uint32_t id = 0;
    const Verdict verdict = client.send(*line, id);
    if (!verdict.ok()) print_error("%s\n", name(verdict.status));
    assert_true(verdict.ok());
    return id;
  }
  bool says(std::string_view part) {
    const Message text = hal.trouble();
    if (std::string_view(text).find(part) != std::string_view::npos) return true;
    std::fprintf(stderr, "'%.*s' is not in '%s'\n", static_cast<int>(part.size()), part.data(),
                 text.c_str());
    return false;
  }
};

/// The bench with the fake controller.
struct UrHalBench : UrArmBench {
  FakeController robot;

  ~UrHalBench() { robot.stop(); }

  /// Connects to a controller that sends by itself; from then on it is led by hand.
  Status connect() {
    if (robot.rtde_port() == 0) robot.start();
    robot.by_itself();
    settings.rtde_port = robot.rtde_port();
    settings.primary_port = robot.primary_port();
    settings.dashboard_port = robot.dashboard_port();
    hal.configure(settings, Tool{}, 8000);
    const Status status = executive.start();
    robot.by_hand();
    return status;
  }
  /// In every cycle the controller has taken what was sent in the one before.
  Status arm() {
    return UrArmBench::arm([this] {
      robot.settle();
      return cycle();
    });
  }
  /// Up to a program that holds the arm, and the first cycle that commands it.
  Status start() {
    Status status = connect();
    if (status == Status::kOk) status = arm();
    return status == Status::kOk ? cycle() : status;
  }
  /// Sends a package, `periods` after the previous one, and runs its cycle.
  Status cycle(double periods = 1.0) {
    robot.send_package(periods);
    const double before = settings.packet_wait;
    settings.packet_wait = 500.0;  // it arrives, however busy the host
    const Status status = run_cycle();
    settings.packet_wait = before;
    return status;
  }
  Status cycles(int count) {
    Status status = Status::kOk;
    for (int i = 0; i < count && status == Status::kOk; ++i) {
      status = cycle();
      if (status == Status::kOk) robot.set_point(hal.set_points());
    }
    return status;
  }
};

/// That of a process: a failed assertion would not destroy one on the stack.
inline std::optional<UrHalBench> g_bench;

inline int end_bench(void**) {
  g_bench.reset();
  return 0;
}

}  // namespace tactus::ur
