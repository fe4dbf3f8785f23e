// Tests the errors of the emulated controller's sensors against the figures that they are taken
// from.
#include "sim_plant/ur/wire/rtde_fields.hpp"
#include "tests/ur/programs/ur_program_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

constexpr double kStep = 6.283185307179586 / 524288.0;  // 19 bits per turn

Settings with_errors(unsigned seed, bool e_series = false) {
  Settings settings = ProgramBench::settings();
  settings.sensor_errors.on = true;
  settings.sensor_errors.seed = seed;
  if (e_series) settings.version = {5, 11, 1, 108318};
  return settings;
}

/// Mean and standard deviation of the force along an axis over some cycles at rest.
struct Reading {
  Vector6 mean = Vector6::Zero(), deviation = Vector6::Zero();
};
Reading read(Controller& controller, int cycles) {
  Vector6 sum = Vector6::Zero(), squares = Vector6::Zero();
  for (int k = 0; k < cycles; ++k) {
    controller.tick();
    const Vector6 h = controller.image().actual_tcp_force;
    sum += h;
    squares += h.cwiseProduct(h);
  }
  Reading reading;
  reading.mean = sum / cycles;
  reading.deviation = (squares / cycles - reading.mean.cwiseProduct(reading.mean)).cwiseSqrt();
  return reading;
}

// Proves URE-62.

void an_arm_at_rest_shows_the_same_position_in_every_cycle(void**) {
  static ProgramBench bench;
  bench.upload("movej([0.1,-1.1,1.1,-0.2,1.4,0.0])\n");
  bench.run_s(3.0);
  bench.run(20);
  const Joints shown = bench.image().actual_q;
  const Vector6 pose = bench.image().actual_tcp_pose;
  for (int i = 0; i < 6; ++i) {
    const double steps = shown[i] / kStep;
    ASSERT_NEAR(steps, std::round(steps), 1e-6);
    ASSERT_NEAR(shown[i], bench.machine().body.q()[i], 0.5001 * kStep);
  }
  for (int k = 0; k < 100; ++k) {
    bench.tick();
    assert_true(bench.image().actual_q == shown && bench.image().actual_tcp_pose == pose);
  }
}

void without_errors_the_force_of_nothing_is_nothing(void**) {
  static ProgramBench bench;
  const Reading reading = read(bench.controller, 50);
  assert_true(reading.mean.norm() < 1e-6 && reading.deviation.norm() < 1e-6);
}

/// 10 N are three standard deviations of the error of a CB3; 20 controllers.
void the_estimate_of_a_cb3_is_as_uncertain_as_its_maker_says(void**) {
  double squares = 0.0, noise = 0.0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    Controller controller(with_errors(seed));
    ASSERT_OK(controller.start());
    const Reading reading = read(controller, 250);
    squares += reading.mean.head<3>().squaredNorm() / 3.0;
    noise += reading.deviation.head<3>().squaredNorm() / 3.0;
  }
  const double rms = std::sqrt(squares / 20.0), noise_rms = std::sqrt(noise / 20.0);
  print_message("%.2f N, noise %.2f N\n", rms, noise_rms);
  assert_true(rms > 1.0 && rms < 10.0);
  assert_true(noise_rms > 0.2 && noise_rms < 3.0);
}

void friction_that_is_not_known_depends_on_the_way_to_a_place(void**) {
  static ProgramBench bench{with_errors(3)};
  constexpr const char* kWays[] = {"movej([0.2,-1.1,1.3,-0.1,1.57,0.1])\n",
                                   "movej([-0.2,-1.3,1.1,-0.1,1.57,-0.1])\n"};
  Reading readings[2];
  for (int way = 0; way < 2; ++way) {
    for (const char* line : {kWays[way], "movej([0.0,-1.2,1.2,-0.1,1.57,0.0])\n"}) {
      bench.upload(line);
      bench.run_s(3.0);
    }
    bench.run(50);
    readings[way] = read(bench.controller, 250);
  }
  const double apart = (readings[0].mean - readings[1].mean).head<3>().norm();
  print_message("%.2f N\n", apart);
  assert_true(apart > 1.0 && apart < 20.0);
}

void the_same_seed_gives_the_same_errors(void**) {
  Vector6 last[3];
  constexpr unsigned kSeeds[] = {5, 5, 6};
  for (int i = 0; i < 3; ++i) {
    Controller controller(with_errors(kSeeds[i]));
    ASSERT_OK(controller.start());
    for (int k = 0; k < 30; ++k) controller.tick();
    last[i] = controller.image().actual_tcp_force;
  }
  assert_true(last[0] == last[1] && last[0] != last[2]);
}

