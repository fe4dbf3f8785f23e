// Tests the surroundings of the emulated arm: a pipeline file gives the boxes, the arm touches
// them, and the controller sees the force. The numbers of the file are compared with the text, the
// force with that of the spring.
#include "sim_plant/ur/scene/scene_reader.hpp"
#include "tests/ur/programs/ur_program_bench.hpp"

namespace {

using namespace tactus;
using namespace tactus::ur;

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

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(boxes_and_tool_are_those_of_the_file),
      cmocka_unit_test(the_section_of_a_simulated_board_counts_if_there_is_one),
      cmocka_unit_test(a_mistake_is_refused_where_it_is),
      cmocka_unit_test(the_arm_presses_a_box_as_its_stiffness_says),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
