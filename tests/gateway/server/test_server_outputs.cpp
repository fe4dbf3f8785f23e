// Tests the digital outputs of points and chunks at the server: what is told, refused and put out.
#include <cmath>

#include "tests/gateway/server/client_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr std::uint32_t kOffered = 0x2d;  // 0, 2, 3 and 5

/// Clients of a pipeline that puts four outputs out.
TwoClients& clients_of_outputs() {
  static const DigitalOutputs wire;
  TwoClients& two = fresh_clients();
  two.bench.pipeline.robot.outputs.source = &wire;
  two.bench.pipeline.robot.offered = kOffered;
  two.a.close();
  two.a.greet("A");
  two.run(1);
  two.a.lease();
  two.run(1);
  return two;
}

struct TestChannel {
  std::uint32_t output;
  int values;
  std::uint32_t pattern;  // bit i: value i
};

/// A chunk of five targets at home, 20 ms apart from 20 ms on, with these channels.
RawMessage chunk_with(const TestChannel* channels, int count, double lead_s = 0.0) {
  RawMessage body;
  std::array<double, 5> times;
  std::array<double, 5 * kDof> q;
  const JointVector home = ServerBench::home().q;
  for (std::size_t i = 0; i < times.size(); ++i) {
    times[i] = 0.02 * static_cast<double>(i + 1);
    for (std::size_t k = 0; k < kDof; ++k) q[i * kDof + k] = home[static_cast<Eigen::Index>(k)];
  }
  body.number(3, 1).number(7, 1).reals(9, times.data(), times.size());
  body.reals(10, q.data(), q.size());
  for (int c = 0; c < count; ++c) {
    std::array<std::uint8_t, 256> values{};
    for (int i = 0; i < channels[c].values; ++i)
      values[static_cast<std::size_t>(i)] = channels[c].pattern >> (i % 32) & 1u;
    body.message(14, RawMessage()
                         .number(1, channels[c].output)
                         .block(2, values.data(), static_cast<std::size_t>(channels[c].values)));
  }
  return body.real(15, lead_s);
}

// Proves OUT-6.

void a_client_is_told_what_outputs_there_are_and_how_they_are(void**) {
  TwoClients& two = clients_of_outputs();
  assert_int_equal(two.a.offered, kOffered);
  assert_int_equal(two.b.offered, 0);  // its Welcome was before
  two.a.send(ask::kSubscribe, RawMessage().number(1, 1));
  const TestChannel channels[] = {{0, 5, 0b10101}, {5, 5, 0b00110}};
  const std::uint32_t sent = two.a.send(ask::kChunk, chunk_with(channels, 2));
  std::array<std::uint32_t, 8> seen{};
  std::size_t changes = 0;
  for (int k = 0; k < 300; ++k) {
    two.run(1);
    assert_int_equal(two.a.outputs_mask & ~0x21u, 0);
    if (two.a.outputs_mask == 0 || (changes > 0 && two.a.outputs == seen[changes - 1])) continue;
    assert_true(changes < seen.size());
    seen[changes++] = two.a.outputs;
  }
  assert_int_equal(two.a.outcome[sent], 14);  // EXECUTED
  constexpr std::array<std::uint32_t, 5> kExpected = {0x01, 0x20, 0x21, 0x00, 0x01};
  assert_int_equal(changes, kExpected.size());
  for (std::size_t i = 0; i < changes; ++i) assert_int_equal(seen[i], kExpected[i]);
}

// Proves OUT-7.

void channels_that_cannot_be_put_out_are_refused(void**) {
  struct Case {
    std::array<TestChannel, 2> channels;
    int count;
    double lead_s;
    Status status;
    const char* text;
  };
  const Case cases[] = {
      {{{{1, 5, 0}}},
       1,
       0.0,
       Status::kNotOffered,
       "Chunk.channels[0].output: there is no digital output 1; take one of 0 2 3 5"},
      {{{{0, 5, 0}, {32, 5, 0}}},
       2,
       0.0,
       Status::kNotOffered,
       "Chunk.channels[1].output: there is no digital output 32; take one of 0 2 3 5"},
      {{{{4294967295u, 5, 0}}}, 1, 0.0, Status::kNotOffered, "no digital output"},
      {{{{0, 5, 0}, {0, 5, 1}}},
       2,
       0.0,
       Status::kBadValue,
       "Chunk.channels[1].output: output 0 has a channel before this one; give it one"},
      {{{{2, 4, 0}}},
       1,
       0.0,
       Status::kBadValue,
       "Chunk.channels[0].values has 4 values instead of 5; give one per target"},
      {{{{2, 6, 0}}}, 1, 0.0, Status::kBadValue, "has 6 values instead of 5"},
      {{{{2, 0, 0}}}, 1, 0.0, Status::kBadValue, "has 0 values instead of 5"},
      {{{{2, 5, 1}}},
       1,
       0.51,
       Status::kBadValue,
       "Chunk.outputs_lead_s 0.51 s is not from -0.5 to 0.5 s"},
      {{{{2, 5, 1}}}, 1, -0.51, Status::kBadValue, "Chunk.outputs_lead_s -0.51 s is not"},
      {{{{2, 5, 1}}}, 1, std::nan(""), Status::kBadValue, "Chunk.outputs_lead_s nan s is not"},
  };
  TwoClients& two = clients_of_outputs();
  for (const Case& one : cases) {
    const std::uint32_t sent =
        two.a.send(ask::kChunk, chunk_with(one.channels.data(), one.count, one.lead_s));
    two.run(1);
    assert_int_equal(two.a.status[sent], static_cast<int>(one.status));
    const bool says = std::strstr(two.a.text, one.text) != nullptr;
    if (!says) print_error("'%s' is not in '%s'\n", one.text, two.a.text);
    assert_true(says);
    two.run(200);
    assert_int_equal(two.bench.generator.outputs().mask, 0);
  }
}

