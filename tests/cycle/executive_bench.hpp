// The bench of the executive's tests: an executive between a robot that records its calls, a
// pipeline of two blocks loaded from text, and a stopwatch that the robot advances.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <optional>

#include "gateway/reference_client.hpp"
#include "kernel/cycle/executive.hpp"
#include "kernel/load/loader.hpp"
#include "tests/support/armed.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

/// A stopwatch that runs only when the test advances it.
inline std::uint64_t g_stopwatch_ns = 0;
inline std::uint64_t stopwatch() {
  return g_stopwatch_ns;
}

/// Keeps a diary: s connect, r read, and w, a, d the write to drives that are to follow, to arm, to
/// be disabled; rows add a letter of their own. The drives obey at once, unless they are told not
/// to.
class FakeHal final : public Hal {
 public:
  RobotState state;      // what is measured
  RobotCommand command;  // what the drives followed last
  RobotCommand sent;     // the last one, on any rung
  Status connect_status = Status::kOk, read_status = Status::kOk, write_status = Status::kOk;
  Status disconnect_status = Status::kOk;
  std::uint64_t read_ns = 0, write_ns = 0;  // how long reading and writing take
  int reads = 0, writes = 0, stops = 0;     // writes: to drives that follow
  std::int64_t delay_ns = 0;                // age of the state
  bool obeys = true;

  FakeHal() { all(DriveState::kDisabled); }

  Capabilities capabilities() const override {
    return {true, true, true, 100, 100000, true, true, true, 0xff};
  }
  Status connect(CommandMode) override {
    note('s');
    return connect_status;
  }
  Status read(const CycleTime& now, RobotState& measured) override {
    note('r');
    ++reads;
    g_stopwatch_ns += read_ns;
    state.stamp_ns = now.stamp_ns - delay_ns;
    measured = state;
    return read_status;
  }
  Status write(const RobotCommand& its_command) override {
    sent = its_command;
    g_stopwatch_ns += write_ns;
    const bool follow = sent.request == DriveRequest::kFollow;
    const bool disable = sent.request == DriveRequest::kDisable;
    note(follow ? 'w' : disable ? 'd' : 'a');
    writes += follow ? 1 : 0;
    stops += disable && enabled() ? 1 : 0;
    if (obeys) all(disable ? DriveState::kDisabled : DriveState::kEnabled);
    if (follow) command = sent;
    return write_status;
  }
  Status disconnect() override {
    all(DriveState::kDisabled);
    return disconnect_status;
  }

  bool enabled() const { return state.drives[0].state == DriveState::kEnabled; }
  void all(DriveState drives) { state.drives.fill({drives, true}); }

  void note(char letter) {
    if (length_ + 1 < diary_.size()) diary_[length_++] = letter;
  }
  /// Returns the events since the last call.
  const char* diary() {
    diary_[length_] = '\0';
    length_ = 0;
    return diary_.data();
  }

 private:
  std::array<char, 64> diary_{};
  std::size_t length_ = 0;
};

inline constexpr std::string_view kExecutivePipeline = R"(
[robot]
name      = fer
period_us = 1000
tau_c     = pd.tau
[executive]
max_slip = 50
[jrg]
type = joint_reference_generator
q    = robot.q
[pd]
type = pd_gravity
q_d  = jrg.q_d
q    = robot.q
dq   = robot.dq
kp   = 100
kd   = 10
)";

// The drives take velocities, as online points give them; the guard may limit them without end.
inline constexpr std::string_view kVelocities = R"(
[robot]
name      = fer
period_us = 1000
dq_c      = jrg.dq_d
[guard]
limiting_share = 1
[jrg]
type = joint_reference_generator
q    = robot.q
online = forward
)";

struct ExecutiveBench {
  static constexpr std::int64_t kPeriod_ns = 1000000;
  static constexpr double kPeriod_s = 1e-3;

