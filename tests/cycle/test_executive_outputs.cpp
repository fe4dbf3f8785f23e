// Digital outputs on their way from a generator through the cycle to the robot, on every rung, and
// into the recorder.
#include "tests/cycle/executive_bench.hpp"
#include "tests/support/testing.hpp"

namespace {

using namespace tactus;

constexpr std::string_view kWired = R"(
[robot]
name      = fer
period_us = 1000
dq_c      = jrg.dq_d
outputs   = jrg.outputs
[guard]
limiting_share = 1
[jrg]
type = joint_reference_generator
q    = robot.q
)";

/// Commands outputs by a point that stays where the arm is.
void set_outputs(ExecutiveBench& bench, const DigitalOutputs& outputs) {
  JointSpace::Point here;
  here.q = bench.hal.state.q;
  std::uint32_t id = 0;
  assert_true(bench.client.send(here, id, {}, {outputs}).ok());
}

// Proves OUT-4.

void outputs_are_sent_in_the_cycle_of_their_point(void**) {
  ExecutiveBench& bench = fresh_bench(kWired);
  ASSERT_OK(bench.start());
  ASSERT_OK(bench.cycle());
  assert_true(bench.hal.sent.outputs == DigitalOutputs());
  set_outputs(bench, {1, 3});
  ASSERT_OK(bench.cycle());
  assert_true((bench.hal.sent.outputs == DigitalOutputs{1, 3}));
}

/// A halt brakes on the path, a fault of a sensor at once, and a drive that is lost disables.
void every_rung_keeps_the_outputs(void**) {
  enum class Cause : std::uint8_t { kHalt, kState, kDrive, kWire };
  for (const Cause cause : {Cause::kHalt, Cause::kState, Cause::kDrive, Cause::kWire}) {
    ExecutiveBench& bench = fresh_bench(kWired);
    ASSERT_OK(bench.start());
    set_outputs(bench, {5, 7});
    for (int i = 0; i < 5; ++i) ASSERT_OK(bench.cycle());
    if (cause == Cause::kHalt) bench.executive.halt();
    if (cause == Cause::kState) bench.hal.state.q[0] = std::nan("");
    if (cause == Cause::kDrive) bench.hal.state.drives[2].state = DriveState::kFault;
    if (cause == Cause::kWire) bench.hal.read_status = Status::kBusTimeout;
    for (int i = 0; i < 4000; ++i) {
      static_cast<void>(bench.cycle());
      assert_true((bench.hal.sent.outputs == DigitalOutputs{5, 7}));
    }
    assert_true(bench.executive.rung() == Rung::kDisabled);
    assert_true(bench.hal.sent.request == DriveRequest::kDisable);
  }
}

// Proves OUT-8.

void a_pipeline_without_the_wire_sends_none(void**) {
  ExecutiveBench& bench = fresh_bench(kVelocities);
  ASSERT_OK(bench.start());
  set_outputs(bench, {5, 7});
  for (int i = 0; i < 5; ++i) ASSERT_OK(bench.cycle());
  assert_true(bench.hal.sent.outputs == DigitalOutputs());
  assert_int_equal(bench.pipeline.robot.offered, 0);
}

void a_robot_without_outputs_refuses_the_wire(void**) {
  for (const std::uint32_t offered : {0u, 0xffu}) {
    static std::optional<RoomyPipeline> pipeline;
    static std::optional<ChannelMemory<JointSpace>> channel;
    RoomyPipeline& loaded = pipeline.emplace();
    Capabilities robot = FakeHal().capabilities();
    robot.outputs = offered;
    Loader loader({&channel.emplace()}, robot);
    LoadError error;
    const Status status = loader.load(kWired, loaded, error);
    if (offered != 0) {
      ASSERT_OK(status);
      assert_int_equal(loaded.robot.offered, offered);
      continue;
    }
    ASSERT_STATUS(status, Status::kNotOffered);
    assert_string_equal(error.message().c_str(),
                        "6: [robot] outputs: the robot has no digital outputs; remove the key, or "
                        "take a board whose robot has some");
  }
}

void only_wired_outputs_are_recorded_unasked(void**) {
  const auto recorded = [](const Pipeline& pipeline) {
    for (int i = 0; i < pipeline.recording.signal_count; ++i)
      if (pipeline.recording.signals[static_cast<std::size_t>(i)]->quantity ==
          Quantity::kDigitalOutputs)
        return pipeline.recording.signals[static_cast<std::size_t>(i)];
    return static_cast<const PortEntry*>(nullptr);
  };
  assert_null(recorded(fresh_bench(kVelocities).pipeline));
  ExecutiveBench& bench = fresh_bench(kWired);
  const PortEntry* const port = recorded(bench.pipeline);
  assert_non_null(port);
  ASSERT_OK(bench.start());
  set_outputs(bench, {0x80000001, 0xffffffff});
  ASSERT_OK(bench.cycle());
  std::array<double, 2> numbers{};
  assert_int_equal(flatten(*port, numbers.data()), 2);
  assert_true(numbers[0] == 2147483649.0 && numbers[1] == 4294967295.0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(outputs_are_sent_in_the_cycle_of_their_point),
      cmocka_unit_test(every_rung_keeps_the_outputs),
      cmocka_unit_test(a_pipeline_without_the_wire_sends_none),
      cmocka_unit_test(a_robot_without_outputs_refuses_the_wire),
      cmocka_unit_test(only_wired_outputs_are_recorded_unasked),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