void nine_channels_cut_the_client(void**) {
  TwoClients& two = clients_of_outputs();
  std::array<TestChannel, 9> channels{};
  for (TestChannel& channel : channels) channel = {0, 5, 0};
  two.a.send(ask::kChunk, chunk_with(channels.data(), 9));
  two.run(2);
  assert_int_equal(two.a.final_status, static_cast<int>(Status::kBadValue));
}

void a_pipeline_that_puts_none_out_refuses_them(void**) {
  TwoClients& two = fresh_clients();
  two.a.lease();
  const TestChannel channel = {0, 5, 1};
  const std::uint32_t chunk = two.a.send(ask::kChunk, chunk_with(&channel, 1));
  two.run(1);
  assert_int_equal(two.a.status[chunk], static_cast<int>(Status::kNotOffered));
  assert_non_null(std::strstr(two.a.text, "wire [robot] outputs to its generator"));
  RawMessage whole;  // a feature that is required
  whole.number(1, ++two.a.number).number(3, 4).message(ask::kPing, {});
  two.a.send_bytes(whole);
  two.run(1);
  assert_int_equal(two.a.status[two.a.number], static_cast<int>(Status::kNotOffered));
  TwoClients& wired = clients_of_outputs();
  whole.size = 0;
  whole.number(1, ++wired.a.number).number(3, 4).message(ask::kPing, {});
  wired.a.send_bytes(whole);
  wired.run(1);
  assert_int_equal(wired.a.status[wired.a.number], 0);
}

void a_point_sets_outputs_that_there_are(void**) {
  TwoClients& two = clients_of_outputs();
  const JointVector q = ServerBench::home().q;
  const auto point = [&q](std::uint32_t value, std::uint32_t mask) {
    return RawMessage()
        .message(3, RawMessage().reals(1, q.data(), static_cast<std::size_t>(kDof)))
        .number(5, value)
        .number(6, mask);
  };
  const std::uint32_t taken = two.a.send(ask::kPoint, point(0xffffffff, 5));
  two.run(3);
  assert_int_equal(two.a.status[taken], 0);
  assert_true((two.bench.generator.outputs() == DigitalOutputs{5, 5}));
  const std::uint32_t refused = two.a.send(ask::kPoint, point(0, 6));
  two.run(3);
  assert_int_equal(two.a.status[refused], static_cast<int>(Status::kNotOffered));
  assert_non_null(std::strstr(two.a.text, "Point.outputs_mask: there is no digital output 1"));
  assert_true((two.bench.generator.outputs() == DigitalOutputs{5, 5}));
}

/// Whatever channels come, no output is commanded that there is not.
void random_channels_reach_only_outputs_that_there_are(void**) {
  TwoClients& two = clients_of_outputs();
  Random random{7};
  int taken = 0;
  for (int k = 0; k < 2000; ++k) {
    std::array<TestChannel, 8> channels{};
    for (TestChannel& channel : channels) {
      channel.output = static_cast<std::uint32_t>(random.below(random.below(10) < 8 ? 6 : 100));
      channel.values = random.below(20) > 0 ? 5 : random.below(129);
      channel.pattern = static_cast<std::uint32_t>(random.below(32));
    }
    const double lead_s = random.uniform(-0.6, 0.6);
    const std::uint32_t sent =
        two.a.send(ask::kChunk, chunk_with(channels.data(), random.below(3), lead_s));
    two.run(1 + random.below(30));
    assert_int_equal(two.a.answers[sent % TestClient::kMost], 1);
    if (two.a.status[sent % TestClient::kMost] == 0) ++taken;
    assert_int_equal(two.bench.generator.outputs().mask & ~kOffered, 0);
  }
  assert_int_equal(two.a.final_status, 0);
  assert_true(taken > 200);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_client_is_told_what_outputs_there_are_and_how_they_are),
      cmocka_unit_test(channels_that_cannot_be_put_out_are_refused),
      cmocka_unit_test(nine_channels_cut_the_client),
      cmocka_unit_test(a_pipeline_that_puts_none_out_refuses_them),
      cmocka_unit_test(a_point_sets_outputs_that_there_are),
      cmocka_unit_test(random_channels_reach_only_outputs_that_there_are),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
