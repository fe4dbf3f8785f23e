// The bench of the server's tests: a server, the generator whose references it takes, and clients
// that speak in bytes, all in virtual time.
#pragma once

#include "gateway/server/server.hpp"
#include "kernel/cycle/ladder.hpp"
#include "kernel/reference/generator/reference_generator.hpp"
#include "tests/gateway/raw_messages.hpp"
#include "tests/support/random.hpp"
#include "tests/support/testing.hpp"

namespace tactus {

namespace ask {  // fields of ToServer
enum : std::uint32_t {
  kHello = 10, kLease, kPoint, kVelocity, kChunk, kBegin, kPart, kEnd, kCancel, kOverride, kPause,
  kResume, kStop, kRearm, kParameters, kSubscribe, kPing,
};
}

inline constexpr double kPeriod_s = 1e-3;
inline constexpr int kBenchWaypoints = 600;
inline int log_lines = 0;
inline char last_log[400];

struct ServerBench {
  ChannelMemory<JointSpace> channel;
  ChannelMemory<TaskSpace> task_channel;
  std::array<std::array<Waypoint<JointSpace>, kBenchWaypoints>, kStores> waypoints;
  RoomyPipeline pipeline;
  CycleMail mail;
  ReferenceClient<JointSpace> joints{channel};
  ReferenceClient<TaskSpace> poses{task_channel};
  ReferenceGenerator<JointSpace> generator;
  ReferenceGenerator<JointSpace>::Params params;
  Rung rung = Rung::kNominal;
  std::uint32_t cycles = 0;
  std::int64_t now_ns = 1'000'000'000'000;
  Server server{setup(), joints, poses, mail};
  std::uint64_t next_session = 77;

  ServerSetup setup() {
    pipeline.takes_joints = true;
    pipeline.robot.period_us = 1000;
    ServerSetup its;
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
  /// One cycle as the executive runs it, with the mail of its thread; then the server's turn.
  void cycle() {
    now_ns += 1'000'000;
    ++cycles;
    if (refuses(rung)) generator.brake(Status::kHalted, BrakeWay::kOnPath);
    ASSERT_OK(generator.step(kPeriod_s, generator.reference()));
    OrderMessage order;
    if (mail.orders.take(order)) {
      rung = order.order == CycleOrder::kStop ? Rung::kDisabled : Rung::kNominal;
      if (rung == Rung::kNominal) ASSERT_OK(generator.start(channel, params, generator.reference().stopped()));
      mail.results.post({order.id, Status::kOk});
    }
    CycleSnapshot told;
    told.stamp_ns = now_ns;
    told.time_s = generator.time_s();
    told.cycle = cycles;
    told.rung = static_cast<std::uint8_t>(rung);
    told.status = refuses(rung) ? Status::kHalted : Status::kOk;
    told.q = generator.reference().q;
    mail.snapshots.post(told);
    server.work(now_ns);
  }
};

/// A client at one slot; counts what each of its messages was answered and reported.
struct TestClient {
  static constexpr std::size_t kMost = 16384;  // numbers of messages
  ServerBench* bench = nullptr;
  int slot = -1;
  std::uint32_t number = 0;
  bool reads = true;
  std::array<std::uint8_t, kMost> answers{}, finals{}, status{}, outcome{};
  std::uint32_t kinds[kMost]{};
  std::int64_t credit = 0;
  int starved = 0, states = 0, feedbacks = 0, events = 0, welcomes = 0;
  std::uint32_t epoch = 0;
  std::uint64_t session = 0;
  std::uint8_t farewell = 0;  ///< status of the answer without number
  char event[400] = "", text[400] = "";

