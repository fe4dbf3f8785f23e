// Tests set-points that a UR does not take: a robot that stops reading, takes a part, or is gone.
#include "tests/ur/hal/ur_moving_bench.hpp"

namespace tactus::ur {
namespace {

// Proves URH-10, URH-8.

/// Commands the arm to stay until the buffers between the two are full; from then on `max_missed`
/// set-points in a row may be lost.
void a_robot_that_stops_reading_is_a_wire_that_is_lost(void**) {
  struct Row {
    int max_missed;
    const char* reason;
  };
  for (const Row& row : {Row{5, "no set-point could be sent for 6 periods, limit 5"},
                         Row{0, "no set-point could be sent for 1 period, limit 0"}}) {
    UrHalBench& bench = g_bench.emplace();
    bench.settings.max_missed = row.max_missed;
    ASSERT_OK(bench.start());
    ASSERT_OK(bench.cycles(10));
    bench.robot.stop_reading();
    bench.robot.change(
        [](FakeImage& image) { image.speed_fraction = 0.0; });  // its program may stand
    assert_true(cycles_until_stopped(bench, 100000) > 100);
    assert_disabled_by_wire(bench, Status::kBusTimeout);
    assert_true(bench.says(row.reason));
    bench.robot.read_on();
    assert_reconnects_without_motion(bench);
  }
}

// Proves URH-12.

void a_connection_that_takes_no_set_points_any_more_ends_the_motion(void**) {
  UrHalBench& bench = moving();
  bench.robot.drop_rtde();
  const RobotCommand command = {CommandMode::kPosition, bench.hal.state().q, DriveRequest::kFollow};
  Status status = Status::kOk;  // the first may still find the way open
  for (int i = 0; i < 1000 && status == Status::kOk; ++i) {
    status = bench.hal.write(command);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_STATUS(status, Status::kConnectionLost);
  assert_true(bench.says("the connection no longer accepts set-points"));
  RobotState state;
  ASSERT_STATUS(bench.hal.read({}, state), Status::kConnectionLost);
  ASSERT_STATUS(bench.hal.write(command), Status::kConnectionLost);
}

/// Sends more at once than all buffers hold; a message sent in part cannot be taken back.
void what_is_taken_in_part_is_a_connection_that_is_lost(void**) {
  FakeController robot;
  robot.start();
  robot.stop_reading();
  Socket socket;
  Message why;
  ASSERT_OK(socket.connect("127.0.0.1", robot.rtde_port(), Deadline(1000), why));
  static const std::array<std::uint8_t, 1 << 26> kBytes{};
  assert_true(socket.send(kBytes.data(), 56) == Socket::Sent::kAll);
  assert_true(socket.send(kBytes.data(), kBytes.size()) == Socket::Sent::kLost);
  while (socket.send(kBytes.data(), 56) == Socket::Sent::kAll) {
  }
  assert_true(socket.send(kBytes.data(), 56) == Socket::Sent::kNothing);
  robot.stop();
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_robot_that_stops_reading_is_a_wire_that_is_lost),
      cmocka_unit_test(a_connection_that_takes_no_set_points_any_more_ends_the_motion),
      cmocka_unit_test(what_is_taken_in_part_is_a_connection_that_is_lost),
  };
  const int failed = cmocka_run_group_tests(tests, nullptr, nullptr);
  g_bench.reset();
  return failed;
}
