// Tests `tactus serve` as a program: its clients speak over its socket, in Python.
#include <sys/stat.h>

#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

void try_server(const char* what) {
  write("served.ini", {kServed, kBusyHost, "[recorder]\nsignals = robot.q pd.tau\n"});
  Line command("cd $R && mkdir -p $S/");
  command << what << " && tests/gateway/server/try_server.py $P $S/served.ini $S/" << what << " "
          << what;
  assert_succeeds(command.c_str());
}

/// A pipeline at a network address with this key file is refused for this reason.
void assert_key_refused(const char* key, const char* reason) {
  assert_int_equal(tactus_run({"serve", in_folder("served.ini").c_str(), "--listen",
                               "tcp:0.0.0.0:0", "--key", key}),
                   2);
  assert_true(has(errors(), reason));
}

// Proves GW-9, RUN-4.

/// The report marks in its figures where the drives were disabled, and lists why.
void a_client_in_python_moves_the_arm_and_is_told_of_it(void**) {
  try_server("session");
  assert_succeeds("$R/scripts/report $S/session out");
  assert_true(has(file_of("session/report.html"), "arming → nominal (rearm); "));
  assert_succeeds(
      "/usr/bin/python3 -c \"import base64, os, re\n"
      "page = open(os.environ['S'] + '/session/report.html').read()\n"
      "found = re.findall('svg.xml;base64,([^\\\"]*)', page)\n"
      "assert any(b'drives disabled' in base64.b64decode(data) for data in found)\"");
}

void clients_that_are_killed_leave_the_arm_at_rest(void**) {
  try_server("killed");
}

void an_interrupt_brakes_the_arm_and_ends_the_server_well(void**) {
  try_server("interrupted");
}

void addresses_of_other_kinds_are_refused(void**) {
  const Line pipeline = write("served.ini", {kServed, kBusyHost});
  constexpr struct {
    const char *address, *reason;
  } kCases[] = {
      {"tcp:0.0.0.0:7370", "programs on other computers would reach it"},
      {"tcp:192.168.1.5:7370", "programs on other computers would reach it"},
      {"tcp:127.0.0.1", "is no IPv4 address and port"},
      {"tcp:127.0.0.1:99999", "is no IPv4 address and port"},
      {"udp:127.0.0.1:7370", "is neither unix:PATH nor tcp:ADDRESS:PORT"},
      {"unix:", "the path of a Unix socket has 1 to"},
      {"unix:/nowhere/arm.sock", "/nowhere/arm.sock: No such file or directory"},
  };
  for (const auto& [address, reason] : kCases) {
    assert_int_equal(tactus_run({"serve", pipeline.c_str(), "--listen", address}), 2);
    assert_true(has(errors(), reason));
  }
}

void a_file_at_the_path_of_the_socket_is_named(void**) {
  const Line pipeline = write("served.ini", {kServed, kBusyHost}),
             file = write("there", {"mine\n"});
  assert_int_equal(
      tactus_run({"serve", pipeline.c_str(), "--listen", (Line("unix:") << file).c_str()}), 2);
  assert_true(has(errors(), "there: a file is there that is no socket; remove it"));
  assert_true(has(file_of("there"), "mine"));
}

// Proves GW-15.

/// 0.2 s and more at 4 ms, in a log of ten rows; port 0 is one that is free.
void the_log_of_a_session_is_written_where_out_says(void**) {
  write("served.ini", {kServed, kBusyHost, "[recorder]\ntracking = jrg.q_d robot.q\n"});
  assert_succeeds(
      "$P serve $S/served.ini --virtual-time --listen tcp:127.0.0.1:0 --out $S/session --rows "
      "10 >$S/said & pid=$!; n=0; until grep -q serves $S/said; do n=$((n+1)); test $n -lt "
      "600 || exit 80; sleep 0.1; done; sleep 0.5; kill -INT $pid; wait $pid || exit 81; "
      "grep -q 'serves tcp:127.0.0.1:[1-9]' $S/said || exit 82; "
      "test $(wc -l <$S/session/log.csv) = 11 || exit 83; "
      "grep -q 'has the first 10 rows; [1-9]' $S/said || exit 84; "
      "test -s $S/session/summary.json && test -s $S/session/pipeline.ini && "
      "test ! -e $S/session/incomplete.txt");
}

// Proves GW-22.

