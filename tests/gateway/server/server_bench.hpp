// The bench of the server's tests: a server, the generator whose references it takes,
// in virtual time.
#pragma once

#include <optional>

#include "gateway/server/server.hpp"
#include "kernel/cycle/ladder.hpp"
#include "kernel/load/loader.hpp"
#include "kernel/streams/generator_streams.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

inline constexpr double kPeriod_s = 1e-3;
inline constexpr int kBenchWaypoints = 600;
inline int log_lines = 0;
inline char last_log[400];

/// Virtual time, and the sessions that were given out.
struct BenchClock {
  std::int64_t now_ns = 1'000'000'000'000;
  std::uint64_t next_session = 77;
};

struct ServerBench : BenchClock {
  ChannelMemory<JointSpace> channel;
  ChannelMemory<TaskSpace> task_channel;
  std::array<std::array<Waypoint<JointSpace>, kBenchWaypoints>, kStores> waypoints;
  RoomyPipeline pipeline;
  std::optional<ParameterBook> book;  // made by setup()
  TuningVerdict refused_by_cycle;     // what the cycle says of sets; kOk: it takes them
  bool answers_sets = true;           // the cycle runs
  CycleMailboxes mailboxes;
  ReferenceClient<JointSpace> joints{channel};
  ReferenceClient<TaskSpace> poses{task_channel};
  ReferenceGenerator<JointSpace> generator;
  ReferenceGenerator<JointSpace>::Params params;
  Rung rung = Rung::kNominal;
  std::uint32_t faults = 0;
  Status why = Status::kHalted;  // it is not nominal
  std::uint32_t cycles = 0;
  Server server{setup(), joints, poses, mailboxes};

  /// Loads a pipeline of one law, whose parameters may change.
  ServerSetup setup() {
    Message text("[robot]\nperiod_us = 1000\ntau_c = pd.tau\nname = ");
    text << Robot::kName << "\n[pd]\ntype = pd_gravity\nq_d = robot.q\nq = robot.q\n"
         << "dq = robot.dq\nkp = 100\nkd = 10\n";
    LoadError error;
    ASSERT_OK(Loader({}, {false, false, true, 100, 10000}).load(text, pipeline, error));
    pipeline.takes_joints = true;
    book.emplace(pipeline);
    ServerSetup its;
    its.parameters = &*book;
    its.board = "bench";
    its.pipeline = "none";
    its.loaded = &pipeline;
    its.joint_window = kBenchWaypoints;
    its.log = [](const char* line) {
      ++log_lines;
      std::snprintf(last_log, sizeof last_log, "%s", line);
    };
    return its;
  }
  /// Starts the generator with the joints in the middle of their ranges, forwarding points.
  void start(OnlineMode online = OnlineMode::kLimit) {
    channel.settings.period_s = kPeriod_s;
    for (std::size_t i = 0; i < kStores; ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      channel.stores[i].capacity = kBenchWaypoints;
    }
    params.online = online;
    params.feedback_divisor = 10;
    ASSERT_OK(generator.start(channel, params, home()));
  }
  static JointSpace::Point home() {
    const JointLimits limits;
    JointSpace::Point home;
    home.q = 0.5 * (limits.q_min + limits.q_max);
    return home;
  }
  /// One cycle, then the server's turn.
  void cycle() {
    step();
    server.work(now_ns);
  }
  /// One cycle as the executive runs it, with the mailboxes of its thread.
  void step() {
    now_ns += 1'000'000;
    ++cycles;
    if (refuses(rung)) generator.brake(Status::kHalted, BrakeWay::kOnPath);
    ASSERT_OK(generator.step(kPeriod_s, generator.reference()));
    OrderMessage order;
    if (mailboxes.orders.take(order)) {
      rung = order.order == CycleOrder::kStop ? Rung::kDisabled : Rung::kNominal;
      if (rung == Rung::kNominal)
        ASSERT_OK(generator.start(channel, params, generator.reference().stopped()));
      mailboxes.results.post({order.id});
    }
    TuningMessage set;
    if (answers_sets && mailboxes.tunings.take(set)) {
      const TuningVerdict verdict = refused_by_cycle.status == Status::kOk
                                        ? pipeline.retune(*set.tuning, false)
                                        : refused_by_cycle;
      mailboxes.tuned.post(verdict);
    }
    CycleSnapshot told;
    told.stamp_ns = now_ns;
    told.time_s = generator.time_s();
    told.cycle = cycles;
    told.faults = faults;
    told.rung = static_cast<std::uint8_t>(rung);
    told.status = refuses(rung) ? why : Status::kOk;
    told.fault = told.status;
    told.q = generator.reference().q;
    told.override = generator.motion_state().override;
    told.outputs = generator.outputs();
    mailboxes.snapshots.post(told);
  }
};

}  // namespace tactus
