#include "kernel/load/pipeline_sections.hpp"

namespace tactus {

void PipelineSections::section(const char* name, RobotSection& robot) {
  const auto describe = [&](SectionReader& reader) {
    robot.describe_robot(reader);
    if (reader.seeks()) robot.describe_command(reader);  // read after the last block
  };
  if (!read(name, describe)) return;
  robot.tool.value = assumed(robot.given_tool());
  check_robot(robot);
}

void PipelineSections::section(const char* name, TaskLimits& limits) {
  if (read(name, [&](SectionReader& reader) { limits.describe(reader); })) check_workspace(limits);
}

void PipelineSections::check_robot(const RobotSection& robot) {
  if (!offered_.wrench) ports_.withhold(&robot.ft.value);
  if (robot.name.empty())
    return refuse(Status::kMissingKey, "name",
                  "the key is missing; add it, the robot the file is written for");
  if (std::string_view(robot.name) != Robot::kName)
    return refuse(Status::kNotOffered, "name",
                  Message("'") << robot.name << "', but this program is built for " << Robot::kName
                               << "; take a board with the robot of the file");
  if (robot.tool_com == robot.tool_com && !(robot.tool_mass == robot.tool_mass))
    return refuse(Status::kMissingKey, "tool_com",
                  "a centre of mass of nothing; add tool_mass, in kg");
  if (robot.period_us < offered_.min_period_us || robot.period_us > offered_.max_period_us)
    refuse(Status::kNotOffered, "period_us",
           Message("") << robot.period_us << " us is out of range; the robot takes "
                       << static_cast<int>(offered_.min_period_us) << " to "
                       << static_cast<int>(offered_.max_period_us));
}

/// Refuses a box that contains no point: it would refuse every reference.
void PipelineSections::check_workspace(const TaskLimits& limits) {
  for (int i = 0; i < 3; ++i) {
    if (limits.p_min[i] <= limits.p_max[i]) continue;
    return refuse(Status::kBadValue, "max_position",
                  Message("axis ") << i + 1 << ": " << limits.p_max[i]
                                   << " m is below min_position, " << limits.p_min[i] << " m");
  }
}

void PipelineSections::refuse(Status status, const char* key, std::string_view reason) {
  const IniEntry* entry = ini_.find(section_, key);
  static_cast<void>(error_.refuse(status, entry != nullptr ? entry->line : section_.line,
                                  section_.name, key, reason));
}

}  // namespace tactus
