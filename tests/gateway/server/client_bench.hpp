// Clients of the server's tests, which speak in bytes.
#pragma once

#include "tests/gateway/server/raw_messages.hpp"
#include "tests/gateway/server/server_bench.hpp"

namespace tactus {

namespace ask {  // fields of ToServer
enum : std::uint32_t {
  kHello = 10,
  kLease,
  kPoint,
  kVelocity,
  kChunk,
  kBegin,
  kPart,
  kEnd,
  kCancel,
  kOverride,
  kPause,
  kResume,
  kStop,
  kRearm,
  kParameters,
  kSubscribe,
  kPing,
  kListParameters,
  kTare,
};
}

/// A client at one slot; counts what each of its messages was answered and reported.
struct TestClient {
  static constexpr std::size_t kMost = 16384;  // numbers of messages
  BenchClock* clock = nullptr;
  Server* server = nullptr;
  int slot = -1;
  std::uint32_t number = 0;
  virtual ~TestClient() = default;
  bool reads = true;
  bool tells_time = true;    ///< messages say when they were sent:
  std::int64_t made_ns = 0;  ///< then, or now if it is 0
  std::array<std::uint8_t, kMost> answers{}, finals{}, status{}, outcome{}, refusals{}, started{};
  std::uint32_t kinds[kMost]{};
  std::int64_t credit = 0;
  int pages = 0;                      // of parameters
  std::uint32_t total = 0, sets = 0;  // as the last page says
  int starved = 0, states = 0, feedbacks = 0, events = 0, welcomes = 0;
  std::uint32_t epoch = 0;
  std::uint32_t stops = 0;                      ///< that it was told of last
  bool names_stops = true;                      ///< in what makes the arm move again
  std::uint32_t offered = 0;                    ///< digital outputs, by Welcome
  std::uint32_t outputs = 0, outputs_mask = 0;  ///< as commanded, by State
  std::uint64_t session = 0;
  bool offers_tare = false;  ///< by Welcome
  std::size_t zeros = 0;     ///< numbers of the zero of the last report
  std::array<double, 6> zero{};
  std::uint8_t final_status = 0;  ///< status of the answer without number
  char event[400] = "", text[400] = "";

