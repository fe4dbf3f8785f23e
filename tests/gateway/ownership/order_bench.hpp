// The bench of the orders in which three clients, a robot and the clock may act on a server: links
// that hold messages up, snapshots of everything, and the checks after each event.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "tests/gateway/ownership/order_model.hpp"
#include "tests/gateway/server/cycle_bench.hpp"
#include "tests/gateway/server/trajectory_parts.hpp"

namespace tactus {

/// What is remembered of a client; a copy of it is a snapshot.
struct OrderClient {
  struct Message {
    Asked asked;
    std::uint32_t told = 0;  // the newest stop that its client knew of
    int place = 0;           // among all messages that came
    bool taken = false, final = false;
  };
  int slot = -1, session = 0;
  std::uint32_t sent = 0, arrived = 0, answered = 0;  // numbers of messages
  std::uint32_t told = 0;                             // the newest stop
  std::array<Message, 32> messages{};                 // by their numbers
  bool there() const { return slot >= 0; }
};

struct OrderWorld {
  static constexpr int kClients = 3;
  OrderModel model;
  std::array<OrderClient, kClients> clients;
  std::int64_t late_ns = 0;  // of the server's clock before the cycle's
  bool moved = false;
  std::uint32_t events = 0;       // of the executive, that the model knows
  int places = 0;                 // of messages
  std::array<int, 2> executed{};  // place of the newest override, and of the newest other control
};

class OrderBench {
 public:
  CycleBench cycles;
  OrderWorld world;

  /// Three clients; the first owns the motion with priority 5, and a trajectory of it runs.
  void start() {
    cycles.start();
    world.events = cycles.executive.events().count();
    for (int i = 0; i < OrderWorld::kClients; ++i) join(i);
    say(0, {ask::kLease, 5.0});
    send_trajectory();
    settle();
    assert_true(world.moved);
    begun_ = true;
    note_parts();
  }
  /// A client composes a message, which its link holds up.
  void send(int client, const Asked& asked) {
    OrderClient& its = world.clients[static_cast<std::size_t>(client)];
    if (its.there()) its.messages[++its.sent] = {asked, its.told, 0, false, false};
  }
  bool holds_up(int client) const {
    const OrderClient& its = world.clients[static_cast<std::size_t>(client)];
    return its.arrived < its.sent;
  }
  /// The link of a client passes its oldest message on, and the server has its turn.
  void arrive(int client) {
    OrderClient& its = world.clients[static_cast<std::size_t>(client)];
    OrderClient::Message& message = its.messages[++its.arrived];
    push(its, its.arrived, message);
    world.model.begin_turn();
    const Status expected = world.model.take(its.session, message.asked, message.told, now_ns());
    message.place = ++world.places;
    message.taken = expected == Status::kOk;
    message.final = !message.taken || !has_report(message.asked.kind);
    expected_ = &its;
    expected_status_ = expected;
    expected_stops_ = world.model.newest;
    turn();
    assert_int_equal(its.answered, its.arrived);
  }
  void say(int client, const Asked& asked) {
    send(client, asked);
    while (holds_up(client)) arrive(client);
  }
  void leave(int client) {
    OrderClient& its = world.clients[static_cast<std::size_t>(client)];
    if (!its.there()) return;
    world.model.begin_turn();
    its.arrived = its.answered = its.sent;
    for (OrderClient::Message& message : its.messages) {
      if (message.taken && !message.final) world.model.forget();
      message.final = true;
    }
    cycles.server->closed(its.slot, now_ns());
    its.slot = -1;
    world.model.leave(its.session);
    turn();
  }
  void join(int client) {
    OrderClient& its = world.clients[static_cast<std::size_t>(client)];
    if (its.there()) return;
    its.session = static_cast<int>(cycles.next_session++);
    its.slot = cycles.server->open(static_cast<std::uint64_t>(its.session), now_ns());
    const std::uint32_t number = ++its.sent;
    its.messages[number] = {{}, 0, 0, true, true};
    its.arrived = its.answered = number;
    RawMessage& hello = whole_;
    hello.size = 0;
    hello.number(1, number).message(ask::kHello, RawMessage().number(1, 1).text(2, "c"));
    push_bytes(its, hello);
    hello.size = 0;
    const std::uint32_t watch = its.answered = its.arrived = ++its.sent;
    its.messages[watch] = {{}, 0, 0, true, true};
    hello.number(1, watch).message(ask::kSubscribe, RawMessage().number(1, 1));
    push_bytes(its, hello);
    world.model.begin_turn();
    turn();
    assert_int_equal(its.told, world.model.newest);
  }
  /// One cycle. `fault`: a drive reports one.
  void cycle(bool fault = false) {
    const Rung before = cycles.executive.rung();
    if (fault) cycles.hal.state.drives[0].state = DriveState::kFault;
    cycles.cycle();
    watch_cycle(before, cycles.executive.rung());
  }
  /// Nothing comes from the owner for longer than its lease.
  void fall_silent() {
    world.late_ns += OrderModel::kLease_ns + 100 * kMillisecond_ns;
    world.model.begin_turn();
    turn();
  }
  /// Cycles and turns until everything has its final report and the arm is where it is to be.
  void settle() {
    for (int i = 0; i < 2000; ++i) {
      cycle();
      world.model.begin_turn();
      turn();
      if (i > 2 && settled()) break;
    }
    assert_true(settled());
    check_settled();
  }