void the_sensor_of_an_e_series_can_be_zeroed(void**) {
  static ProgramBench bench{with_errors(4, true)};
  const Reading before = read(bench.controller, 500);
  bench.upload("zero_ftsensor()\n");
  bench.run(10);
  const Reading after = read(bench.controller, 500);
  assert_true(before.mean.head<3>().norm() > 0.5 && before.mean.head<3>().norm() < 7.0);
  assert_true(after.mean.head<3>().norm() < 0.4);
  for (int i = 0; i < 3; ++i) ASSERT_NEAR(after.deviation[i], 5.0 / 3.0, 0.2);
}

/// The wrench of a push, as a CB3 or an e-Series with a tool of 0.2 m shows it.
Vector6 pushed(const Version& version, Vector3& lever) {
  Settings settings = ProgramBench::settings();
  settings.version = version;
  settings.tcp_offset[2] = 0.2;
  Controller controller(settings);
  assert_true(controller.start() == Status::kOk);
  controller.faults().push << 0.0, 20.0, -10.0, 0.0, 3.0, 0.0;
  for (int k = 0; k < 1000; ++k) controller.tick();
  const Vector6 pose = controller.image().actual_tcp_pose;
  lever = rotation_matrix(pose.tail<3>()) * Vector3(0.0, 0.0, 0.2);
  return controller.image().actual_tcp_force;
}

void the_moment_of_an_e_series_is_about_the_flange(void**) {
  Vector3 lever;
  const Vector6 about_tip = pushed(Version(), lever);
  const Vector6 about_flange = pushed({5, 11, 1, 108318}, lever);
  const Vector3 force = about_tip.head<3>();
  assert_true(force.norm() > 5.0);
  assert_true((about_flange.head<3>() - force).norm() < 0.05);
  const Vector3 moved = about_tip.tail<3>() + lever.cross(force);
  assert_true(lever.cross(force).norm() > 0.5);
  assert_true((about_flange.tail<3>() - moved).norm() < 0.05);
}

/// From software 5.9 on a recipe has it: in the flange, with the weight of the payload.
void the_raw_wrench_of_an_e_series_has_the_weight_of_the_payload(void**) {
  assert_true(find_output("ft_raw_wrench", {5, 8, 2, 0}).type == FieldType::kNotFound);
  assert_true(find_output("ft_raw_wrench", {5, 9, 0, 0}).type == FieldType::kVector6d);
  const Vector3 cog(0.01, 0.02, 0.1);
  for (const double payload_kg : {0.0, 2.0}) {
    Settings settings = ProgramBench::settings();
    settings.version = {5, 11, 1, 108318};
    settings.payload_kg = payload_kg;
    settings.payload_cog = cog;
    Controller& controller = *new Controller(settings);
    assert_true(controller.start() == Status::kOk);
    controller.faults().push << 0.0, 20.0, -10.0, 0.0, 3.0, 0.0;
    for (int k = 0; k < 1000; ++k) controller.tick();
    const Image& image = controller.image();
    const Matrix3 to_base = rotation_matrix(image.actual_tcp_pose.tail<3>());
    const Vector6 raw = image.ft_raw_wrench;
    const Vector3 weight(0.0, 0.0, -9.81 * settings.payload_kg);
    const Vector3 force = image.actual_tcp_force.head<3>(),
                  moment = image.actual_tcp_force.tail<3>();
    assert_true(force.norm() > 5.0 && moment.norm() > 1.0);
    assert_true((to_base * raw.head<3>() - force - weight).norm() < 0.02);
    assert_true((to_base * raw.tail<3>() - moment - (to_base * cog).cross(weight)).norm() < 0.02);
    delete &controller;
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_arm_at_rest_shows_the_same_position_in_every_cycle),
      cmocka_unit_test(without_errors_the_force_of_nothing_is_nothing),
      cmocka_unit_test(the_estimate_of_a_cb3_is_as_uncertain_as_its_maker_says),
      cmocka_unit_test(friction_that_is_not_known_depends_on_the_way_to_a_place),
      cmocka_unit_test(the_same_seed_gives_the_same_errors),
      cmocka_unit_test(the_moment_of_an_e_series_is_about_the_flange),
      cmocka_unit_test(the_sensor_of_an_e_series_can_be_zeroed),
      cmocka_unit_test(the_raw_wrench_of_an_e_series_has_the_weight_of_the_payload),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
