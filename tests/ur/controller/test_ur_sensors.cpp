// Tests what the emulated controller measures: the errors of its sensors against the figures that
// they are taken from, and the surroundings: a pipeline file gives the boxes, the arm touches them,
// and the controller sees the force.
#include "sim_plant/ur/scene/scene_reader.hpp"
#include "sim_plant/ur/wire/rtde_fields.hpp"
#include "tests/ur/programs/ur_program_bench.hpp"

namespace tactus::ur {
namespace {

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

constexpr const char* kRobot =
    "[robot]\nname = ur10\nperiod_us = 8000\nq_c = cpc.q_c\ntool_mass = 0.7\n"
    "tool_com = 0 0 0.03\ntool_tip = 0 0 0.1\nmounting = 0 1 0\n";
constexpr const char* kFrame =
    "[base_link]\ntype = frame\nposition = 0 0 1\nrotation = 0 0 3.14159265358979\n";
constexpr const char* kBoard =
    "[blackboard]\ntype = box\nframe = base_link.x\ncentre = 0.75 0.4 0.7\nsize = 0.02 1.2 1.0\n";

struct File {
  Text<4095> text{kRobot};
  Surroundings around;
  LoadError error;

  explicit File(const char* more) { text << more; }
  Status read() {
    static SceneReader reader;
    return reader.read(text, around, error);
  }
  bool says(std::string_view words) const {
    print_message("%s\n", error.message().c_str());
    return std::string_view(error.message()).find(words) != std::string_view::npos;
  }
};

// Proves URE-60.

void boxes_and_tool_are_those_of_the_file(void**) {
  static File file("[model]\ntype = robot_model\nq = robot.q\n");
  file.text << kFrame << kBoard << "[cpc]\ntype = no_such_block\n";
  ASSERT_OK(file.read());
  assert_int_equal(file.around.scene.count, 1);
  const Box& box = file.around.scene.boxes[0];
  const double centre[] = {-0.75, -0.4, 1.7}, half[] = {0.01, 0.6, 0.5}, com[] = {0, 0, 0.03};
  for (int i = 0; i < 3; ++i) {
    ASSERT_NEAR(box.pose.p[i], centre[i], 1e-9);
    ASSERT_NEAR(box.half_extents[i], half[i], 1e-12);
    ASSERT_NEAR(file.around.payload_com[i], com[i], 0.0);
  }
  ASSERT_NEAR(std::abs(box.pose.r.z()), 1.0, 1e-9);
  ASSERT_NEAR(file.around.payload_kg, 0.7, 0.0);
  assert_true(file.around.mounting == Vector3(0.0, 1.0, 0.0));
  ASSERT_NEAR(file.around.tip.z(), 0.1, 0.0);
  ASSERT_NEAR(file.around.material.stiffness, 2e4, 0.0);
}

void the_section_of_a_simulated_board_counts_if_there_is_one(void**) {
  static File file(
      "[plant]\nmounting = 3 0 0\npayload_kg = 2\npayload_tip = 0 0 0.2\ntip_radius = 0.02\n"
      "contact_stiffness = 5000\ncontact_friction = 0\n");
  ASSERT_OK(file.read());
  assert_int_equal(file.around.scene.count, 0);
  ASSERT_NEAR(file.around.payload_kg, 2.0, 0.0);
  assert_true(file.around.mounting == Vector3(3.0, 0.0, 0.0));
  ASSERT_NEAR(file.around.tip.z(), 0.2, 0.0);
  ASSERT_NEAR(file.around.tip_radius, 0.02, 0.0);
  ASSERT_NEAR(file.around.material.stiffness, 5000.0, 0.0);
  ASSERT_NEAR(file.around.material.friction, 0.0, 0.0);
}

void a_mistake_is_refused_where_it_is(void**) {
  static File frame("[board]\ntype = box\nframe = model.x\ncentre = 0 0 0\nsize = 1 1 1\n");
  ASSERT_STATUS(frame.read(), Status::kUnknownPort);
  assert_true(frame.says("11: [board] frame: unknown output 'model.x'"));
  static File size("[board]\ntype = box\ncentre = 0 0 0\n");
  ASSERT_STATUS(size.read(), Status::kMissingKey);
  static File key("[board]\ntype = box\ncentre = 0 0 0\nsize = 1 1 1\nstifness = 3\n");
  ASSERT_STATUS(key.read(), Status::kUnknownKey);
  static File many("");
  for (char name = 'a'; name <= 'i'; ++name) {
    const char letter[] = {name, '\0'};
    many.text << "[" << letter << "]\ntype = box\ncentre = 0 0 0\nsize = 1 1 1\n";
  }
  ASSERT_STATUS(many.read(), Status::kTooLarge);
  assert_true(many.says("[i] more than 8 boxes"));
  SceneReader reader;
  Surroundings around;
  LoadError error;
  ASSERT_STATUS(reader.read("[robot]\nname = fer\nperiod_us = 1000\n", around, error),
                Status::kNotOffered);
  ASSERT_STATUS(reader.read("[plant]\n", around, error), Status::kMissingKey);
}

/// A controller whose arm meets a plate 10 mm below its tip, a ball of 10 mm.
Settings above_a_plate() {
  Settings settings = ProgramBench::settings();
  const Vector3 tip = forward(settings.initial_q).p;
  Surroundings& around = settings.surroundings;
  around.scene.count = 1;
  around.scene.boxes[0].pose.p = tip - Vector3(0.0, 0.0, 0.01 + 0.01 + 0.05);
  around.scene.boxes[0].half_extents = {0.3, 0.3, 0.05};
  return settings;
}

// Proves URE-61.

/// A target 2 mm in the plate: 40 N less what the servo and the slide give way.
void the_arm_presses_a_box_as_its_stiffness_says(void**) {
  static ProgramBench bench{above_a_plate()};
  Vector6 pose = bench.image().target_tcp_pose;
  pose[2] -= 0.012;
  std::array<char, 256> line;
  std::snprintf(line.data(), line.size(),
                "movel(p[%.6f,%.6f,%.6f,%.6f,%.6f,%.6f], a=0.1, v=0.02)\n", pose[0], pose[1],
                pose[2], pose[3], pose[4], pose[5]);
  double before = 0.0;
  bench.upload(line.data());
  for (int k = 0; k < 40; ++k) {
    bench.tick();
    before = std::max(before, bench.image().actual_tcp_force.norm());
  }
  assert_true(before < 1.0);  // still above the plate
  bench.run(300);
  const double reached = forward(bench.machine().body.q()).p.z();
  const double plate = forward(ProgramBench::settings().initial_q).p.z() - 0.01;
  const double spring = 2e4 * (plate - reached);
  print_message("%.2f N, spring %.2f N\n", bench.image().actual_tcp_force[2], spring);
  assert_true(spring > 20.0 && spring < 40.0);
  ASSERT_NEAR(bench.image().actual_tcp_force[2], spring, 0.03 * spring);
  assert_int_equal(bench.image().safety_mode, 1);
}

}  // namespace
}  // namespace tactus::ur

int main() {
  using namespace tactus::ur;
  const CMUnitTest tests[] = {
      cmocka_unit_test(an_arm_at_rest_shows_the_same_position_in_every_cycle),
      cmocka_unit_test(without_errors_the_force_of_nothing_is_nothing),
      cmocka_unit_test(the_estimate_of_a_cb3_is_as_uncertain_as_its_maker_says),
      cmocka_unit_test(friction_that_is_not_known_depends_on_the_way_to_a_place),
      cmocka_unit_test(the_same_seed_gives_the_same_errors),
      cmocka_unit_test(the_moment_of_an_e_series_is_about_the_flange),
      cmocka_unit_test(the_sensor_of_an_e_series_can_be_zeroed),
      cmocka_unit_test(the_raw_wrench_of_an_e_series_has_the_weight_of_the_payload),
      cmocka_unit_test(boxes_and_tool_are_those_of_the_file),
      cmocka_unit_test(the_section_of_a_simulated_board_counts_if_there_is_one),
      cmocka_unit_test(a_mistake_is_refused_where_it_is),
      cmocka_unit_test(the_arm_presses_a_box_as_its_stiffness_says),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