  void save(std::vector<std::byte>& to) const {
    to.clear();
    for (const auto& [begin, end] : parts_) to.insert(to.end(), begin, end);
  }
  void restore(const std::vector<std::byte>& from) {
    const std::byte* at = from.data();
    for (const auto& [begin, end] : parts_) {
      std::memcpy(begin, at, static_cast<std::size_t>(end - begin));
      at += end - begin;
    }
  }

 private:
  struct Part {
    std::byte *begin, *end;
  };

  std::int64_t now_ns() const { return cycles.now_ns + world.late_ns; }
  static bool has_report(std::uint32_t kind) { return kind != ask::kLease && kind != ask::kPing; }

  void push_bytes(const OrderClient& to, const RawMessage& message) {
    const ByteSpace space = cycles.server->space(to.slot);
    assert_true(space.size >= message.size + 4);
    for (std::size_t i = 0; i < 4; ++i)
      space.data[i] = static_cast<std::uint8_t>(message.size >> 8 * i);
    std::memcpy(space.data + 4, message.bytes.data(), message.size);
    cycles.server->received(to.slot, message.size + 4, now_ns());
  }
  void push(const OrderClient& from, std::uint32_t number, const OrderClient::Message& message) {
    const auto& [kind, rate] = message.asked;
    body_.size = 0;
    if (kind == ask::kLease && rate < 0.0) body_.number(1, 1);
    if (kind == ask::kLease && rate >= 0.0) body_.number(2, static_cast<std::uint64_t>(rate));
    if (kind == ask::kOverride) body_.real(1, rate).number(2, message.told);
    if (kind == ask::kRearm || kind == ask::kResume) body_.number(1, message.told);
    whole_.size = 0;
    whole_.number(1, number).message(kind, body_);
    push_bytes(from, whole_);
  }
  /// A slow motion of a minute, whose client nobody asks again.
  void send_trajectory() {
    OrderClient& its = world.clients[0];
    const auto push = [&](std::uint32_t kind, const RawMessage& body) {
      its.messages[++its.sent] = {{kind}, 0, 0, true, true};
      its.answered = its.arrived = its.sent;
      whole_.size = 0;
      push_bytes(its, whole_.number(1, its.sent).message(kind, body));
      turn();
    };
    JointSpace::Point goal = ServerBench::home();
    goal.q[0] += 0.5;
    push(ask::kBegin, begin());
    push(ask::kPart, part(60000, 60001, [&](double) { return goal; }));
    push(ask::kEnd, {});
  }