/// Serves a pipeline without a client until an interrupt ends it, a second later; returns the exit
/// code.
int interrupt(const char* pipeline) {
  Line command("rm -rf $S/session; $P serve ");
  command << pipeline
          << " --virtual-time --listen tcp:127.0.0.1:0 --out $S/session >$S/said & pid=$!; n=0; "
             "until grep -q serves $S/said; do n=$((n+1)); test $n -lt 600 || exit 80; sleep 0.1; "
             "done; sleep 1; kill -INT $pid; wait $pid";
  return shell(command.c_str());
}

/// Of a wrench sensor that reads 30 N where its block allows 10, or does so at some time.
void a_session_that_a_fault_has_ended_does_not_succeed(void**) {
  constexpr const char* kSensor =
      "[sensor]\ntype = wrench_front_end\nft = robot.ft\nx = model.x\n"
      "tool = robot.tool\nmax_force = 10\nmax_moment = 30\n";
  constexpr const char* kResult =
      "\"result\": {\"code\": 73, \"name\": \"kSensorRange\", "
      "\"why\": \"sensor value out of range (73): block [sensor]\"}";
  const auto serve_with = [](const char* plant) {
    return interrupt(
        write("served.ini", {kServed, kBusyHost, kSensor, "[plant]\n", plant}).c_str());
  };
  assert_int_equal(serve_with(""), 0);
  assert_true(has(file_of("session/summary.json"), "{\"code\": 0, \"name\": \"succeeded\"}"));
  assert_int_equal(serve_with("ft_bias_force_N = 0 0 30\n"), 2);
  assert_true(has(errors(), "served.ini: refused: sensor value out of range (73)"));
  assert_true(has(file_of("session/summary.json"), kResult));
  assert_int_equal(serve_with("ft_noise_force_N = 3.5\n"), 1);
  assert_true(has(errors(), "served.ini: stopped: sensor value out of range (73)"));
  assert_true(has(file_of("session/summary.json"), kResult));
}

/// The drives of this plant take longer to arm than the session lasts.
void a_session_that_is_ended_before_the_arm_is_armed_does_not_succeed(void**) {
  const Line file = write("served.ini", {kServed, kBusyHost, "arming_ms = 100000\n",
                                         "[plant]\narming_cycles = 100000\n"});
  assert_int_equal(interrupt(file.c_str()), 2);
  assert_true(has(errors(),
                  "served.ini: refused: halted on request (82): it ended before the arm was "
                  "armed\n"));
  assert_true(has(file_of("session/summary.json"),
                  "\"name\": \"kHalted\", \"why\": \"halted on request (82): it ended before"));
}

// Proves GW-11.

void a_client_in_python_comes_through_the_tunnel_with_the_key_only(void**) {
  try_server("keyed");
}

void a_network_address_needs_a_key_file_that_is_the_users_alone(void**) {
  write("served.ini", {kServed, kBusyHost});
  assert_key_refused(in_folder("none.key").c_str(), "No such file");
  const Line key = write("arm.key", {"00ff00ff00ff00ff00ff00ff00ff00ff"});
  assert_int_equal(chmod(key.c_str(), 0644), 0);
  assert_key_refused(key.c_str(), "chmod 600");
  assert_int_equal(chmod(key.c_str(), 0600), 0);
  assert_key_refused(key.c_str(), "64 hexadecimal digits");
  assert_true(errors().find("00ff00") == std::string_view::npos);
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_client_in_python_moves_the_arm_and_is_told_of_it),
      cmocka_unit_test(clients_that_are_killed_leave_the_arm_at_rest),
      cmocka_unit_test(an_interrupt_brakes_the_arm_and_ends_the_server_well),
      cmocka_unit_test(addresses_of_other_kinds_are_refused),
      cmocka_unit_test(a_file_at_the_path_of_the_socket_is_named),
      cmocka_unit_test(the_log_of_a_session_is_written_where_out_says),
      cmocka_unit_test(a_session_that_a_fault_has_ended_does_not_succeed),
      cmocka_unit_test(a_session_that_is_ended_before_the_arm_is_armed_does_not_succeed),
      cmocka_unit_test(a_client_in_python_comes_through_the_tunnel_with_the_key_only),
      cmocka_unit_test(a_network_address_needs_a_key_file_that_is_the_users_alone),
  };
  return run_program_tests(argv[0], tests);
}
