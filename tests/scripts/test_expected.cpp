// Tests what the report computes of a run: what it expects (scripts/reporting/expected.py), and the
// curves that it draws.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

constexpr const char* kLag =
    "[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n"
    "[plant]\nfriction = 0\nrotor_inertia = 0\n"
    "[gateway]\ntrajectory = trajectories/lag.csv\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n"
    "kp = 500 400 400 300 20 20 10\nkd = 50 40 40 5 2 2 1\n"
    "[recorder]\ntracking = jrg.q_d robot.q\n";

// Proves RUN-4.

/// Joint 1 moves at 0.3 rad/s with kd / kp = 0.1 s; then the file claims half of its kp.
void a_lag_is_expected_as_the_gains_say(void**) {
  assert_succeeds("mkdir -p $S/t/pipelines/trajectories && cp $P $S/t/tactus");
  write("t/pipelines/lag.ini", {kLag});
  write("t/pipelines/trajectories/lag.csv",
        {kHeader, kReady, "1.02,0.3,-0.785398,0,-2.356194,0,1.570796,0.785398\n"});
  assert_succeeds("cd $S/t && $R/scripts/run_all --no-pictures -- ./tactus lag");
  assert_true(has(output(), "  max joint error  30.0 mrad  30 mrad ± 10 mrad  as expected\n"));
  assert_int_equal(shell("cd $S/t && sed -i 's/kp = 500/kp = 250/' out/lag/pipeline.ini && "
                         "$R/scripts/report --no-pictures out lag"),
                   1);
  assert_true(has(output(), "  max joint error  30.0 mrad  60 mrad ± 10 mrad  not as expected\n"));
  assert_true(has(output(), "\n0 of 1 runs as expected\n"));
}

/// What the file states counts in place of what the gains say; without a pair nothing is compared.
void what_the_file_states_is_compared_and_nothing_is_no_success(void**) {
  assert_succeeds(
      "cd $S/t && (cat pipelines/lag.ini; printf '[expect]\ntracking_rad = 0.04\n') "
      ">pipelines/own.ini && grep -v tracking pipelines/lag.ini >pipelines/bare.ini && "
      "$R/scripts/run_all --no-pictures -- ./tactus own bare");
  assert_true(has(output(), "  max joint error  30.0 mrad  at most 40 mrad  as expected\n"));
  assert_true(
      has(output(), "  succeeded, not compared\n\n1 of 2 runs as expected, 1 not compared\n"));
}

/// A PID that damps the measured velocity lags as that law does; one that damps the error does not.
void a_pid_lags_only_if_it_damps_the_measured_velocity(void**) {
  assert_succeeds(
      "cd $S/t && sed 's/pd_gravity/pid\\nki = 0\\ndq_d = jrg.dq_d\\nderivative = "
      "measurement/' "
      "pipelines/lag.ini >pipelines/slow.ini && sed 's/pd_gravity/pid\\nki = 0/' "
      "pipelines/lag.ini >pipelines/fast.ini && $R/scripts/run_all --no-pictures -- "
      "./tactus slow fast");
  assert_true(has(output(), "  max joint error  30.0 mrad  30 mrad ± 10 mrad  as expected\n"));
  assert_true(has(output(), " mrad  0 ± 10 mrad        as expected\n"));
}

/// A ball of 1 cm: 2 cm above the top of a box, and 3 cm inside it, seen from a turned frame too.
void a_penetration_is_measured_from_the_face_to_the_foremost_point(void**) {
  assert_succeeds(
      "cd scripts && /usr/bin/python3 -B -c \"import numpy as np\n"
      "from reporting import arm, expected\n"
      "box = {'centre': [1, 2, 3], 'size': [4, 6, 8], 'rotation': [1, 0, 0, 0]}\n"
      "away, normals = expected.distances(box, np.array([[1, 2, 7.03], [1, 2, 6.98]]), .01)\n"
      "assert np.allclose(normals[2], [0, 0, 1]) and np.allclose(away[:, 2], [.02, -.03])\n"
      "assert np.allclose(away[0, :2], [-2.01, -3.01]) and np.allclose(away[0, 5], -8.04)\n"
      "half = np.sqrt(.5); box['rotation'] = [half, half, 0, 0]\n"
      "away, normals = expected.distances(box, np.array([[1, 2 - 4.03, 3.]]), .01)\n"
      "assert np.allclose(normals[2], [0, -1, 0]) and np.allclose(away[0, 2], .02)\"");
}

// Proves RUN-7.

/// A turn about z at a constant rate, past half a turn, with quaternions of arbitrary sign; and a
/// spike of one row in a million.
void a_figure_keeps_peaks_and_lets_no_orientation_jump(void**) {
  assert_succeeds(
      "cd scripts && /usr/bin/python3 -B -c \"import numpy as np\n"
      "from reporting import panels, plots\n"
      "t = np.linspace(0, 6, 5000); zero = np.zeros_like(t)\n"
      "q = np.stack([np.cos(t / 2), zero, zero, np.sin(t / 2)], axis=1)\n"
      "q *= np.where(np.arange(5000) % 7 < 3, 1, -1)[:, None]\n"
      "turn = panels.rotation_vector(panels.continuous(q))\n"
      "assert np.allclose(turn, np.stack([zero, zero, t], axis=1), atol=1e-9)\n"
      "back = panels.rotation_vector(panels.shortest(q))\n"
      "assert np.allclose(back[:, 2], np.where(t > np.pi, t - 2 * np.pi, t), atol=1e-9)\n"
      "assert np.allclose(panels.product(q, panels.inverse(q)), [1, 0, 0, 0])\n"
      "i, j, k = np.eye(4)[1:, None]\n"
      "assert np.array_equal(panels.product(i, j), k)\n"
      "x = np.arange(10**6) * 1e-3; y = np.sin(x); y[654321] = 7; y[3] = -8\n"
      "drawn_x, drawn_y = plots.thin_out(x, y)\n"
      "assert len(drawn_x) <= 1202 and np.all(np.diff(drawn_x) > 0)\n"
      "assert drawn_y.max() == 7 and drawn_y.min() == -8\n"
      "assert drawn_x[drawn_y.argmax()] == x[654321] and drawn_x[-1] == x[-1]\"");
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_lag_is_expected_as_the_gains_say),
      cmocka_unit_test(what_the_file_states_is_compared_and_nothing_is_no_success),
      cmocka_unit_test(a_pid_lags_only_if_it_damps_the_measured_velocity),
      cmocka_unit_test(a_penetration_is_measured_from_the_face_to_the_foremost_point),
      cmocka_unit_test(a_figure_keeps_peaks_and_lets_no_orientation_jump),
  };
  return run_program_tests(argv[0], tests);
}