  void turn() {
    cycles.server->work(now_ns());
    world.model.end_turn(now_ns());
    for (OrderClient& client : world.clients)
      if (client.there()) read(client);
    int owner = OrderModel::kNoOwner;
    for (const OrderClient& client : world.clients)
      if (client.there() && client.slot == cycles.server->owner()) owner = client.session;
    assert_int_equal(owner, world.model.owner);
    expected_ = nullptr;
  }
  void read(OrderClient& its) {
    const Bytes waiting = cycles.server->waiting(its.slot);
    assert_true(waiting.size < kMostReports);
    const std::uint8_t *at = waiting.data, *const end = at + waiting.size;
    while (at != end) {
      std::size_t length = 0;
      for (std::size_t i = 4; i > 0; --i) length = length << 8 | at[i - 1];
      take(its, RawFields(at + 4, at + 4 + length));
      at += 4 + length;
    }
    if (waiting.size > 0) cycles.server->sent(its.slot, waiting.size, now_ns());
  }
  void take(OrderClient& its, RawFields whole) {
    assert_true(whole.next());
    RawFields inner = whole.inner();
    std::array<std::uint64_t, 32> value{};
    bool words = false;
    while (inner.next()) {
      if (whole.field != 1) value[inner.field % 32] = inner.value;
      if (whole.field == 1 && inner.field == 25) value[25] = inner.value;
      if (inner.field == (whole.field == 2 ? 3U : 4U)) words = inner.block_size > 0;
    }
    if (whole.field == 1) its.told = static_cast<std::uint32_t>(value[25]);
    if (whole.field == 2) take_answer(its, value, words);
    if (whole.field == 3) take_report(its, value, words);
    if (whole.field != 4) return;
    assert_int_equal(value[28], world.model.newest);
    its.told = static_cast<std::uint32_t>(value[28]);
  }
  /// Every message is answered once, in the order of the link, by the documented status.
  void take_answer(OrderClient& its, const std::array<std::uint64_t, 32>& value, bool words) {
    if (&its != expected_) return;
    assert_int_equal(value[1], its.answered + 1);
    ++its.answered;
    const Asked& asked = its.messages[its.answered].asked;
    if (value[2] != static_cast<std::uint64_t>(expected_status_) || value[9] != expected_stops_)
      print_message("message %u, rate %g: status %d, stops %d\n", asked.kind, asked.rate,
                    static_cast<int>(value[2]), static_cast<int>(value[9]));
    assert_int_equal(value[2], static_cast<int>(expected_status_));
    assert_int_equal(value[9], expected_stops_);
    assert_int_equal(words, value[2] != 0);
    its.told = static_cast<std::uint32_t>(value[9]);
  }
  /// Every message that was taken has one final report, behind those of the same way to the cycle.
  void take_report(OrderClient& its, const std::array<std::uint64_t, 32>& value, bool words) {
    constexpr std::uint64_t kFinal = 10, kExecuted = 14;
    if (value[2] < kFinal) return;
    OrderClient::Message& message = its.messages[value[1] % its.messages.size()];
    if (message.asked.kind == ask::kEnd || message.asked.kind == ask::kBegin) return;
    assert_true(message.taken && !message.final && value[1] <= its.answered);
    message.final = true;
    const auto by_order = [](const OrderClient::Message& its_message) {
      return its_message.asked.kind == ask::kStop || its_message.asked.kind == ask::kRearm;
    };
    for (std::uint32_t i = 1; i < value[1]; ++i)
      assert_true(its.messages[i].final || by_order(its.messages[i]) != by_order(message));
    const bool executed = value[2] == kExecuted;
    assert_true(executed || words);
    if (message.asked.kind == ask::kStop) assert_true(executed);
    int& newest = world.executed[message.asked.kind == ask::kOverride ? 0 : 1];
    if (!executed || message.place < newest || by_order(message)) return;
    newest = message.place;  // clients are read one after the other
    if (message.asked.kind == ask::kPause) world.model.paused = true;
    if (message.asked.kind == ask::kResume) world.model.paused = false;
    if (message.asked.kind == ask::kOverride) world.model.executed_override = message.asked.rate;
  }