  void connect(ServerBench& its) {
    *this = TestClient();
    bench = &its;
    session = its.next_session++;
    slot = its.server.open(session, its.now_ns);
  }
  void greet(const char* name) {
    connect(*bench);
    send(ask::kHello, RawMessage().number(1, 1).text(2, name));
  }
  /// Sends a message; returns its number.
  std::uint32_t send(std::uint32_t kind, const RawMessage& body = {}) {
    RawMessage& whole = scratch();
    whole.size = 0;
    ++number;
    kinds[number % kMost] = kind;
    whole.number(1, number).time(2, bench->now_ns - 5);
    whole.message(kind, body);
    send_bytes(whole);
    return number;
  }
  void send_bytes(const RawMessage& message) {
    std::uint8_t length[4];
    for (std::size_t i = 0; i < 4; ++i) length[i] = static_cast<std::uint8_t>(message.size >> 8 * i);
    push(length, 4);
    push(message.bytes.data(), message.size);
  }
  /// Bytes as they would come from a socket, if the server takes any.
  std::size_t push(const std::uint8_t* data, std::size_t size) {
    std::size_t pushed = 0;
    for (int tries = 0; pushed < size && tries < 100; ++tries) {
      const ByteSpace space = bench->server.space(slot);
      const std::size_t count = std::min(space.size, size - pushed);
      if (count == 0) {
        bench->server.work(bench->now_ns);
        if (reads) read();
        continue;
      }
      std::memcpy(space.data, data + pushed, count);
      bench->server.received(slot, count, bench->now_ns);
      pushed += count;
    }
    return pushed;
  }
  std::uint32_t lease(std::uint32_t priority = 0, std::uint32_t timeout_ms = 1000) {
    return send(ask::kLease, RawMessage().number(2, priority).number(3, timeout_ms));
  }
  std::uint32_t point(const JointVector& q) {
    return send(ask::kPoint,
                RawMessage().message(3, RawMessage().reals(1, q.data(), static_cast<std::size_t>(kDof))));
  }
  /// Takes what the server has to say.
  void read() {
    if (slot < 0) return;
    const Bytes waiting = bench->server.waiting(slot);
    for (std::size_t at = 0; at + 4 <= waiting.size;) {
      std::size_t length = 0;
      for (std::size_t i = 4; i > 0; --i) length = length << 8 | waiting.data[at + i - 1];
      assert_true(at + 4 + length <= waiting.size);
      take(RawFields(waiting.data + at + 4, waiting.data + at + 4 + length));
      at += 4 + length;
    }
    if (waiting.size > 0) bench->server.sent(slot, waiting.size, bench->now_ns);
  }
  void take(RawFields whole) {
    assert_true(whole.next());
    RawFields inner = whole.inner();
    std::array<std::uint64_t, 32> value{};
    std::string_view words;
    while (inner.next()) {
      value[inner.field % 32] = inner.value;
      if (inner.field == 3 && whole.field == 2) words = inner.text();
      if (inner.field == 4 && (whole.field == 3 || whole.field == 6)) words = inner.text();
    }
    const std::size_t of = value[1] % kMost;
    switch (whole.field) {
      case 1: ++welcomes; ++answers[of]; session = value[7]; break;
      case 2: return take_answer(of, static_cast<std::uint8_t>(value[2]), words, value[7]);
      case 3:
        if (value[2] == 3) ++starved;
        if (value[2] < 10) return;
        ++finals[of];
        outcome[of] = static_cast<std::uint8_t>(value[2]);
        std::snprintf(text, sizeof text, "%.*s", static_cast<int>(words.size()), words.data());
        return;
      case 4: ++states; epoch = static_cast<std::uint32_t>(value[8]); return;
      case 5: ++feedbacks; return;
      case 6:
        ++events;
        std::snprintf(event, sizeof event, "%.*s", static_cast<int>(words.size()), words.data());
        return;
      default: credit += static_cast<std::int64_t>(value[1]);
    }
  }
  void take_answer(std::size_t of, std::uint8_t its_status, std::string_view words,
                   std::uint64_t its_epoch) {
    if (of == 0) farewell = its_status;
    ++answers[of];
    status[of] = its_status;
    epoch = static_cast<std::uint32_t>(its_epoch);
    std::snprintf(text, sizeof text, "%.*s", static_cast<int>(words.size()), words.data());
  }
  bool finished() const { return bench->server.finished(slot, bench->now_ns); }
  void close() {
    if (slot >= 0) bench->server.closed(slot, bench->now_ns);
    slot = -1;
  }
  static RawMessage& scratch() {
    static RawMessage message;
    return message;
  }
};

/// A bench with two clients, A and B, that have said Hello; the last one is forgotten.
struct TwoClients {
  ServerBench bench;
  TestClient a, b;

  void start() {
    bench.start();
    a.bench = b.bench = &bench;
    a.greet("A");
    b.greet("B");
    run(2);
    assert_int_equal(a.welcomes, 1);
    assert_int_equal(b.welcomes, 1);
  }
  /// Runs cycles in which both read.
  void run(int cycles) {
    for (int i = 0; i < cycles; ++i) {
      bench.cycle();
      if (a.reads) a.read();
      if (b.reads) b.read();
    }
  }
};

inline TwoClients& fresh_clients() {
  static TwoClients* two = nullptr;
  delete two;
  two = new TwoClients;
  two->start();
  return *two;
}

}  // namespace tactus
