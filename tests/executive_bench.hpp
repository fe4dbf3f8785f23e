// An executive between a robot that only remembers what was asked of it, a pipeline of two blocks
// loaded from text, and a stopwatch that the robot moves: the bench of the executive's tests.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <optional>

#include "gateway/reference_client.hpp"
#include "kernel/executive.hpp"
#include "kernel/loader.hpp"
#include "tests/testing.hpp"

namespace tactus {

/// A stopwatch that stands still until somebody moves it.
inline std::uint64_t g_stopwatch_ns = 0;
inline std::uint64_t stopwatch() {
  return g_stopwatch_ns;
}

/// Keeps a diary: s start, r read, w write, x stop; rows add a letter of their own.
class FakeHal final : public Hal {
 public:
  RobotState state;      // what is measured
  RobotCommand command;  // what was written last
  Status start_status = Status::kOk, read_status = Status::kOk, write_status = Status::kOk;
  std::uint64_t read_ns = 0, write_ns = 0;  // how long reading and writing take
  int reads = 0, writes = 0, stops = 0;

  Capabilities capabilities() const override { return {true, true, true, 100, 100000, true}; }
  Status start(CommandMode, RobotState& measured) override {
    note('s');
    measured = state;
    return start_status;
  }
  Status read(RobotState& measured) override {
    note('r'), ++reads;
    g_stopwatch_ns += read_ns;
    measured = state;
    return read_status;
  }
  Status write(const RobotCommand& sent) override {
    note('w'), ++writes;
    g_stopwatch_ns += write_ns;
    command = sent;
    return write_status;
  }
  void stop() override { note('x'), ++stops; }

  void note(char letter) {
    if (length_ + 1 < diary_.size()) diary_[length_++] = letter;
  }
  /// What happened since the last call.
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

struct ExecutiveBench {
  static constexpr std::int64_t kPeriod_ns = 1000000;
  static constexpr double kPeriod_s = 1e-3;

  FakeHal hal;
  std::array<Waypoint<JointSpace>, 2> waypoints;
  ReferenceChannel<JointSpace> channel;
  ReferenceClient<JointSpace> client{channel};
  Pipeline pipeline;
  Executive executive{hal, pipeline, stopwatch};
  std::int64_t now_ns = 0;

  explicit ExecutiveBench(std::string_view text = kExecutivePipeline) {
    hal.state.q = 0.5 * (pipeline.guard.limits.q_min + pipeline.guard.limits.q_max);
    channel.stores[0].waypoints = waypoints.data();
    channel.stores[0].capacity = static_cast<int>(waypoints.size());
    Loader loader({&channel}, hal.capabilities());
    LoadError error;
    if (loader.load(text, pipeline, error) == Status::kOk) return;
    std::fprintf(stderr, "%s\n", error.message().c_str());
    std::abort();
  }
  /// One cycle, `periods` after the one before.
  Status cycle(double periods = 1.0) {
    now_ns += static_cast<std::int64_t>(periods * static_cast<double>(kPeriod_ns));
    return executive.cycle({now_ns});
  }
  /// The reference of joint 1.
  double reference() const {
    return (*static_cast<const JointVector*>(pipeline.ports.find("jrg.q_d")->value))[0];
  }
  /// Sends a straight line of joint 1, at 0.5 rad/s for two seconds; it begins with the next cycle.
  bool send_line() {
    Trajectory<JointSpace>* line = client.acquire();
    if (line == nullptr) return false;
    line->count = 2;
    line->fields = 0;
    for (Waypoint<JointSpace>& waypoint : waypoints) waypoint.point.q = hal.state.q;
    waypoints[1].time_s = 2.0;
    waypoints[1].point.q[0] += 1.0;
    std::uint32_t id = 0;
    return client.send(*line, id).ok();
  }
};

/// A new bench in place of the last: they are large, so there is one, in static memory.
inline ExecutiveBench& fresh_bench(std::string_view text = kExecutivePipeline) {
  static std::optional<ExecutiveBench> bench;
  g_stopwatch_ns = 0;
  return bench.emplace(text);
}

/// Fresh, started, with a clean diary.
inline ExecutiveBench& started_bench() {
  ExecutiveBench& b = fresh_bench();
  ASSERT_OK(b.executive.start());
  static_cast<void>(b.hal.diary());
  return b;
}

/// The drives were disabled once for `status`, and from now on nothing is asked of them.
inline void assert_stopped(ExecutiveBench& b, Status status) {
  assert_int_equal(b.hal.stops, 1);
  ASSERT_STATUS(b.executive.latched(), status);
  const int reads = b.hal.reads, writes = b.hal.writes;
  for (int i = 0; i < 3; ++i) ASSERT_STATUS(b.cycle(), status);
  assert_true(b.hal.reads == reads && b.hal.writes == writes && b.hal.stops == 1);
}

/// A row that writes a letter into the diary, keeps the time it was given, and takes its time.
struct RowProbe {
  FakeHal* hal;
  char letter;
  double time_s = -1.0;
  std::uint64_t takes_ns = 0;

  Status status = Status::kOk;  // what it returns

  static Status run(void* context, const RobotState&, double time_s) {
    RowProbe& probe = *static_cast<RowProbe*>(context);
    probe.hal->note(probe.letter);
    probe.time_s = time_s;
    g_stopwatch_ns += probe.takes_ns;
    return probe.status;
  }
  /// As a row with a budget that does not matter.
  Row row(int divisor = 1, int offset = 0) {
    return {"probe", divisor, offset, 10, false, run, this};
  }
};

}  // namespace tactus
