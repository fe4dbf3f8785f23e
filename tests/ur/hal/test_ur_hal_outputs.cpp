// Tests the digital outputs of a UR over its wire: a second client sees them change in time with
// the set-points, and a robot whose outputs another client has is refused.
#include "gateway/chunk.hpp"
#include "tests/ur/hal/ur_emulated_bench.hpp"

namespace tactus::ur {
namespace {

constexpr std::uint32_t kMask = 0x2'0181;  // standard 0, 7, configurable 0, tool 1

/// A second client, which reads outputs only.
class Observer {
 public:
  struct Row {
    double timestamp_s = 0.0;
    std::int32_t echo = 0;
    std::uint64_t bits = 0;
  };

  void start(std::string_view inputs = {}) {
    Message why;
    ASSERT_OK(stream_.connect("127.0.0.1", kRtdePort + kOffset, Deadline(2000), why));
    ask(RtdeType::kRequestProtocolVersion, [](ByteWriter& out) { out.u16(2); });
    ask(RtdeType::kSetupOutputs, [](ByteWriter& out) {
      out.f64(125.0);
      out.text("timestamp,output_int_register_24,actual_digital_output_bits");
    });
    if (inputs.empty())
      ask(RtdeType::kStart, [](ByteWriter&) {});
    else
      ask(RtdeType::kSetupInputs, [inputs](ByteWriter& out) { out.text(inputs); });
  }
  /// Takes the packages that have come; returns the newest.
  const Row& newest() {
    RtdePacket packet;
    Message why;
    bool any = true;
    while (any) {
      ASSERT_OK(stream_.next(packet, any, why));
      if (!any || packet.type != RtdeType::kDataPackage) continue;
      ByteReader in(packet.payload, packet.size);
      static_cast<void>(in.u8());
      row_.timestamp_s = in.f64();
      row_.echo = in.i32();
      row_.bits = std::uint64_t{in.u32()} << 32;
      row_.bits |= in.u32();
      assert_true(in.done());
    }
    return row_;
  }
  void close() { stream_.socket.close(); }

 private:
  template <class Write>
  void ask(RtdeType type, Write write) {
    std::array<std::uint8_t, 256> bytes;
    ByteWriter request(bytes.data(), bytes.size());
    RtdeStream::begin(request, type);
    write(request);
    assert_true(stream_.send(request) == Socket::Sent::kAll);
    RtdePacket reply;
    Message why;
    bool answered = false;
    for (int i = 0; i < 200 && !answered; ++i) {
      bool any = false;
      ASSERT_OK(stream_.next(reply, any, why));
      answered = any && reply.type == type;
      if (!any) stream_.socket.wait(50'000'000);
    }
    assert_true(answered);
  }

