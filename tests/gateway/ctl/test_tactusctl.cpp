// Tests the verbs of tactusctl as a user starts them, against a server of a simulated UR10.
#include "tests/gateway/ctl/ctl_bench.hpp"

namespace tactus {
namespace {

constexpr const char* kJoints = "ur10_jrg_pid";
constexpr const char* kTip = "ur10_trg_cpc";

// The square of pipelines/trajectories, eight times as fast.
constexpr const char* kSquare =
    "awk -F, -v OFS=, '/^[0-9]/{$1/=8}{print}' $R/pipelines/trajectories/ur10_square_at_rest.csv "
    ">$S/square.csv; ";
// Proves CTL-1.

void a_square_is_sent_and_succeeds(void**) {
  Text<2047> script(kSquare);
  script << "$T send $S/square.csv --json >$S/all";
  assert_int_equal(served(kTip, script.c_str()), 0);
  assert_succeeds("tail -1 $S/all | grep '^{\"result\":{.*\"outcome\":\"SUCCEEDED\"'");
  // Its last corner, (0.6, 0.16, 0.74) m in base_link, which is turned by pi about z, and which the
  // pipeline file names.
  assert_succeeds(
      "$R/tests/gateway/ctl/last_values.py $S/all feedback task_actual.pose -0.6 -0.16 0.74");
}

/// 40 000 waypoints, more than the 32 768 of the window; also through a pipe, whose end is not
/// known.
void a_file_longer_than_its_window_is_sent_by_credit(void**) {
  assert_int_equal(
      served(kJoints,
             "awk 'BEGIN{print \"time_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\"; "
             "for(i=1;i<=40000;++i){s=i/40000;printf \"%.17g,%.17g,-1.67,1.87,2.94,-1.57,0\\n\","
             "i*1e-4,0.6*s*s*(3-2*s)}}' >$S/long.csv; $T send $S/long.csv || exit 81; "
             "$T point 0 -1.67 1.87 2.94 -1.57 0 --wait || exit 82; cat $S/long.csv | $T send -"),
      0);
  assert_true(has(output(), "40000 waypoints"));
  assert_true(has(output(), "\nsucceeded"));
}

// Proves CTL-2.

void ctrl_c_cancels_on_the_path(void**) {
  const int code = served(kJoints,
                          "there 6; "
                          "$T send $S/there.csv --json >$S/all & pid=$!; "
                          "until_says $S/all feedback && kill -INT $pid; wait $pid; code=$?; "
                          "phase >$S/phase; $T watch --duration 0.1 >$S/rest; exit $code");
  assert_int_equal(code, 1);
  assert_succeeds("tail -1 $S/all | grep '\"result\":{.*\"outcome\":\"CANCELED\"'");
  assert_succeeds("grep -qx holding $S/phase");
  // On its path: between the ends, and no joint but the first has moved.
  assert_succeeds(
      "tail -1 $S/rest | awk '{exit !($6 >= 0 && $6 < 0.6 && "
      "($7+1.67)^2 < 1e-4 && ($8-1.87)^2 < 1e-4)}'");
}

// Proves CTL-3.

void a_second_client_is_refused_with_the_owners_name(void**) {
  assert_int_equal(
      served(kJoints,
             "there 20; "
             "$T send $S/there.csv --name first --json >$S/all & pid=$!; "
             "until_says $S/all STARTED; "
             "$T send $S/there.csv --name second; test $? = 2 || exit 81; "
             "$T resume; test $? = 2 || exit 82; "
             "$T watch --json --duration 0.1 | grep -q '\"owner\":\"first\"' || exit 83; "
             "$T cancel --priority 200; kill -INT $pid; wait $pid; test $? = 1"),
      0);
  assert_true(has(errors(), "first owns the motion"));
}

void everybody_may_stop_and_rearm_takes_over(void**) {
  assert_int_equal(
      served(kJoints,
             "there 20; "
             "$T send $S/there.csv --json >$S/all & pid=$!; until_says $S/all STARTED; "
             "$T stop || exit 81; wait $pid; test $? = 1 || exit 82; "
             "$T point 0 0 0 0 0 0; test $? = 2 || exit 83; "
             "n=0; until $T rearm; do n=$((n+1)); test $n -lt 50 || exit 84; done; "
             "$T watch --duration 0.1 | grep -q nominal"),
      0);
  assert_true(has(output(), "tactusctl rearm takes it over"));
}

// Proves CTL-4.

void a_server_that_goes_away_is_told_with_exit_code_3(void**) {
  assert_int_equal(
      served(kJoints,
             "there 20; "
             "$T send $S/there.csv --json >$S/all & pid=$!; until_says $S/all STARTED; "
             "kill -9 $(cat $S/pid); wait $pid; test $? = 3"),
      0);
  assert_true(has(errors(), "the server has closed the connection"));
}

// Proves CTL-5.

void a_point_is_reached_and_targets_are_streamed(void**) {
  assert_int_equal(
      served(kJoints,
             "$T point 0.2 -1.67 1.87 2.94 -1.57 0 --wait || exit 81; "
             "test $(phase) = holding || exit 82; "
             "awk 'BEGIN{print \"q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\"; "
             "for(i=1;i<=40;++i)printf \"%g,-1.67,1.87,2.94,-1.57,0\\n\",0.2+i*1e-3}' | "
             "$T stream --period-ms 5 || exit 83; n=0; "
             "until $T watch --duration 0.1 --json >$S/states; "
             "$R/tests/gateway/ctl/last_values.py $S/states state q 0.24; do "
             "n=$((n+1)); test $n -lt 50 || exit 84; done"),
      0);
  assert_true(has(output(), "40 targets: "));
}

// Proves CTL-9.

void keys_move_a_joint_and_it_stops_without_them(void**) {
  assert_int_equal(
      served(kJoints,
             "(printf 1; for i in 1 2 3 4 5 6; do printf +; sleep 0.1; done; sleep 1; printf q) | "
             "$T jog --speed 20% --json >$S/all; test $? = 0 || exit 81; "
             "test $(phase) = holding || exit 82; "
             "$T watch --duration 0.1 | tail -1 | awk '{exit !($6 > 0.02 && $6 < 1)}'"),
      0);
}

void a_server_with_a_key_is_spoken_to_with_it(void**) {
  assert_int_equal(
      served(kJoints,
             "for k in key other; do openssl rand -hex 32 >$S/$k; chmod 600 $S/$k; done; "
             "end; : >$S/server.log; $P serve $S/served.ini --listen tcp:127.0.0.1:17371 --key "
             "$S/key >$S/server.log "
             "2>&1 & echo $! >$S/pid; until_says $S/server.log serves || exit 80; "
             "export TACTUS_SOCKET=tcp:127.0.0.1:17371; $T info --key $S/key || exit 81; "
             "$T info --key $S/other; test $? = 3 || exit 82; $T info --key $S/none; test $? = 3"),
      0);
  assert_true(has(errors(), "the server does not have this key"));
}

// Proves CTL-6.

void a_detached_trajectory_is_paused_slowed_resumed_and_canceled(void**) {
  assert_int_equal(served(kJoints,
                          "there 30; $T send --detach $S/there.csv || exit 81; "
                          "$T pause || exit 82; test $(phase) = paused || exit 83; "
                          "$T override 50% || exit 84; $T watch --json --duration 0.1 | "
                          "grep -q '\"override\":0.5' || exit 85; "
                          "$T resume || exit 86; test $(phase) = following || exit 87; "
                          "$T cancel || exit 88; $T cancel; test $? = 2"),
                   0);
}

// Proves CTL-15.

void what_one_terminal_sends_is_slowed_down_and_canceled_from_another(void**) {
  assert_int_equal(served(kJoints,
                          "there 30; $T send $S/there.csv --json >$S/all & pid=$!; "
                          "until_says $S/all feedback || exit 80; "
                          "$T override 50% || exit 81; $T pause || exit 82; "
                          "test $(phase) = paused || exit 83; "
                          "$T watch --json --duration 0.1 >$S/states; "
                          "grep -q '\"rung\":\"RUNG_NOMINAL\",.*\"phase\":\"PHASE_PAUSED\"' "
                          "$S/states || exit 84; "
                          "$T resume; test $? = 2 || exit 85; "
                          "$T override 60%; test $? = 2 || exit 86; "
                          "$T override 40% || exit 87; $T cancel || exit 88; "
                          "wait $pid; test $? = 1 || exit 89; grep -q 'has paused' $S/all"),
                   0);
}

// Proves CTL-16.

void parameters_are_listed_checked_and_changed_while_the_arm_moves(void**) {
  assert_int_equal(
      served(
          kJoints,
          "there 20; "
          "$T params >$S/list || exit 81; grep -q '^\\* pid.kp .*1000 10000 .*N m/rad' $S/list || "
          "exit 82; grep -q '^  guard.max_velocity' $S/list || exit 83; "
          "$T params pid.kp=-1 --check; test $? = 2 || exit 84; "
          "$T params guard.max_torque=1; test $? = 2 || exit 85; "
          "$T params pidkp; test $? = 2 || exit 86; "
          "$T params pid.kp='900 9000 4500 900 450 27' pid.ki=0 --check || exit 87; "
          "grep -q '^  *guard' $S/list; $T params | grep -q 'file:' && exit 88; "
          "$T send --detach $S/there.csv || exit 89; "
          "$T params pid.kp='900 9000 4500 900 450 27' pid.ki=0 || exit 90; "
          "test $(phase) = following || exit 91; "
          "$T params --json >$S/all || exit 92; "
          "grep -q '\"key\":\"kp\",\"value\":\"900 9000 4500 900 450 27\"' $S/all || exit 93; "
          "$T params | grep -q 'pid.ki .*file: 5 10 10 4 3 2' || exit 94; $T cancel"),
      0);
  assert_true(has(errors(), "[pid] kp: joint 1: -1 N m/rad is out of range; it must be >= 0"));
  assert_true(has(errors(), "cannot change while the pipeline runs"));
}

// Proves CTL-23.

/// The tare of the start is under way at first (44); a stopped arm takes none.
void a_new_zero_is_taken_and_told(void**) {
  assert_int_equal(
      served("ur10_trg_ac_cpc",
             "n=0; until $T tare --json >$S/all; do n=$((n+1)); sleep 0.1; "
             "test $n -lt 100 || exit 81; done; "
             "grep -qE '^[{]\"result\":{.*\"zero\":\\[(2[.]9|3[.]0)' $S/all || exit 82; "
             "$T tare || exit 83; $T stop || exit 84; $T tare; test $? = 2"),
      0);
  assert_true(has(output(), "executed: [sensor] the zero moved by "));
  assert_true(has(output(), "Rearm takes a new zero (82)\n"));
}

void without_a_sensor_there_is_no_zero(void**) {
  assert_int_equal(served(kJoints, "$T tare; test $? = 2"), 0);
  assert_true(has(errors(), "the pipeline has no wrench_front_end"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_square_is_sent_and_succeeds),
      cmocka_unit_test(a_file_longer_than_its_window_is_sent_by_credit),
      cmocka_unit_test(ctrl_c_cancels_on_the_path),
      cmocka_unit_test(a_second_client_is_refused_with_the_owners_name),
      cmocka_unit_test(everybody_may_stop_and_rearm_takes_over),
      cmocka_unit_test(a_server_that_goes_away_is_told_with_exit_code_3),
      cmocka_unit_test(a_point_is_reached_and_targets_are_streamed),
      cmocka_unit_test(keys_move_a_joint_and_it_stops_without_them),
      cmocka_unit_test(a_server_with_a_key_is_spoken_to_with_it),
      cmocka_unit_test(a_detached_trajectory_is_paused_slowed_resumed_and_canceled),
      cmocka_unit_test(what_one_terminal_sends_is_slowed_down_and_canceled_from_another),
      cmocka_unit_test(a_new_zero_is_taken_and_told),
      cmocka_unit_test(without_a_sensor_there_is_no_zero),
      cmocka_unit_test(parameters_are_listed_checked_and_changed_while_the_arm_moves),
  };
  return run_program_tests(argv[0], tests);
}
