// Tests the shipped pipelines in contact by the plant's true force.
//
// The tip is at rest on a face with the outward normal n. The law behind the admittance has brought
// it to the commanded pose, which differs from the desired one by (h - h_d) / K. With p the depth
// of the desired tip in the face, delta the true depth and k the stiffness of the face, along n
//
//   F = k delta,   F - F_d = K (p - delta)   hence   F = (K p + F_d) / (1 + K / k)
#include <algorithm>
#include <cstdlib>

#include "kernel/math/so3.hpp"
#include "tests/pipeline/pipeline_bench.hpp"

namespace tactus {
namespace {

/// A run that presses on a face while it slides along it.
struct Press {
  const char* pipeline;
  double settled_s, end_s;  // it is in contact and settled between these times
  double rebound_s;         // after touch-down; later it must stay in contact
  Vector3 normal;           // base frame
  double K, p, F_d;         // N/m, m, N
  double most_N;            // at touch-down
  double angle_rad;         // largest error of the orientation
  const char *from = "", *to = "";
  const char* trajectory = "";
};

constexpr double kFace_N_m = 1e5, kFriction = 0.3;  // of the plant, unless a file sets others

/// Measurements of a run.
struct Seen {
  Vector3 force = Vector3::Zero(), sensed = Vector3::Zero();  // means while settled, N
  double most_N = 0.0;                                        // along the normal, whole run
  double touched_s = kInfinity;
  int lost = 0;            // cycles without contact
  double angle_rad = 0.0;  // largest angle between desired and true orientation
  double lead_rad = 0.0;   // largest lead of the commanded over the true joints
};

Seen watch(PipelineBench& bench, const Press& press) {
  Seen seen;
  int settled = 0;
  while (bench.time_s() < press.end_s) {
    bench.cycle();
    const double normal = press.normal.dot(bench.contact()), time_s = bench.time_s();
    if (normal > 0.0) seen.touched_s = std::min(seen.touched_s, time_s);
    if (time_s > seen.touched_s + press.rebound_s && !(normal > 0.0)) ++seen.lost;
    seen.most_N = std::max(seen.most_N, normal);
    const Pose &x_d = bench.output<Pose>("trg.x_d"), &x = bench.output<Pose>("model.x");
    seen.angle_rad = std::max(seen.angle_rad, log_so3(x_d.r * x.r.conjugate()).norm());
    const JointVector lead = bench.output<JointVector>("cpc.q_c") - bench.hal.arm().q();
    seen.lead_rad = std::max(seen.lead_rad, lead.cwiseAbs().maxCoeff());
    if (time_s < press.settled_s) continue;
    seen.force += bench.contact();
    seen.sensed += bench.output<Vector6>("sensor.h").head<3>();
    ++settled;
  }
  seen.force /= settled;
  seen.sensed /= settled;
  return seen;
}

/// Skips the test on another robot than the pipeline's.
void assert_presses(const Press& press) {
  need_one_of({press.pipeline});
  static std::array<PipelineBench, 3> benches;
  static std::size_t used = 0;
  PipelineBench& bench = benches.at(used++);
  bench.start(press.pipeline, press.from, press.to, press.trajectory);
  const Seen seen = watch(bench, press);
  const double F = (press.K * press.p + press.F_d) / (1.0 + press.K / kFace_N_m);
  const double normal = press.normal.dot(seen.force);
  const double along = (seen.force - normal * press.normal).norm();
  print_message("%s: %.2f N, %.2f predicted, %.1f at most; along the face %.2f N; %.2g rad off\n",
                press.pipeline, normal, F, seen.most_N, along, seen.angle_rad);
  ASSERT_NEAR(normal, F, 0.01 * F);
  ASSERT_NEAR((seen.sensed - seen.force).norm(), 0.0, 0.15);
  assert_true(along <= kFriction * normal * (1.0 + 1e-3));
  assert_int_equal(seen.lost, 0);
  assert_true(seen.most_N <= press.most_N);
  assert_true(seen.angle_rad <= press.angle_rad);
  assert_true(seen.lead_rad <= 0.05);
  assert_int_equal(bench.limited(), 0);
}

// Proves PIPE-2.

void chalk_presses_by_the_spring_of_the_admittance(void**) {
  assert_presses(
      {"ur10_trg_ac_cpc", 13.0, 18.0, 0.0, {1.0, 0.0, 0.0}, 750.0, 0.019, 0.0, 20.0, 1e-4});
}

/// While the tip still approaches at v, the force D v acts: 4469 N s/m times 13 mm/s.
void the_tool_slides_along_the_wall_by_torque(void**) {
  assert_presses(
      {"ur10_trg_ac_cpc_pid", 10.0, 15.0, 0.0, {0.0, 1.0, 0.0}, 500.0, 0.03, 0.0, 80.0, 4e-3});
}

// Proves PIPE-2, PIPE-3.

/// Only the springs of its joints hold the arm; at touch-down it rebounds once, by 10 um.
void the_table_is_pressed_with_the_force_asked_for(void**) {
  assert_presses(
      {"fer_trg_ac_cpc_pid", 9.0, 16.0, 0.1, {0.0, 0.0, 1.0}, 50.0, -0.002, 10.0, 20.0, 3e-3});
}

// Proves PIPE-3.

/// Without a spring, from 5 mm before the wall. The base's axes are rotated by half a turn from
/// those of the path.
void a_force_asked_for_is_found_on_the_wall(void**) {
  need_one_of({"ur10_trg_ac_cpc_pid"});
  char path[] = "/tmp/tactus-press-XXXXXX";
  const int descriptor = mkstemp(path);
  assert_true(descriptor >= 0);
  std::FILE* file = fdopen(descriptor, "w");
  std::fputs("time_s,x_m,y_m,z_m,qw,qx,qy,qz,fx_N,fy_N,fz_N,mx_Nm,my_Nm,mz_Nm\n", file);
  constexpr double kRows[][3] = {
      {1.0, 0.764, 0.0}, {3.0, 0.795, 0.0}, {4.0, 0.795, 20.0}, {8.0, 0.795, 20.0}};
  for (const double(&row)[3] : kRows)
    std::fprintf(file, "%g,-0.16354,%g,0.73844,0.707672,-0.706541,0,0,0,%g,0,0,0,0\n", row[0],
                 row[1], row[2]);
  std::fclose(file);
  assert_presses({"ur10_trg_ac_cpc_pid",
                  7.0,
                  8.0,
                  0.0,
                  {0.0, 1.0, 0.0},
                  0.0,
                  0.0,
                  20.0,
                  30.0,
                  3e-3,
                  "5000 5000 500 ",
                  "5000 5000 0 ",
                  path});
  std::remove(path);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(chalk_presses_by_the_spring_of_the_admittance),
      cmocka_unit_test(the_tool_slides_along_the_wall_by_torque),
      cmocka_unit_test(the_table_is_pressed_with_the_force_asked_for),
      cmocka_unit_test(a_force_asked_for_is_found_on_the_wall),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