  RtdeStream stream_;
  Row row_;
};

/// A line of joint 1 of which every target has other outputs.
void send_chunk(UrArmBench& bench, double lead_s) {
  static Chunk<JointSpace> chunk;
  chunk = {};
  chunk.epoch = 1000;
  chunk.sequence = 1;
  chunk.outputs_mask = kMask;
  chunk.outputs_lead_s = lead_s;
  chunk.ends = true;
  const double now_s = bench.pipeline.motion_state().time_s;
  JointSpace::Point target;
  target.q = *static_cast<const JointVector*>(bench.pipeline.ports.find("jrg.q_d")->value);
  for (int i = 0; i < 40; ++i) {
    const double t = 0.05 * i;
    target.q[0] += i == 0 ? 0.0 : 0.01 * std::sin(t);
    chunk.add(now_s + 0.1 + t, target, i % 2 == 0 ? kMask : kMask >> 1);
  }
  std::uint32_t id = 0;
  assert_true(bench.client.send(chunk, id).ok());
}

// Proves OUT-9.

void outputs_change_with_the_set_points_of_their_targets(void**) {
  UrArmBench& bench = fresh_arm({}, 8000, true);
  Observer observer;
  observer.start();
  ASSERT_OK(start(bench));
  assert_int_equal(observer.newest().bits & kMask, 0);
  send_chunk(bench, 0.0);
  const auto* asked =
      static_cast<const DigitalOutputs*>(bench.pipeline.ports.find("jrg.outputs")->value);
  std::array<std::int32_t, 64> counts{};     // the set-point with which an edge was sent,
  std::array<std::uint32_t, 64> patterns{};  // and its outputs
  std::size_t sent = 0, seen = 0;
  std::uint32_t before = 0;
  int worst = 0;
  for (int k = 0; k < 400; ++k) {
    ASSERT_OK(bench.run_cycle());
    const std::uint32_t now = asked->value & asked->mask;
    if (asked->mask != 0 && (sent == 0 || now != patterns[sent - 1])) {
      counts[sent] = bench.hal.set_points();
      patterns[sent++] = now;
    }
    const Observer::Row row = observer.newest();
    const auto bits = static_cast<std::uint32_t>(row.bits) & kMask;
    if (seen == sent || bits == before) continue;
    before = bits;
    assert_int_equal(bits, patterns[seen]);
    worst = std::max(worst, std::abs(bench.hal.set_points() - counts[seen]));
    assert_true(std::abs(row.echo - counts[seen]) <= 2);  // the set-point of the edge is in use
    ++seen;
  }
  print_message("%d edges; at worst %d cycles from the set-point to actual_digital_output_bits\n",
                static_cast<int>(seen), worst);
  assert_int_equal(sent, 40);
  assert_int_equal(seen, 40);
  assert_true(worst <= 2);
  observer.close();
}

// Proves OUT-10.

void a_stop_keeps_the_outputs_of_the_robot(void**) {
  UrArmBench& bench = fresh_arm({}, 8000, true);
  Observer observer;
  observer.start();
  ASSERT_OK(start(bench));
  std::uint32_t id = 0;
  JointSpace::Point here;
  here.q = bench.hal.state().q;
  assert_true(bench.client.send(here, id, {}, {{kMask, kMask}}).ok());
  for (int k = 0; k < 10; ++k) ASSERT_OK(bench.run_cycle());
  assert_int_equal(observer.newest().bits & kMask, kMask);
  bench.executive.halt();
  for (int k = 0; k < 100; ++k) {
    static_cast<void>(bench.run_cycle());
    assert_int_equal(observer.newest().bits & kMask, kMask);
  }
  static_cast<void>(bench.executive.stop());
  g_robot->pass(50);
  assert_int_equal(observer.newest().bits & kMask, kMask);
  observer.close();
}

// Proves OUT-11.

void outputs_of_another_client_are_claimed_only_where_they_are_put_out(void**) {
  fresh_arm({}, 8000, false);
  Observer other;
  other.start("configurable_digital_output_mask,configurable_digital_output");
  ASSERT_OK(start(*g_arm));
  static_cast<void>(g_arm->executive.stop());
  Tool tool;
  g_arm->hal.configure(g_arm->settings, tool, 8000, true);
  ASSERT_STATUS(g_arm->executive.start(), Status::kRegistersInUse);
  assert_true(g_arm->says("configurable_digital_output_mask is IN_USE"));
  assert_true(g_arm->says("or remove outputs from [robot]"));
  other.close();
}

void every_output_has_a_name(void**) {
  UrArmBench& bench = fresh_arm();
  const std::uint32_t offered = bench.hal.capabilities().outputs;
  for (int i = 0; i < kMostOutputs; ++i)
    assert_int_equal(bench.hal.output_name(i) != nullptr, (offered >> i & 1u) != 0);
  assert_string_equal(bench.hal.output_name(17), "tool_out[1]");
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(outputs_change_with_the_set_points_of_their_targets),
      cmocka_unit_test(a_stop_keeps_the_outputs_of_the_robot),
      cmocka_unit_test(outputs_of_another_client_are_claimed_only_where_they_are_put_out),
      cmocka_unit_test(every_output_has_a_name),
  };
  return cmocka_run_group_tests(tests, nullptr, end_arm);
}
