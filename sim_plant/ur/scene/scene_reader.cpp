#include "sim_plant/ur/scene/scene_reader.hpp"

#include "kernel/pipeline/settings.hpp"

namespace tactus::ur {

Status SceneReader::read(std::string_view text, Surroundings& around, LoadError& error) {
  error = {};
  ports_ = {};
  frame_count_ = 0;
  around = {};
  TRY(ini_.parse(text, error));
  const IniSection* robot = ini_.find("robot");
  if (robot == nullptr)
    return error.refuse(Status::kMissingKey, 0, "robot", {}, "the section is missing");
  TRY(read_robot(*robot, around, error));
  for (int i = 0; i < ini_.section_count(); ++i) TRY(read_section(ini_.section(i), around, error));
  return Status::kOk;
}

Status SceneReader::read_section(const IniSection& section, Surroundings& around,
                                 LoadError& error) {
  if (section.name == "plant") return read_plant(section, around, error);
  const IniEntry* type = ini_.find(section, "type");
  if (type == nullptr) return Status::kOk;
  if (type->value == tactus::Frame::kType) return read_frame(section, error);
  if (type->value == BoxObstacle::kType) return read_box(section, around.scene, error);
  return Status::kOk;
}

/// Reads the tool; the rest of the section is the program's.
Status SceneReader::read_robot(const IniSection& section, Surroundings& around, LoadError& error) {
  RobotSection robot;
  SectionReader reader(ini_, section, ports_, error);
  robot.describe_robot(reader);
  if (reader.failed()) return error.status;
  if (std::string_view(robot.name) != Robot::kName)
    return error.refuse(Status::kNotOffered, section.line, section.name, "name",
                        Message("'")
                            << robot.name << "', but the emulated robot is a " << Robot::kName);
  around.mounting = robot.mounting;
  const Tool tool = assumed(robot.given_tool());
  around.payload_kg = tool.mass_kg;
  around.payload_com = tool.com;
  around.tip = tool.tip.p;
  return Status::kOk;
}

Status SceneReader::read_plant(const IniSection& section, Surroundings& around, LoadError& error) {
  PlantParams plant;
  SectionReader reader(ini_, section, ports_, error);
  while (reader.next()) plant.describe(reader);
  around.mounting = plant.mounted_as(around.mounting).mounting;
  around.payload_kg = plant.payload_kg;
  around.payload_com = plant.payload_com;
  around.tip = plant.payload_tip;
  around.tip_radius = plant.tip_radius;
  around.material = plant.material;
  return error.status;
}

template <class Block>
Status SceneReader::read_block(const IniSection& section, Block& block, LoadError& error) {
  SectionReader reader(ini_, section, ports_, error);
  while (reader.next()) {
    reader.know("type");
    block.describe(reader);
  }
  return reader.failed() ? error.status : block.start();
}

Status SceneReader::read_frame(const IniSection& section, LoadError& error) {
  return read_block(section, frames_[frame_count_++] = {}, error);
}

Status SceneReader::read_box(const IniSection& section, Scene& scene, LoadError& error) {
  if (scene.count == kMaxBoxes)
    return error.refuse(Status::kTooLarge, section.line, section.name, {},
                        Message("more than ") << kMaxBoxes << " boxes");
  BoxObstacle obstacle;
  PortTable before = ports_;  // the box itself is not kept
  TRY(read_block(section, obstacle, error));
  ports_ = before;
  scene.boxes[static_cast<std::size_t>(scene.count++)] = {obstacle.box.value.pose,
                                                          0.5 * obstacle.box.value.size};
  return Status::kOk;
}

}  // namespace tactus::ur
