// Tests external control: messages over the reverse socket, and the robot's reaction to silence.
#include "tests/ur/programs/ur_external_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

// Proves URP-5.

void it_connects_to_the_address_in_the_text_in_order(void**) {
  static ExternalBench bench;
  bench.start_unconnected();
  Link& first = bench.link("trajectory_socket");
  assert_string_equal(first.host(), "10.0.0.7");
  assert_int_equal(first.port(), 50003);
  assert_false(bench.connected("reverse_socket"));
  bench.run(1);
  assert_int_equal(bench.link("script_command_socket").port(), 50004);
  bench.run(1);
  assert_int_equal(bench.link("reverse_socket").port(), 50001);
}

void it_is_recognised_whichever_line_is_cut_or_added(void**) {
  static ExternalBench bench;
  bench.start();
  const std::string_view whole(bench.text.data(), bench.size);
  static std::array<char, 4096> changed;
  std::size_t begin = whole.find('\n') + 1;
  for (std::size_t end; (end = whole.find('\n', begin) + 1) < whole.size(); begin = end) {
    const std::string_view line = whole.substr(begin, end - begin);
    const bool connects = line.find("_with_retry(\"") != std::string_view::npos;
    for (const std::string_view instead : {"", "  sync()  # \"reverse_socket\"\n"}) {
      if (instead.empty() && connects) continue;
      std::size_t size = 0;
      for (const std::string_view part :
           {whole.substr(0, begin), instead, instead.empty() ? "" : line, whole.substr(end)}) {
        std::memcpy(changed.data() + size, part.data(), part.size());
        size += part.size();
      }
      bench.upload({changed.data(), size});
      bench.run(6);
      assert_true(bench.connected("reverse_socket"));
    }
  }
  assert_false(bench.said.has("compile_error"));
}

void nobody_listening_is_a_popup_and_no_motion(void**) {
  static ExternalBench bench;
  bench.listening = false;
  bench.start_unconnected();
  bench.run_s(3.0);
  assert_int_equal(bench.said.count("Error connecting"), 1);
  assert_joints(bench.target(), kStart, 0.0);
}

void a_socket_that_cannot_be_opened_closes_those_before_it(void**) {
  static ExternalBench bench;
  bench.start_unconnected();
  assert_true(bench.connected("trajectory_socket"));
  bench.listening = false;
  bench.run_s(3.0);
  assert_false(bench.connected("trajectory_socket"));
}

/// The published example: SERVOJ (0, -1.2, 1.2, -0.1, 1.57, 0), 20 ms.
void the_example_message_moves_the_arm_to_its_position(void**) {
  constexpr std::uint8_t kExample[] = {0x00, 0x00, 0x00, 0x14, 0x00, 0x00, 0x00, 0x00,
                                       0xff, 0xed, 0xb0, 0x80, 0x00, 0x12, 0x4f, 0x80,
                                       0xff, 0xfe, 0x79, 0x60, 0x00, 0x17, 0xf4, 0xd0,
                                       0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x01};
  static ExternalBench bench;
  const Joints near = kStart + Joints::Constant(0.05);
  ASSERT_OK(bench.machine().body.load(near));
  bench.machine().motion.rest(near);
  bench.start();
  for (int k = 0; k < 100; ++k) {
    bench.link("reverse_socket").receive(kExample, sizeof kExample);
    bench.tick();
  }
  assert_true(bench.running());
  assert_joints(bench.target(), joints({0, -1.2, 1.2, -0.1, 1.57, 0}), 1e-4);
  assert_joints(bench.image().actual_q, joints({0, -1.2, 1.2, -0.1, 1.57, 0}), 1e-3);
}

void a_message_in_pieces_is_one_message(void**) {
  static ExternalBench bench;
  bench.start();
  for (int k = 0; k < 200; ++k) {
    std::uint8_t bytes[32];
    ByteWriter writer(bytes, sizeof bytes);
    writer.i32(100);
    const Joints q = beside(0.001 * k);
    for (int i = 0; i < 6; ++i) writer.i32(fixed(q[i]));
    writer.i32(1);
    const std::size_t cut = static_cast<std::size_t>(k) % 32;
    bench.link("reverse_socket").receive(bytes, cut);
    bench.tick();
    bench.link("reverse_socket").receive(bytes + cut, sizeof bytes - cut);
    bench.tick();
  }
  assert_true(bench.running());
  ASSERT_NEAR(bench.target()[0], 0.199, 0.01);
}

