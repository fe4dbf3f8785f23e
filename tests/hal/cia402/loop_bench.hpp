// The whole loop of the FER as CiA 402 drives, without sockets and without a clock: executive and
// pipeline here; the Hal, in which master, wire and emulated drives are, is the wire's own.
#pragma once

#include <string>

#include "gateway/reference_client.hpp"
#include "hal/cia402/drive_hal.hpp"
#include "hal/cia402/drives.hpp"
#include "kernel/cycle/executive.hpp"
#include "kernel/load/loader.hpp"
#include "tests/support/testing.hpp"

namespace tactus::cia402 {

inline constexpr const char* kHoldingPipeline =
    "[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\ntool = robot.tool\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n"
    "kp = 500 400 400 300 20 20 10\nkd = 50 40 40 5 2 2 1\n";

/// What the log says of drives since event `from`: joints and codes of a cause.
struct Detail {
  std::string joints;  ///< as digits, from 1
  std::uint32_t code = 0;
};
template <class Bench>
Detail detail_of(const Bench& bench, Cause cause, std::uint32_t from = 0) {
  Detail told;
  Event event;
  for (std::uint32_t i = from; bench.executive.events().read(i, event); ++i) {
    if (event.cause != cause) continue;
    told.joints += static_cast<char>('1' + event.joint);
    told.code = event.code;
  }
  return told;
}

/// A pipeline, what sends it references, and where they are.
struct LoopRig {
  ChannelMemory<JointSpace> channel;
  std::array<Waypoint<JointSpace>, 16> waypoints;
  ReferenceClient<JointSpace> client{channel};
  RoomyPipeline pipeline;

  Status load(const char* text, const Capabilities& offered) {
    channel.stores[0].waypoints = waypoints.data();
    channel.stores[0].capacity = static_cast<int>(waypoints.size());
    Loader loader({&channel}, offered);
    LoadError error;
    const Status status = loader.load(text, pipeline, error);
    if (status != Status::kOk) print_error("%s\n", error.message().c_str());
    return status;
  }
  std::int64_t period_ns() const { return std::int64_t{1000} * pipeline.robot.period_us; }
};

template <class WiredHal>
struct LoopBench : LoopRig {
  Cia402Settings drive;
  WiredHal hal;
  Executive executive{hal, pipeline};
  std::int64_t now_ns = -1'000'000;

  LoopBench() { drive.rated_torque << 3.0, 3.0, 3.0, 3.0, 0.5, 0.5, 0.5; }
  Status cycle() { return executive.cycle({now_ns += period_ns()}); }
  Status cycles(int count) {
    Status status = Status::kOk;
    for (int i = 0; i < count && status == Status::kOk; ++i) status = cycle();
    return status;
  }
  /// Asks for the drives and runs cycles until they are taken over or refused.
  Status arm() {
    Status status = executive.arm();
    while (status == Status::kArming) {
      status = cycle();
      if (status == Status::kArming) status = executive.arm();
    }
    return status;
  }
  /// Connects, and begins the time of the cycles anew.
  Status connect() {
    const Status status = executive.start();
    now_ns = -period_ns();
    return status;
  }
  Status start() {
    TRY(connect());
    return arm();
  }
  /// Cycles until the drives are disabled, or at most `most`; returns their number.
  int settle(int most = 3000) {
    int count = 0;
    while (count < most && executive.busy()) {
      (void)cycle();
      ++count;
    }
    return count;
  }
};

/// A start tells the serial numbers of the drives as a line for the file; none if the file has
/// them.
template <class Fresh>
void assert_serials_are_told_until_stated(Fresh fresh) {
  auto& bench = fresh();
  ASSERT_OK(bench.load());
  ASSERT_OK(bench.start());
  assert_string_equal(bench.hal.master.unstated().c_str(),
                      "[cia402] serial = 1001 1002 1003 1004 1005 1006 1007");
  auto& stated = fresh();
  stated.drive.serial << 1001, 1002, 1003, 1004, 1005, 1006, 1007;
  ASSERT_OK(stated.load());
  ASSERT_OK(stated.start());
  assert_true(stated.hal.master.unstated().empty());
}

}  // namespace tactus::cia402
