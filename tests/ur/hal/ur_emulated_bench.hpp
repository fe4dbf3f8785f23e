// The HAL of a UR with the emulated controller and its arm, over sockets, in lock-step.
#pragma once

#include "tests/ur/free_ports.hpp"
#include "tests/ur/hal/ur_hal_bench.hpp"

namespace tactus::ur {

inline const int kOffset = free_offset("127.0.0.1", -20000);

/// The emulated robot in a thread of its own.
class EmulatedRobot {
 public:
  explicit EmulatedRobot(const Settings& settings) : emulator_(settings), server_(emulator_) {
    assert_true(emulator_.start() == Status::kOk);
    assert_true(server_.start("127.0.0.1", kOffset));
    thread_ = std::thread([this] { run(); });
  }
  ~EmulatedRobot() {
    ends_ = true;
    thread_.join();
  }

  /// Lets the robot run `cycles` that no client answers.
  void pass(int cycles) {
    const int last = ticks_ + cycles;
    alone_ = true;
    while (ticks_ < last) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    alone_ = false;
  }

 private:
  /// Runs in lock-step: the emulator waits for a client that closes the loop, so that a busy host
  /// changes nothing.
  void run() {
    constexpr std::chrono::microseconds kCycle{2000}, kLongestWait{1000000};
    auto next = std::chrono::steady_clock::now();
    while (!ends_) {
      const Pace pace = emulator_.pace();
      const auto now = std::chrono::steady_clock::now();
      const auto patience = pace == Pace::kWaits && !alone_ ? kLongestWait : 0 * kCycle;
      if (pace != Pace::kAtOnce && now < next + patience) {
        server_.pump(200'000);
        continue;
      }
      server_.pump(0);
      emulator_.tick();
      server_.flush();
      ++ticks_;
      next = now + kCycle;
    }
  }

  Emulator emulator_;
  Server server_;
  std::thread thread_;
  std::atomic<bool> ends_{false}, alone_{false};
  std::atomic<int> ticks_{0};
};

inline std::optional<UrArmBench> g_arm;
inline std::optional<EmulatedRobot> g_robot;

inline UrArmBench& fresh_arm(const Settings& settings = {}, int period_us = 8000,
                             bool outputs = false) {
  g_arm.reset();
  g_robot.reset();
  g_robot.emplace(settings);
  UrArmBench& bench = g_arm.emplace(period_us, outputs);
  // Lateness of the host is not tested here: neither long pauses nor frequent ones.
  bench.pipeline.executive.max_slip = 1000;
  bench.pipeline.executive.max_late = 16;
  bench.pipeline.executive.late_window = 1;
  bench.settings.packet_wait = 500.0;
  bench.settings.connect_ms = bench.settings.program_ms = 2000;
  bench.settings.power_ms = 20000;
  bench.settings.rtde_port = kRtdePort + kOffset;
  bench.settings.primary_port = kPrimaryPort + kOffset;
  bench.settings.dashboard_port = kDashboardPort + kOffset;
  Tool tool;
  tool.mass_kg = 0.749;
  tool.com = {0.0, 0.0, 0.0291};
  tool.tip.p = {0.0, 0.0, 0.0905};
  bench.hal.configure(bench.settings, tool, period_us, outputs);
  return bench;
}

inline Status arm(UrArmBench& bench) {
  return bench.arm([&] { return bench.run_cycle(); });
}
/// Opens the wire and arms the drives.
inline Status start(UrArmBench& bench) {
  const Status status = bench.executive.start();
  return status == Status::kOk ? arm(bench) : status;
}

/// An arm on its way.
inline UrArmBench& moving_arm(OnProtectiveStop reaction = OnProtectiveStop::kRefuse) {
  UrArmBench& bench = fresh_arm();
  bench.settings.on_protective_stop = reaction;
  ASSERT_OK(start(bench));
  bench.send_line();
  for (int i = 0; i < 150; ++i) ASSERT_OK(bench.run_cycle());
  assert_true(bench.hal.state().dq[0] > 0.1);
  return bench;
}

inline int end_arm(void**) {
  g_arm.reset();
  g_robot.reset();
  return 0;
}

/// Somebody else at the primary port.
inline void upload(std::string_view text) {
  Socket socket;
  Message why;
  ASSERT_OK(socket.connect("127.0.0.1", kPrimaryPort + kOffset, Deadline(2000), why));
  assert_true(socket.send_some(text) && text.empty());
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

}  // namespace tactus::ur
