// Requests to the drives of a UR at any time: in every phase of arming, and in any order.
#include <random>

#include "tests/ur/hal/ur_exchange_bench.hpp"

namespace tactus::ur {
namespace {

/// With a robot in a protective stop and without power.
UrExchange& stopped() {
  UrExchange& bench = g_exchange.emplace();
  bench.stop_robot();
  bench.open();
  return bench;
}

constexpr std::array<DrivePhase, 11> kOnTheWay = {
    {DrivePhase::kModes, DrivePhase::kReleaseStop, DrivePhase::kPowerOn, DrivePhase::kReleaseBrakes,
     DrivePhase::kOtherProgram, DrivePhase::kStandstill, DrivePhase::kRegister, DrivePhase::kUpload,
     DrivePhase::kProgram, DrivePhase::kFirstSetPoint, DrivePhase::kEnabled}};

/// Disabled, and no program is left, nor one that would begin.
void assert_off(UrExchange& bench) {
  for (int i = 0; i < 10; ++i) {
    bench.exchange(DriveRequest::kDisable);
    assert_true(bench.state.drives[0].state == DriveState::kDisabled);
    assert_true(bench.runtime_state() != 2);
  }
}

// Proves URH-30.
void drives_are_disabled_from_any_phase_and_armed_again(void**) {
  for (const DrivePhase phase : kOnTheWay) {
    UrExchange& bench = stopped();
    if (phase != DrivePhase::kModes) bench.exchange_until(DriveRequest::kArm, phase);
    const bool uploaded = bench.robot.uploads() > 0;
    bench.exchange(DriveRequest::kDisable);
    if (arms(phase) && phase != DrivePhase::kModes) assert_true(bench.says(name(phase)));
    bench.exchange_until(DriveRequest::kDisable, DriveState::kDisabled);
    assert_off(bench);
    assert_int_equal(bench.robot.ends(), uploaded ? 1 : 0);
    bench.exchange_until(DriveRequest::kArm, DriveState::kEnabled);
    assert_int_equal(bench.runtime_state(), 2);
    const std::array<double, 6> q = bench.robot.set_point(bench.hal.set_points());
    for (std::size_t i = 0; i < q.size(); ++i) ASSERT_NEAR(q[i], FakeImage().q[i], 1e-12);
  }
}

void a_request_for_what_is_there_changes_nothing(void**) {
  UrExchange& bench = stopped();
  for (int i = 0; i < 5; ++i) bench.exchange(DriveRequest::kFollow);  // nobody has armed them
  assert_true(bench.state.drives[0].state == DriveState::kDisabled);
  bench.exchange_until(DriveRequest::kArm, DriveState::kEnabled);
  for (int i = 0; i < 50; ++i) {
    bench.exchange(i % 2 == 0 ? DriveRequest::kFollow : DriveRequest::kArm);
    assert_true(bench.state.drives[0].state == DriveState::kEnabled);
  }
  assert_int_equal(bench.robot.uploads(), 1);
}

// Proves URH-2.

/// The command counts from the first request to follow; without it the last set-point is repeated.
void nothing_but_the_position_held_is_sent_before_drives_follow(void**) {
  UrExchange& bench = g_exchange.emplace();
  bench.open();
  const JointVector begin = bench.state.q, elsewhere = begin + JointVector::Constant(0.3);
  while (bench.state.drives[0].state != DriveState::kEnabled)
    bench.exchange(DriveRequest::kArm, elsewhere);
  for (int i = 0; i < 20; ++i) {
    const std::int32_t count = bench.hal.set_points();
    bench.exchange(DriveRequest::kArm, elsewhere);
    ASSERT_NEAR(bench.robot.set_point(count + 1)[3], begin[3], 1e-12);
  }
  bench.exchange(DriveRequest::kFollow, elsewhere);
  ASSERT_NEAR(bench.robot.set_point(bench.hal.set_points())[3], elsewhere[3], 1e-12);
  bench.exchange(DriveRequest::kArm, begin);
  ASSERT_NEAR(bench.robot.set_point(bench.hal.set_points())[3], elsewhere[3], 1e-12);
}

// Proves URH-30.

/// Requests of random length, at a robot that is healthy but for what arming can mend.
void requests_in_any_order_end_where_the_last_one_says(void**) {
  std::mt19937 random(20);
  const auto upto = [&](int most) { return std::uniform_int_distribution<>(0, most)(random); };
  constexpr std::array<DriveRequest, 3> kRequests = {
      {DriveRequest::kDisable, DriveRequest::kArm, DriveRequest::kFollow}};
  std::array<int, kNames<DrivePhase>.size()> flips{};
  for (int trial = 0; trial < 40; ++trial) {
    UrExchange& bench = stopped();
    bench.robot.faults.begins_late = upto(6);
    DriveRequest request = DriveRequest::kDisable;
    for (int flip = 0; flip < 25; ++flip) {
      ++flips[static_cast<std::size_t>(bench.hal.phase())];
      request = kRequests[static_cast<std::size_t>(upto(2))];
      for (int i = upto(12); i >= 0; --i) {
        const std::int32_t before = bench.robot.count();
        bench.exchange(request);
        const DriveState state = bench.state.drives[0].state;
        assert_true(state != DriveState::kFault && state != DriveState::kUnknown);
        if (request == DriveRequest::kDisable) assert_true(bench.robot.count() <= before);
        for (int joint = 0; joint < kDof; ++joint)
          ASSERT_NEAR(bench.state.q[joint], FakeImage().q[static_cast<std::size_t>(joint)], 1e-12);
      }
    }
    bench.exchange_until(DriveRequest::kDisable, DriveState::kDisabled);
    assert_off(bench);
    bench.exchange_until(DriveRequest::kArm, DriveState::kEnabled);
    assert_int_equal(bench.runtime_state(), 2);
  }
  for (const DrivePhase phase : kOnTheWay)
    if (phase != DrivePhase::kModes) assert_true(flips[static_cast<std::size_t>(phase)] > 0);
  assert_true(flips[static_cast<std::size_t>(DrivePhase::kStopping)] > 0);
}

// Proves URH-1.

/// Cycles without a packet do not count.
void the_register_is_clear_for_five_packets_before_the_upload(void**) {
  UrExchange& bench = g_exchange.emplace();
  bench.settings.max_missed = 100;
  bench.open();
  bench.exchange_until(DriveRequest::kArm, DrivePhase::kRegister);
  bench.exchange(DriveRequest::kArm);
  for (int packets = 1; packets <= 5; ++packets) {
    assert_string_equal(name(bench.hal.phase()), name(DrivePhase::kRegister));
    bench.exchange_without_packet(DriveRequest::kArm, bench.state.q);
    assert_string_equal(name(bench.hal.phase()), name(DrivePhase::kRegister));
    bench.exchange(DriveRequest::kArm);
  }
  assert_string_equal(name(bench.hal.phase()), name(DrivePhase::kUpload));
}

// Proves URH-8.
void a_fault_stays_until_arming_is_requested_anew(void**) {
  UrExchange& bench = g_exchange.emplace();
  bench.open();
  bench.exchange_until(DriveRequest::kArm, DriveState::kEnabled);
  const int connections = bench.robot.connections();
  bench.robot.change([](FakeImage& image) { image.safety_mode = 3; });
  for (const DriveRequest request :
       {DriveRequest::kFollow, DriveRequest::kArm, DriveRequest::kArm}) {
    bench.exchange(request);
    assert_true(bench.state.drives[0].state == DriveState::kFault);
    ASSERT_STATUS(bench.state.drives[0].reason, Status::kProtectiveStop);
  }
  bench.robot.change([](FakeImage& image) {
    image.safety_mode = 1;
    image.runtime_state = 1;
  });
  for (const DriveRequest request : {DriveRequest::kArm, DriveRequest::kDisable}) {
    bench.exchange(request);
    assert_true(bench.state.drives[0].state == DriveState::kFault);
  }
  bench.exchange(DriveRequest::kArm);
  bench.exchange(DriveRequest::kArm);
  assert_true(bench.state.drives[0].state == DriveState::kArming);
  bench.exchange_until(DriveRequest::kArm, DriveState::kEnabled);
  assert_int_equal(bench.robot.connections(), connections);
}

// Proves URH-20.
void a_wire_that_is_closed_leaves_a_program_that_was_told_to_end(void**) {
  UrExchange& bench = g_exchange.emplace();
  bench.open();
  bench.exchange_until(DriveRequest::kArm, DriveState::kEnabled);
  static_cast<void>(bench.hal.disconnect());
  bench.robot.set_point(kServoEnded);
  static_cast<void>(bench.hal.disconnect());
  ASSERT_STATUS(bench.hal.read(bench.now, bench.state), Status::kNotStarted);
  ASSERT_STATUS(bench.hal.write({}), Status::kNotStarted);
  const std::int64_t before_ns = bench.now.stamp_ns;
  ASSERT_OK(bench.hal.wait(bench.now));  // the cycles go on
  assert_int_equal(bench.now.stamp_ns - before_ns, 8'000'000);
  bench.robot.settle();
  assert_int_equal(bench.robot.ends(), 1);
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(drives_are_disabled_from_any_phase_and_armed_again),
      cmocka_unit_test(a_request_for_what_is_there_changes_nothing),
      cmocka_unit_test(nothing_but_the_position_held_is_sent_before_drives_follow),
      cmocka_unit_test(requests_in_any_order_end_where_the_last_one_says),
      cmocka_unit_test(the_register_is_clear_for_five_packets_before_the_upload),
      cmocka_unit_test(a_fault_stays_until_arming_is_requested_anew),
      cmocka_unit_test(a_wire_that_is_closed_leaves_a_program_that_was_told_to_end),
  };
  return cmocka_run_group_tests(tests, nullptr, end_exchange);
}
