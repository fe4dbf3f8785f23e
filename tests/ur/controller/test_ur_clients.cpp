// Tests behaviour that existing clients rely on: single lines streamed at the cycle's rate, several
// secondary programs at once, the old numbers of outputs.
#include <unistd.h>

#include "sim_plant/ur/server/options.hpp"
#include "tests/ur/controller/ur_state_client.hpp"

namespace tactus::ur {
namespace {

// Proves URE-35.

void speeds_streamed_as_single_lines_add_up_to_a_motion(void**) {
  connect_clients();
  const double a = 2.0;  // rad/s^2
  for (int k = 1; k <= 100; ++k) {
    g_bench.send(g_primary, "speedj([0, 0, 0, 0, 0, 0.3], 2.0, 0.008)\n");
    g_bench.ticks(1);
    ASSERT_NEAR(g_bench.image().target_qd[5], std::min(0.3, a * kCycle_s * k), 1e-9);
  }
  for (int k = 0; k < 100; ++k) {  // every third line is a cycle late
    if (k % 3 != 0) g_bench.send(g_primary, "speedj([0, 0, 0, 0, 0, 0.3], 100.0, 0.008)\n");
    g_bench.ticks(1);
    assert_true(g_bench.image().target_qd[5] > 0.25);
  }
  g_bench.ticks(40);  // the stream ends: the arm comes to rest
  assert_true(g_bench.image().target_qd.isZero(0.0));
  assert_false(g_bench.image().protective_stopped);
}

void a_line_that_is_no_motion_and_a_whole_program_find_the_arm_at_rest(void**) {
  for (const char* text :
       {"set_payload(1.0)\n", "sleep(1)\n",
        "def whole():\n  sleep(0.1)\n  speedj([0,0,0,0,0,0.3], 2.0, 1)\nend\n"}) {
    connect_clients();
    g_bench.send(g_primary, "speedj([0, 0, 0, 0, 0.4, 0], 4.0, 1)\n");
    g_bench.ticks(20);
    ASSERT_NEAR(g_bench.image().target_qd[4], 0.4, 1e-9);
    g_bench.send(g_primary, text);
    g_bench.ticks(20);
    assert_false(g_bench.image().protective_stopped);
    assert_true(g_bench.image().target_qd.isZero(0.0));
  }
}

// Proves URE-34.

void secondary_programs_that_come_at_once_all_have_their_turn(void**) {
  connect_clients();
  g_bench.send(g_primary,
               "sec one():\n\tset_standard_digital_out(0, True)\nend\n"
               "sec two():\n\tset_configurable_digital_out(1, True)\nend\n"
               "sec three():\n\tset_standard_analog_out(0, 0.5)\nend\n"
               "sec wrong():\n\tnobody_knows(1)\nend\n"
               "sec four():\n\tset_tool_digital_out(1, True)\nend\n");
  g_bench.ticks(2);
  assert_int_equal(g_bench.image().actual_digital_output_bits, 1 << 0 | 1 << 9 | 1 << 17);
  ASSERT_NEAR(g_bench.image().standard_analog_output0, 0.012, 1e-9);
  assert_true(g_bench.take(g_primary).find("name_not_found:nobody_knows:") !=
              std::string_view::npos);
}

void outputs_have_the_numbers_they_had_before_version_3_too(void**) {
  connect_clients();
  const auto bits = [](const char* text) {
    g_bench.send(g_primary, text);
    g_bench.ticks(3);
    return static_cast<unsigned>(g_bench.image().actual_digital_output_bits);
  };
  assert_int_equal(bits("set_digital_out(7, True)\n"), 0x80);
  assert_int_equal(bits("set_digital_out(8, True)\n"), 0x10080);  // the tool's first output
  assert_int_equal(bits("set_digital_out(10, True)\n"), 0x10080);
  assert_int_equal(bits("digital_out[2]=True\n"), 0x10084);
  assert_int_equal(bits("digital_out[9] = 1\n"), 0x30084);
  assert_int_equal(bits("digital_out[7]=False\n"), 0x30004);
  assert_int_equal(bits("set_configurable_digital_out(0, get_digital_out(9))\n"), 0x30104);
  assert_int_equal(bits("set_standard_digital_out(0, get_digital_out(8))\n"), 0x30105);
}

// Proves URE-5.

void the_build_is_told_from_version_3_3(void**) {
  struct Row {
    Version version;
    std::string_view numbers;
  };
  using namespace std::string_view_literals;
  for (const Row& row : {Row{{3, 2, 19171, 7},
                             "\3\2\0\0\x4a\xe3"
                             "0"sv},
                         Row{{3, 3, 1, 60},
                             "\3\3\0\0\0\1\0\0\0\x3c"
                             "0"sv},
                         Row{{3, 15, 8, 106339},
                             "\3\x0f\0\0\0\x8\0\1\x9f\x63"
                             "0"sv}}) {
    Settings settings;
    settings.version = row.version;
    g_bench.start(settings);
    const int client = g_bench->open(Service::kSecondary);
    const std::string_view got = g_bench.take(client);
    // After the packet's head, time, source, type and name: the version numbers and the date.
    assert_true(got.substr(25, row.numbers.size()) == row.numbers);
  }
}

void the_version_of_the_command_line_has_room_for_old_revisions(void**) {
  const auto parsed = [](const char* version, EmulatorOptions& options) {
    char name[] = "tactus", option[] = "--software", value[64];
    std::snprintf(value, sizeof value, "%s", version);
    char* arguments[] = {name, option, value};
    int exit_code = 0;
    return parse_emulator_options(3, arguments, options, exit_code);
  };
  EmulatorOptions options;
  assert_true(parsed("3.2.19171.0", options));
  assert_int_equal(options.version[1], 2);
  assert_int_equal(options.version[2], 19171);
  assert_true(parsed("5.11.1.108318", options));
  constexpr struct {
    const char *version, *why;
  } kWrong[] = {{"5.0", "'5.0' has not four whole numbers"},
                {"3.2.19171", "'3.2.19171' has not four whole numbers"},
                {"3.2.x.0", "'3.2.x.0' has not four whole numbers"},
                {"3.2.-1.0", "'3.2.-1.0' has not four whole numbers"},
                {"3.2.0.0.1", "'3.2.0.0.1' has not four whole numbers"},
                {"6.1.0.0", "'6.1.0.0': the first number is 6; it must be 3 or 5\n"}};
  for (const auto& [version, why] : kWrong) {
    std::FILE* const said = std::tmpfile();
    const int errors = dup(2);
    dup2(fileno(said), 2);
    const bool taken = parsed(version, options);
    dup2(errors, 2);
    close(errors);
    char text[512] = "";
    std::rewind(said);
    const std::size_t size = std::fread(text, 1, sizeof text - 1, said);
    std::fclose(said);
    assert_false(taken);
    assert_non_null(std::strstr(text, why));
    assert_true(std::strstr(text, "the first number") == nullptr || text[size - 2] == '5');
  }
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(speeds_streamed_as_single_lines_add_up_to_a_motion),
      cmocka_unit_test(a_line_that_is_no_motion_and_a_whole_program_find_the_arm_at_rest),
      cmocka_unit_test(secondary_programs_that_come_at_once_all_have_their_turn),
      cmocka_unit_test(outputs_have_the_numbers_they_had_before_version_3_too),
      cmocka_unit_test(the_build_is_told_from_version_3_3),
      cmocka_unit_test(the_version_of_the_command_line_has_room_for_old_revisions),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
