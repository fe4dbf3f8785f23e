// Tests the page of `tactus serve` as a program, by the modules in tests/gateway/page: with
// sockets, and with Chromium.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

/// What the page shows beside the arm: a sensor, and bodies in the base, in a frame and on the tip.
constexpr const char* kShown =
    "[sensor]\ntype = wrench_front_end\nft = robot.ft\nx = model.x\ntool = robot.tool\n"
    "max_force = 300\nmax_moment = 30\n"
    "[cell]\ntype = frame\nposition = 1 0 0\nrotation = 0 0 1.5707963267948966\n"
    "[table]\ntype = box\ncentre = 0.5 0 -0.1\nsize = 0.4 1 0.2\nframe = cell.x\n"
    "[carried]\ntype = box\ncentre = 0 0 0.1\nsize = 0.1 0.1 0.1\nframe = model.x\n";

/// Runs a test class; $P is the program that serves.
void run_class(const char* name) {
  write("served.ini", {kServed, kShown, kBusyHost});
  Line command("PYTHONPATH=$R/tests/gateway/page /usr/bin/python3 -B -W ignore -m unittest ");
  assert_succeeds((command << name).c_str());
}

// Proves PAGE-1, PAGE-3, PAGE-5, PAGE-9.

void the_page_is_served_and_takes_commands(void**) {
  run_class("test_http.PageTest");
}

// Proves PAGE-2.

void the_page_comes_with_a_key_and_goes_without_a_port(void**) {
  run_class("test_http.PlaceTest");
}

void an_address_of_the_network_is_refused(void**) {
  const Line pipeline = write("served.ini", {kServed, kShown, kBusyHost});
  assert_int_equal(tactus_run({"serve", pipeline.c_str(), "--http", "0.0.0.0:7380"}), 2);
  assert_true(
      has(errors(), "--http: refused: '0.0.0.0:7380': the page is served at 127.0.0.1 alone"));
  assert_true(has(errors(), "ssh -L"));
}

// Proves PAGE-4, PAGE-8.

void hostile_browsers_do_not_disturb_the_server(void**) {
  run_class("test_hostile_browsers");
}

// Proves PAGE-6, PAGE-8, PAGE-9.

void a_browser_shows_the_arm_and_its_buttons_work(void**) {
  if (shell("command -v chromium") != 0) {
    print_message("there is no chromium; as root: scripts/setup report\n");
    _skip(__FILE__, __LINE__);
  }
  run_class("test_browser");
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(the_page_is_served_and_takes_commands),
      cmocka_unit_test(the_page_comes_with_a_key_and_goes_without_a_port),
      cmocka_unit_test(an_address_of_the_network_is_refused),
      cmocka_unit_test(hostile_browsers_do_not_disturb_the_server),
      cmocka_unit_test(a_browser_shows_the_arm_and_its_buttons_work),
  };
  return run_program_tests(argv[0], tests);
}