  /// Nothing begins to move but by what was asked after all that had stopped it.
  void watch_cycle(Rung before, Rung after) {
    OrderModel& model = world.model;
    const bool up = refuses(before) && !refuses(after);
    const double override = cycles.pipeline.motion_state().override;
    const bool moved = world.moved;
    world.moved = commands(after) && reference_moves();
    if (up || (before == Rung::kDisabled && after == Rung::kArming)) assert_true(model.may_arm);
    Event event;
    for (; cycles.executive.events().read(world.events, event); ++world.events) {
      const bool asked_for = event.status == Status::kOk || event.status == Status::kHalted ||
                             event.status == Status::kArming;
      if (event.from != event.to && !asked_for && event.cause != Cause::kAtRest) model.fault();
    }
    if (world.moved && !moved && begun_) assert_true(model.may_resume || model.resumed);
    model.resumed = model.may_resume;
    if (override > model.cycle_override && !up) assert_true(model.may_raise);
    model.cycle_override = override;
    if (!up) return;
    model.may_arm = model.may_resume = model.resumed = model.may_raise = model.paused = false;
    model.executed_override = 1.0;
  }
  bool reference_moves() const {
    const auto& block = *static_cast<const JointReferenceGenerator*>(cycles.pipeline[0].place);
    return block.dq_d.value.cwiseAbs().maxCoeff() > 0.0;
  }
  bool settled() const {
    for (const OrderClient& client : world.clients)
      for (const OrderClient::Message& message : client.messages)
        if (message.taken && !message.final) return false;
    const bool brakes = world.model.paused && world.moved;
    return !brakes && !cycles.executive.busy() && cycles.executive.rung() != Rung::kArming;
  }
  void check_settled() const {
    const Rung rung = cycles.executive.rung();
    if (world.model.stopped) assert_true(rung == Rung::kDisabled);
    if (refuses(rung)) assert_false(world.moved);
    if (!refuses(rung) && world.model.executed_override >= 0.0)
      ASSERT_NEAR(world.model.cycle_override, world.model.executed_override, 0.0);
  }

  /// What a snapshot has: all but stores that no client of these writes, and places of others.
  void note_parts() {
    std::vector<Part> without = {whole(cycles.waypoints), whole(cycles.task_channel),
                                 whole(cycles.poses), whole(cycles.channel.chunks)};
    std::byte* end = nullptr;  // of the connection before
    for (int slot = 0; slot < kMostClients; ++slot) {
      auto* const out = reinterpret_cast<std::byte*>(
          const_cast<std::uint8_t*>(cycles.server->waiting(slot).data));
      without.push_back(
          {slot < OrderWorld::kClients ? out + kMostReports : end, out + kOutputBytes});
      end = out + sizeof(OutputBytes);
    }
    std::sort(without.begin(), without.end(),
              [](const Part& a, const Part& b) { return a.begin < b.begin; });
    parts_ = {whole(world)};
    std::byte* from = whole(cycles).begin;
    for (const Part& part : without) {
      parts_.push_back({from, part.begin});
      from = part.end;
    }
    parts_.push_back({from, whole(cycles).end});
  }
  template <class Object>
  static Part whole(Object& object) {
    auto* const begin = reinterpret_cast<std::byte*>(&object);
    return {begin, begin + sizeof object};
  }

  static constexpr std::size_t kMostReports = 4096;
  RawMessage whole_, body_;
  const OrderClient* expected_ = nullptr;  // who is answered in this turn
  Status expected_status_ = Status::kOk;
  std::uint32_t expected_stops_ = 0;
  bool begun_ = false;  // the trajectory moves
  std::vector<Part> parts_;
};

}  // namespace tactus