  void connect(BenchClock& its, Server& whose) {
    *this = TestClient();
    clock = &its;
    server = &whose;
    session = its.next_session++;
    slot = whose.open(session, its.now_ns);
  }
  template <class Bench>
  void connect(Bench& its) {
    connect(its, its.server);
  }
  void greet(const char* name) {
    connect(*clock, *server);
    hello(name);
  }
  void hello(const char* name) { send(ask::kHello, RawMessage().number(1, 1).text(2, name)); }
  /// Sends a message; returns its number.
  std::uint32_t send(std::uint32_t kind, const RawMessage& body = {}) {
    RawMessage& whole = scratch();
    whole.size = 0;
    ++number;
    kinds[number % kMost] = kind;
    whole.number(1, number).time(2, tells_time ? made_ns != 0 ? made_ns : clock->now_ns - 5 : 0);
    const bool moves = kind == ask::kOverride || kind == ask::kResume || kind == ask::kRearm;
    whole.message(kind, moves && names_stops ? named_stops(kind, body) : body);
    send_bytes(whole);
    return number;
  }
  RawMessage named_stops(std::uint32_t kind, const RawMessage& body) const {
    RawMessage named = body;
    return named.number(kind == ask::kOverride ? 2 : 1, stops);
  }
  void send_bytes(const RawMessage& message) {
    std::uint8_t length[4];
    for (std::size_t i = 0; i < 4; ++i)
      length[i] = static_cast<std::uint8_t>(message.size >> 8 * i);
    push(length, 4);
    push(message.bytes.data(), message.size);
  }
  /// Bytes as they would come from a socket, if the server takes any.
  virtual std::size_t push(const std::uint8_t* data, std::size_t size) {
    std::size_t pushed = 0;
    for (int tries = 0; pushed < size && tries < 100; ++tries) {
      const ByteSpace space = server->space(slot);
      const std::size_t count = std::min(space.size, size - pushed);
      if (count == 0) {
        server->work(clock->now_ns);
        if (reads) read();
        continue;
      }
      std::memcpy(space.data, data + pushed, count);
      server->received(slot, count, clock->now_ns);
      pushed += count;
    }
    return pushed;
  }
  /// Sends a control; `rate` is that of an override.
  std::uint32_t control(std::uint32_t kind, double rate = 0.0) {
    return send(kind, kind == ask::kOverride ? RawMessage().real(1, rate) : RawMessage());
  }
  std::uint32_t lease(std::uint32_t priority = 0, std::uint32_t timeout_ms = 1000) {
    return send(ask::kLease, RawMessage().number(2, priority).number(3, timeout_ms));
  }
  std::uint32_t point(const JointVector& q) {
    return send(
        ask::kPoint,
        RawMessage().message(3, RawMessage().reals(1, q.data(), static_cast<std::size_t>(kDof))));
  }
  /// Takes what the server has to say.
  virtual void read() {
    if (slot < 0) return;
    const Bytes waiting = server->waiting(slot);
    assert_int_equal(take_whole(waiting), waiting.size);
    if (waiting.size > 0) server->sent(slot, waiting.size, clock->now_ns);
  }
  /// Takes the messages that are whole; returns how many bytes these are.
  std::size_t take_whole(const Bytes& bytes) {
    std::size_t at = 0;
    while (at + 4 <= bytes.size) {
      std::size_t length = 0;
      for (std::size_t i = 4; i > 0; --i) length = length << 8 | bytes.data[at + i - 1];
      if (at + 4 + length > bytes.size) break;
      take(RawFields(bytes.data + at + 4, bytes.data + at + 4 + length));
      at += 4 + length;
    }
    return at;
  }
  void take(RawFields whole) {
    assert_true(whole.next());
    RawFields inner = whole.inner();
    std::array<std::uint64_t, 32> value{};
    std::string_view words;
    while (inner.next()) {
      assert_true(inner.field < value.size());
      value[inner.field] = inner.value;
      if (inner.field == 3 && whole.field == 2) words = inner.text();
      if (whole.field == 1 && inner.field == 18)
        offers_tare = inner.text().find('\5') != std::string_view::npos;
      if (whole.field == 3) take_zero(inner);
      if (inner.field == 4 && (whole.field == 3 || whole.field == 6)) words = inner.text();
    }
    const std::size_t of = value[1] % kMost;
    switch (whole.field) {
      case 1:
        ++welcomes;
        ++answers[of];
        session = value[7];
        stops = static_cast<std::uint32_t>(value[25]);
        offered = static_cast<std::uint32_t>(value[23]);
        break;
      case 2:
        stops = std::max(stops, static_cast<std::uint32_t>(value[9]));
        return take_answer(of, static_cast<std::uint8_t>(value[2]), words, value[7]);
      case 3:
        if (value[2] == 3) ++starved;
        if (value[2] == 2) {
          started[of] = static_cast<std::uint8_t>(value[3]);
          std::snprintf(text, sizeof text, "%.*s", static_cast<int>(words.size()), words.data());
        }
        if (value[2] < 10) return;
        ++finals[of];
        outcome[of] = static_cast<std::uint8_t>(value[2]);
        refusals[of] = static_cast<std::uint8_t>(value[3]);
        std::snprintf(text, sizeof text, "%.*s", static_cast<int>(words.size()), words.data());
        return;
      case 4:
        ++states;
        epoch = static_cast<std::uint32_t>(value[8]);
        stops = std::max(stops, static_cast<std::uint32_t>(value[28]));
        outputs = static_cast<std::uint32_t>(value[26]);
        outputs_mask = static_cast<std::uint32_t>(value[27]);
        return;
      case 5: ++feedbacks; return;
      case 6:
        ++events;
        std::snprintf(event, sizeof event, "%.*s", static_cast<int>(words.size()), words.data());
        return;
      case 8:
        ++pages;
        total = static_cast<std::uint32_t>(value[3]);
        sets = static_cast<std::uint32_t>(value[4]);
        return;
      default: credit += static_cast<std::int64_t>(value[1]);
    }
  }
  void take_zero(const RawFields& field) {
    if (field.field == 2) zeros = 0;  // of every report
    if (field.field != 9) return;
    zeros = field.block_size / sizeof(double);
    assert_true(zeros <= zero.size());
    std::memcpy(zero.data(), field.block, field.block_size);
  }
  void take_answer(std::size_t of, std::uint8_t its_status, std::string_view words,
                   std::uint64_t its_epoch) {
    if (of == 0) final_status = its_status;
    ++answers[of];
    status[of] = its_status;
    epoch = static_cast<std::uint32_t>(its_epoch);
    std::snprintf(text, sizeof text, "%.*s", static_cast<int>(words.size()), words.data());
  }
  bool finished() const { return server->finished(slot, clock->now_ns); }
  void close() {
    if (slot >= 0) server->closed(slot, clock->now_ns);
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
    a.connect(bench);
    a.hello("A");
    b.connect(bench);
    b.hello("B");
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
  /// B stops the arm; A hears of it and rearms.
  void stop_and_rearm() {
    b.send(ask::kStop);
    run(3);
    a.send(ask::kPing);
    run(1);
    a.send(ask::kRearm);
    run(3);
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