void one_missing_set_point_is_extrapolated(void**) {
  static ExternalBench bench;
  bench.start();
  double at = stream(bench, 0.0, 0.5, 100);
  const double speed = bench.image().target_qd[0];
  ASSERT_NEAR(speed, 0.5, 0.01);
  bench.run(1);  // within the 20 ms
  ASSERT_NEAR(bench.image().target_qd[0], 0.5, 0.01);
  at = stream(bench, at + 0.5 * kCycle_s, 0.5, 20);
  ASSERT_NEAR(bench.image().target_qd[0], 0.5, 0.01);
  assert_true(bench.running());
}

void silence_beyond_the_time_out_is_a_stop_with_4_rad_s2(void**) {
  static ExternalBench bench;
  bench.start();
  stream(bench, 0.0, 0.5, 100);
  bench.run(2);
  assert_false(bench.said.has("Socket timed out"));
  bench.run(1);  // 24 ms
  assert_true(bench.said.has("Socket timed out"));
  double before = bench.image().target_qd[0];
  int braking = 0;
  for (; bench.running() && braking < 100; ++braking) {
    bench.tick();
    assert_true(before - bench.image().target_qd[0] <= 4.0 * kCycle_s + 1e-9);
    before = bench.image().target_qd[0];
  }
  assert_in_range(braking, 14, 18);  // 0.5 / 4 s
  ASSERT_NEAR(before, 0.0, 0.0);
  assert_int_equal(bench.image().safety_mode, 1);
}

void the_first_read_waits_for_ever_and_so_does_a_time_out_of_nought(void**) {
  static ExternalBench bench;
  bench.start();
  bench.run_s(10.0);
  assert_true(bench.running());
  bench.reverse(0, ControlMode::kIdle);
  bench.run_s(5.0);
  assert_true(bench.running());
}

void a_closed_socket_ends_it_even_in_the_middle_of_a_message(void**) {
  static ExternalBench bench;
  for (const std::size_t left_over : {0u, 5u, 31u}) {
    bench.start();
    bench.reverse(0, ControlMode::kIdle);
    bench.run(2);
    const std::uint8_t part[32] = {};
    bench.link("reverse_socket").receive(part, left_over);
    bench.link("reverse_socket").lost();
    bench.run(4);
    assert_false(bench.running());
    assert_false(bench.connected("trajectory_socket"));
  }
}

void a_set_point_too_far_away_is_ignored(void**) {
  static ExternalBench bench;
  bench.start();
  bench.reverse_for(100, ControlMode::kServoJ, beside(0.2));  // 25 rad/s
  assert_joints(bench.target(), kStart, 1e-12);
  assert_true(bench.running());
  assert_int_equal(bench.said.count("External Control speed limit"), 1);
  assert_int_equal(bench.said.count("ExternalControl: a set-point is too far"), 1);
  bench.reverse_for(700, ControlMode::kServoJ, beside(0.2));
  assert_int_equal(bench.said.count("External Control speed limit"), 1);
  assert_int_equal(bench.said.count("ExternalControl: a set-point is too far"), 2);
  bench.reverse_for(100, ControlMode::kServoJ, beside(0.15));
  ASSERT_NEAR(bench.target()[0], 0.15, 1e-3);
  bench.reverse_for(10, ControlMode::kServoJ, beside(-0.15));  // once more: another popup
  assert_int_equal(bench.said.count("External Control speed limit"), 2);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(it_connects_to_the_address_in_the_text_in_order),
      cmocka_unit_test(it_is_recognised_whichever_line_is_cut_or_added),
      cmocka_unit_test(nobody_listening_is_a_popup_and_no_motion),
      cmocka_unit_test(a_socket_that_cannot_be_opened_closes_those_before_it),
      cmocka_unit_test(the_example_message_moves_the_arm_to_its_position),
      cmocka_unit_test(a_message_in_pieces_is_one_message),
      cmocka_unit_test(one_missing_set_point_is_extrapolated),
      cmocka_unit_test(silence_beyond_the_time_out_is_a_stop_with_4_rad_s2),
      cmocka_unit_test(the_first_read_waits_for_ever_and_so_does_a_time_out_of_nought),
      cmocka_unit_test(a_closed_socket_ends_it_even_in_the_middle_of_a_message),
      cmocka_unit_test(a_set_point_too_far_away_is_ignored),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
