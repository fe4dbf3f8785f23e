// The HAL of a UR between an executive with a pipeline of one block and a controller made of bytes:
// the bench of its tests.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <optional>

#include "gateway/reference_client.hpp"
#include "hal/ur/ur_hal.hpp"
#include "kernel/executive.hpp"
#include "kernel/loader.hpp"
#include "tests/ur_fake_controller.hpp"

namespace tactus::ur {

/// What follows the period.
inline constexpr std::string_view kUrPipeline = R"(
name = ur10
q_c  = jrg.q_d
[jrg]
type          = joint_reference_generator
q             = robot.q
speed_scaling = robot.speed_scaling
)";

/// Executive, pipeline and HAL; the controller is whoever answers at the ports.
struct UrArmBench {
  Text<255> file{"[robot]\nperiod_us = "};
  UrSettings settings;
  UrHal hal;
  std::array<Waypoint<JointSpace>, 8> waypoints;
  ReferenceChannel<JointSpace> channel;
  ReferenceClient<JointSpace> client{channel};
  Pipeline pipeline;
  Executive executive{hal, pipeline, nullptr};

  explicit UrArmBench(int period_us = 8000) {
    file << period_us << kUrPipeline;
    channel.stores[0].waypoints = waypoints.data();
    channel.stores[0].capacity = static_cast<int>(waypoints.size());
    Loader loader({&channel}, hal.capabilities());
    LoadError error;
    if (loader.load(file, pipeline, error) != Status::kOk) {
      std::fprintf(stderr, "%s\n", error.message().c_str());
      std::abort();
    }
    settings.address = Value("127.0.0.1");
    settings.connect_ms = settings.program_ms = settings.power_ms = 300;
  }

  Status run_cycle() { return executive.cycle({hal.wait()}); }
  double reference() const {
    return (*static_cast<const JointVector*>(pipeline.ports.find("jrg.q_d")->value))[0];
  }
  /// One radian of joint 1 in three seconds, from rest to rest; begins with the next cycle.
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

/// With a controller made of bytes.
struct UrHalBench : UrArmBench {
  FakeController robot;

  ~UrHalBench() { robot.stop(); }

  /// The controller begins; the executive starts; from then on the controller is led by hand.
  Status start() {
    if (robot.rtde_port() == 0) robot.start();
    robot.by_itself();
    settings.rtde_port = robot.rtde_port();
    settings.primary_port = robot.primary_port();
    settings.dashboard_port = robot.dashboard_port();
    hal.configure(settings, Tool{}, 8000);
    const Status status = executive.start();
    robot.by_hand();
    return status == Status::kOk ? drain() : status;
  }
  /// What was sent before the controller was led by hand, and one package more, is one cycle.
  Status drain() {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    return cycle();
  }
  /// A package, `periods` after the one before, and its cycle.
  Status cycle(double periods = 1.0) {
    robot.send_package(periods);
    const double before = settings.packet_wait;
    settings.packet_wait = 500.0;  // it comes, however late on a host that is busy
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

}  // namespace tactus::ur
