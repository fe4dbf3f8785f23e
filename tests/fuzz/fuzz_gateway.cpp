// Fuzzes the server of references: two clients send bytes of any kind in any pieces, or whole
// messages of any content; time passes, connections end, cycles run meanwhile.
#include "gateway/server/server.hpp"
#include "kernel/cycle/ladder.hpp"
#include "kernel/streams/generator_streams.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace {

using namespace tactus;

struct World {
  ChannelMemory<JointSpace> channel;
  ChannelMemory<TaskSpace> task_channel;
  std::array<std::array<Waypoint<JointSpace>, 16>, kStores> waypoints;
  RoomyPipeline pipeline;
  CycleMailboxes mailboxes;
  ReferenceClient<JointSpace> joints{channel};
  ReferenceClient<TaskSpace> poses{task_channel};
  ReferenceGenerator<JointSpace> generator;
  std::int64_t now_ns = kSecond_ns;
  bool stopped = false;
  Server server{setup(), joints, poses, mailboxes};

  ServerSetup setup() {
    pipeline.takes_joints = true;
    pipeline.robot.period_us = 1000;
    channel.settings.period_s = 1e-3;
    for (std::size_t i = 0; i < kStores; ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      channel.stores[i].capacity = static_cast<int>(waypoints[i].size());
    }
    ServerSetup its;
    its.loaded = &pipeline;
    return its;
  }
  void start() {
    const JointLimits limits;
    JointSpace::Point home;
    home.q = 0.5 * (limits.q_min + limits.q_max);
    ReferenceGenerator<JointSpace>::Params params;
    params.online = OnlineMode::kLimit;
    params.feedback_divisor = 1;
    MUST(generator.start(channel, params, home) == Status::kOk);
  }
  void cycle() {
    now_ns += kMillisecond_ns;
    if (stopped) generator.brake(Status::kHalted, BrakeWay::kOnPath);
    MUST(generator.step(1e-3, generator.reference()) == Status::kOk);
    OrderMessage order;
    if (mailboxes.orders.take(order)) {
      if (order.order == CycleOrder::kStop) stopped = true;
      MUST(mailboxes.results.post({order.id}));
    }
    CycleSnapshot told;
    told.stamp_ns = now_ns;
    told.time_s = generator.time_s();
    told.rung = static_cast<std::uint8_t>(stopped ? Rung::kDisabled : Rung::kNominal);
    static_cast<void>(mailboxes.snapshots.post(told));
    server.work(now_ns);
    for (int slot = 0; slot < 2; ++slot) {
      const Bytes waiting = server.waiting(slot);
      MUST(waiting.size <= kOutputBytes);
      if (server.used(slot) && now_ns / kMillisecond_ns % 3 == 0)
        server.sent(slot, waiting.size, now_ns);
    }
    MUST(server.owner() == Lease::kNoOwner || server.used(server.owner()));
  }
  void connect() {
    for (int slot = 0; slot < 2; ++slot)
      if (!server.used(slot)) MUST(server.open(static_cast<std::uint64_t>(slot) + 1, now_ns) >= 0);
  }
  void push(int slot, const std::uint8_t* data, std::size_t size) {
    while (size > 0 && server.used(slot)) {
      const ByteSpace space = server.space(slot);
      const std::size_t count = std::min(space.size, size);
      if (count == 0) return;
      std::memcpy(space.data, data, count);
      server.received(slot, count, now_ns);
      data += count;
      size -= count;
      server.work(now_ns);
    }
  }
  /// Whole messages: the client and what happens before it, two bytes of length, the message.
  void deal_messages(const fuzz::Tape& tape) {
    for (std::size_t at = 0; at + 3 <= tape.size;) {
      const std::uint8_t how = tape.data[at];
      const std::size_t length = tape.data[at + 1] | static_cast<std::size_t>(tape.data[at + 2])
                                                         << 8;
      const std::size_t size = std::min(length, tape.size - at - 3);
      const int slot = how & 1;
      if ((how & 2) != 0) now_ns += (how & 4) != 0 ? kSecond_ns : 50 * kMillisecond_ns;
      if ((how & 0xf0) == 0xf0) server.closed(slot, now_ns);
      connect();
      if ((how & 8) != 0) {
        server.datagram({tape.data + at + 3, size}, now_ns);
      } else {
        const std::uint8_t front[4] = {static_cast<std::uint8_t>(size),
                                       static_cast<std::uint8_t>(size >> 8), 0, 0};
        push(slot, front, sizeof front);
        push(slot, tape.data + at + 3, size);
      }
      cycle();
      at += 3 + size;
    }
  }
  /// Whatever came, a server whose clients have left has no owner, and its arm comes to rest.
  void end() {
    for (int slot = 0; slot < 2; ++slot)
      if (server.used(slot)) server.closed(slot, now_ns);
    MUST(server.owner() == Lease::kNoOwner);
    for (int i = 0; i < 3000 && !generator.reference().standing(); ++i) cycle();
    MUST(generator.reference().standing());
  }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static World* world = nullptr;
  delete world;
  world = new World;
  world->start();
  world->connect();
  const fuzz::Tape tape(data, size);
  if (tape.hangs) {
    world->deal_messages(tape);
  } else {
    tape.deal([](const std::uint8_t* piece, std::size_t count) {
      world->connect();
      world->push(0, piece, count);
      world->cycle();
    });
  }
  world->end();
  return 0;
}
