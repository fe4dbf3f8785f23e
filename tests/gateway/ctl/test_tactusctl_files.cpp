// Tests tactusctl where the arm hardly moves: errors, files that it refuses or writes, and what is
// installed.
#include "tests/gateway/ctl/ctl_bench.hpp"

namespace tactus {
namespace {

constexpr const char* kJoints = "ur10_jrg_pid";

// Proves CTL-4.

void without_a_server_the_error_says_what_to_do(void**) {
  const auto run = [](const char* words) {
    return shell((Line("d=$(dirname $P); env -u TACTUS_SOCKET XDG_RUNTIME_DIR=$S "
                       "$R/build/tactusctl${d##*/ur10_sim} ")
                  << words)
                     .c_str());
  };
  assert_int_equal(run("watch"), 3);
  assert_true(has(errors(), "/tactus.sock: No such file"));
  assert_int_equal(run("watch --connect unix:$S/nothing --json"), 3);
  assert_true(has(errors(), "is 'tactus serve' running"));
  assert_true(has(output(), "{\"error\":{\"text\":\"unix:"));
  assert_int_equal(run("watch --connect here"), 3);
  assert_true(has(errors(), "write unix:PATH or tcp:HOST:PORT"));
  assert_int_equal(run("watch --connect tcp:127.0.0.1:1"), 3);
  assert_int_equal(run("fly"), 2);
  assert_int_equal(run("override 150%"), 2);
  assert_int_equal(run("--version"), 0);
}

// Proves CTL-5.

void what_is_malformed_is_refused_before_it_is_sent(void**) {
  assert_int_equal(
      served(kJoints,
             "no() { printf \"$1\" >$S/bad.csv; $T send $S/bad.csv; test $? = 2 || exit 81; }; "
             "no 'q1_rad\\n0\\n'; no 'time_s,q1_rad\\n0,0\\n'; no 'time_s,height\\n'; no ''; "
             "no 'time_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\\n1,0,0,nan,0,0,0\\n'; "
             "no 'time_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\\n1,0,0\\n'; "
             "$T send $S/none.csv; test $? = 2 || exit 82; $T point 1 2; test $? = 2 || exit 83; "
             "printf 'q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\\n0,0,0,0,0,99\\n' | $T stream; "
             "test $? = 2"),
      0);
  assert_true(has(errors(), "bad.csv:1: time_s: the column is missing"));
  assert_true(has(errors(), "bad.csv:1:2: height: unknown column"));
  assert_true(has(errors(), "bad.csv:2:4: q3_rad: 'nan' is not a finite number"));
  assert_true(has(errors(), "fewer cells than columns"));
  assert_true(has(errors(), "a point of ur10 has 6"));
}

// Proves CTL-8.

/// Paths retimed for the limits of the server are admitted as they are, not slowed down.
void the_server_admits_what_is_retimed_without_slowing_it_down(void**) {
  assert_int_equal(
      served(kJoints,
             "cut -d, -f1-7 $R/pipelines/trajectories/ur10_five_waypoints.csv >$S/path.csv; "
             "for how in '' --no-jerk '--tolerance 0.01' '--radius 0.2 --no-jerk' "
             "'--tolerance 0.1 --velocity 50%'; do "
             "$T retime $S/path.csv --connect $TACTUS_SOCKET $how --out $S/timed.csv || exit 81; "
             "$T check $S/timed.csv --exact || exit 82; done; "
             "$T retime $S/path.csv --out $S/timed.csv || exit 83; "
             "$T send $S/timed.csv || exit 84; "
             "$T retime $S/path.csv --acceleration 100% --out $S/timed.csv; $T check $S/timed.csv "
             "--exact; test $? = 2"),
      0);
}

/// Paths of the tip likewise; three seconds to come to the first waypoint are added.
void the_server_admits_what_is_retimed_of_the_tip_without_slowing_it_down(void**) {
  assert_int_equal(
      served("ur10_trg_cpc",
             "late() { awk -F, -v OFS=, '/^[0-9]/ { $1 = sprintf(\"%.17g\", $1 + 3) } 1' "
             "$S/timed.csv >$S/late.csv; }; "
             "square=$R/pipelines/trajectories/ur10_square.csv; for how in '' --no-jerk "
             "'--tolerance-m 0.01 --tolerance 0.05' '--tolerance-m 0.05 --tolerance 0.2 --no-jerk' "
             "'--tolerance-m 0.1 --tolerance 1 --velocity 50%'; do "
             "$T retime $square --robot ur10 $how --out $S/timed.csv || exit 81; late; "
             "$T check $S/late.csv --exact || exit 82; done; "
             "$T retime $square --connect $TACTUS_SOCKET --velocity 50% --acceleration 30% --out "
             "$S/timed.csv || exit 83; late; "
             "$T send $S/late.csv || exit 84; $T retime $square --robot ur10 "
             "--acceleration 100% --out $S/timed.csv; late; $T check $S/late.csv --exact; "
             "test $? = 2"),
      0);
}

// Proves CTL-19.

void a_path_of_the_tip_that_cannot_be_passed_is_refused_with_what_to_do(void**) {
  assert_int_equal(
      served(
          kJoints,
          "no() { printf 'x_m,y_m,z_m,qw,qx,qy,qz\\n0,0,0,1,0,0,0\\n'$1'\\n' >$S/bad.csv; shift; "
          "$T retime $S/bad.csv --out $S/o.csv \"$@\"; test $? = 2 || exit 81; }; "
          "no 1,0,0,1,0,0,0.1 --robot ur10; no 1,0,2.5,1,0,0,0 --robot ur10; "
          "no 1,0,0,1,0,0,0 --robot ur10 --radius 0.1; no 1,0,0,1,0,0,0 --connect "
          "$TACTUS_SOCKET; no 0,0,0,-1,0,0,0 --robot ur10; $T retime --tolerance-m 0.01 --robot "
          "ur10 $R/pipelines/trajectories/ur10_five_waypoints.csv; test $? = 2"),
      0);
  assert_true(has(errors(), "bad.csv:3: the quaternion has the length 1.00499; normalise it"));
  assert_true(has(errors(), "bad.csv:3: the tip is 2.5 m from the base along an axis"));
  assert_true(has(errors(), "has no --radius; give --tolerance-m and --tolerance"));
  assert_true(has(errors(), "the pipeline that is served takes none; give --robot"));
  assert_true(has(errors(), "no way to go"));
  assert_true(has(errors(), "a path of joints has no --tolerance-m; give --tolerance in rad"));
}

// Proves CTL-4.

void an_address_that_is_given_counts_and_not_the_usual_one(void**) {
  assert_int_equal(
      served(kJoints,
             "$T info || exit 81; $T info --connect unix:$S/none; "
             "test $? = 3 || exit 82; $T point --connect=unix:$S/none "
             "0.1 -1.67 1.87 2.94 -1.57 0; test $? = 3 || exit 83; "
             "here=$TACTUS_SOCKET; TACTUS_SOCKET=unix:$S/none $T info --connect $here"),
      0);
}

// Proves CTL-7.

void states_are_recorded_as_a_file_that_can_be_read(void**) {
  assert_int_equal(served(kJoints,
                          "$T point 0.1 -1.67 1.87 2.94 -1.57 0 & "
                          "$T record $S/r.csv --trajectory --duration 1 || exit 81; "
                          "$T retime $S/r.csv --robot ur10 --out $S/again.csv || exit 82; "
                          "$T record - --duration 0.1 >$S/full.csv && head -1 $S/full.csv"),
                   0);
  assert_true(has(output(), "time_s,q1_rad,q2_rad"));
  assert_succeeds("test $(wc -l <$S/r.csv) -gt 20");
}

// Proves CTL-24, PYT-16.

void a_recorded_server_is_judged_and_gives_a_trajectory(void**) {
  assert_int_equal(served(kJoints,
                          "export PYTHONPATH=$R/build/python; "
                          "{ sleep 0.3; $T point 0.1 -1.67 1.87 2.94 -1.57 0; } & "
                          "$T record $S/r.mcap --duration 2 || exit 81; wait $!; "
                          "$T record $S/none.mcap --trajectory; test $? = 2 || exit 82; "
                          "test ! -e $S/none.mcap || exit 83; "
                          "$R/tests/program/judge_recording.py $S/r.mcap || exit 84; "
                          "/usr/bin/python3 -m tactus.recording $S/r.mcap >$S/r.csv || exit 85; "
                          "$P check $R/pipelines/ur10_jrg_pid.ini --trajectory $S/r.csv"),
                   0);
  assert_has_all(output(), {" joined 0 ", " lease 0 ", "r.csv: accepted, "});
  assert_true(has(errors(), "--trajectory writes CSV; leave it out"));
  assert_succeeds("test $(wc -l <$S/r.csv) -gt 20 && head -1 $S/r.csv | grep -q ,state.dq_d_6$");
}

// Proves CTL-14.

void an_installed_program_has_a_man_page_and_a_completion(void**) {
  assert_succeeds(
      "cd $R && make -s BOARD=ur10_sim install-tactusctl "
      "DESTDIR=$S PREFIX=/o && "
      "$S/o/bin/tactusctl --version && "
      "for word in send retime rearm 'Exit codes' TACTUS_SOCKET; do "
      "grep -q \"$word\" $S/o/share/man/man1/tactusctl.1 || exit 81; done; "
      "bash -c '. $S/o/share/bash-completion/completions/tactusctl; "
      "COMP_WORDS=(tactusctl send --det); COMP_CWORD=2; _tactusctl; "
      "test \"${COMPREPLY[*]}\" = --detach'");
  assert_true(has(output(), "tactusctl 0.1"));
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(without_a_server_the_error_says_what_to_do),
      cmocka_unit_test(what_is_malformed_is_refused_before_it_is_sent),
      cmocka_unit_test(the_server_admits_what_is_retimed_without_slowing_it_down),
      cmocka_unit_test(the_server_admits_what_is_retimed_of_the_tip_without_slowing_it_down),
      cmocka_unit_test(a_path_of_the_tip_that_cannot_be_passed_is_refused_with_what_to_do),
      cmocka_unit_test(an_address_that_is_given_counts_and_not_the_usual_one),
      cmocka_unit_test(states_are_recorded_as_a_file_that_can_be_read),
      cmocka_unit_test(a_recorded_server_is_judged_and_gives_a_trajectory),
      cmocka_unit_test(an_installed_program_has_a_man_page_and_a_completion),
  };
  return run_program_tests(argv[0], tests);
}