  FakeHal hal;
  std::array<Waypoint<JointSpace>, 2> waypoints;
  ChannelMemory<JointSpace> channel;
  ReferenceClient<JointSpace> client{channel};
  RoomyPipeline pipeline;
  CycleTimes times;
  Executive executive{hal, pipeline, {stopwatch, times}};
  std::int64_t now_ns = 0;
  std::uint32_t armed_in = 0;

  explicit ExecutiveBench(std::string_view text = kExecutivePipeline) {
    hal.state.q = 0.5 * (pipeline.guard.limits.q_min + pipeline.guard.limits.q_max);
    channel.stores[0].waypoints = waypoints.data();
    channel.stores[0].capacity = static_cast<int>(waypoints.size());
    Loader loader({&channel}, hal.capabilities());
    LoadError error;
    const Status status = loader.load(text, pipeline, error);
    pipeline.executive.rest_ms = 1;  // one block: the tests count its cycles
    if (status == Status::kOk) return;
    std::fprintf(stderr, "%s\n", error.message().c_str());
    std::abort();
  }
  /// Connects, arms the drives and takes them over, with a clean diary.
  Status start() {
    const Status status = start_armed(executive, kPeriod_ns, now_ns);
    static_cast<void>(hal.diary());
    armed_in = executive.telemetry().cycles;
    return status;
  }
  /// Number of cycles since the drives were taken over.
  std::uint32_t cycles() const { return executive.telemetry().cycles - armed_in; }
  /// One cycle, `periods` after the one before.
  Status cycle(double periods = 1.0) {
    now_ns += static_cast<std::int64_t>(periods * static_cast<double>(kPeriod_ns));
    return executive.cycle({now_ns});
  }
  /// The reference of joint 1.
  double reference() const {
    return (*static_cast<const JointVector*>(pipeline.ports.find("jrg.q_d")->value))[0];
  }
  /// Sends a straight line of joint 1 at 0.5 rad/s for two seconds, which begins with the next
  /// cycle.
  bool send_line() {
    Trajectory<JointSpace>* line = client.acquire();
    if (line == nullptr) return false;
    line->count = 2;
    line->fields = 0;
    for (Waypoint<JointSpace>& waypoint : waypoints)
      waypoint.point.q = *static_cast<const JointVector*>(pipeline.ports.find("jrg.q_d")->value);
    waypoints[1].time_s = 2.0;
    waypoints[1].point.q[0] += 1.0;
    std::uint32_t id = 0;
    return client.send(*line, id).ok();
  }
};

/// Replaces the bench by a new one. A bench is large, so there is only one, in static memory.
inline ExecutiveBench& fresh_bench(std::string_view text = kExecutivePipeline) {
  static std::optional<ExecutiveBench> bench;
  g_stopwatch_ns = 0;
  return bench.emplace(text);
}

/// Returns a new bench, started, with an empty diary.
inline ExecutiveBench& started_bench() {
  ExecutiveBench& b = fresh_bench();
  ASSERT_OK(b.start());
  return b;
}

/// The drives were disabled once for `status`, at the latest by the next write, and from now on are
/// not asked for anything else.
inline void assert_stopped(ExecutiveBench& b, Status status) {
  ASSERT_STATUS(b.executive.latched(), status);
  const int writes = b.hal.writes;
  for (int i = 0; i < 3; ++i) ASSERT_STATUS(b.cycle(), status);
  assert_true(b.hal.writes == writes && b.hal.stops == 1 && !b.hal.enabled());
}

/// A row that writes a letter into the diary, keeps its time argument, and takes `takes_ns`.
struct RowProbe {
  FakeHal* hal;
  char letter;
  double time_s = -1.0;
  std::uint64_t takes_ns = 0;

  Status status = Status::kOk;  // its result

  static Status run(void* context, const RobotState&, double time_s) {
    RowProbe& probe = *static_cast<RowProbe*>(context);
    probe.hal->note(probe.letter);
    probe.time_s = time_s;
    g_stopwatch_ns += probe.takes_ns;
    return probe.status;
  }
  /// A row with a budget that does not matter.
  Row row(int divisor = 1, int offset = 0) {
    return {"probe", divisor, offset, 10, false, run, this};
  }
};

}  // namespace tactus
