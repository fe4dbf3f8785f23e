#include "kernel/loader.hpp"

#include "kernel/collision_reader.hpp"
#include "kernel/recording_reader.hpp"
#include "kernel/schedule_reader.hpp"

namespace tactus {
namespace {

/// A key that nobody reads is a typing mistake, and is refused before anything else in its section.
template <class Find>
Status refuse_unknown_keys(const Ini& ini, const IniSection& section, LoadError& error, Find find) {
  for (int i = section.first; i < section.first + section.count; ++i) {
    const IniEntry& entry = ini.entry(i);
    KeyFinder finder(entry.key);
    find(finder);
    if (!finder.found())
      return error.refuse(Status::kUnknownKey, entry.line, section.name, entry.key,
                          "the section has no such key");
  }
  return Status::kOk;
}

template <class Settings>
Status read_settings(const Ini& ini, const IniSection& section, PortTable& ports, LoadError& error,
                     Settings& settings) {
  TRY(refuse_unknown_keys(ini, section, error,
                          [&](KeyFinder& finder) { settings.describe(finder); }));
  SectionReader reader(ini, section, ports, error);
  settings.describe(reader);
  return error.status;
}

/// Puts a default block of the kind called `type` into the slot; false if there is no such kind.
template <std::size_t I = 1>
bool emplace(Block& block, std::string_view type) {
  if constexpr (I < std::variant_size_v<Block>) {
    if (type != kBlockTypes[I]) return emplace<I + 1>(block, type);
    block.emplace<I>();
    return true;
  } else {
    return false;
  }
}

template <class Visitor>
void describe_block(Block& block, Visitor& visitor) {
  std::visit(
      [&](auto& kind) {
        if constexpr (!std::is_same_v<decltype(kind), std::monostate&>) kind.describe(visitor);
      },
      block);
}

int line_of(const Ini& ini, const IniSection& section, const char* key) {
  const IniEntry* entry = ini.find(section, key);
  return entry ? entry->line : section.line;
}

Message block_types() {
  Message words;
  for (std::size_t i = 1; i < kBlockTypes.size(); ++i)
    words << (i > 1 ? ", " : "") << kBlockTypes[i];
  return words;
}

}  // namespace

void Loader::add(const BoardSection& section) {
  if (board_section_count_ < board_sections_.size())
    board_sections_[board_section_count_++] = section;
}

Status Loader::load(std::string_view text, Pipeline& pipeline, LoadError& error) {
  error = {};
  left_ = channels_;
  Ini ini;
  TRY(ini.parse(text, error));
  const IniSection* robot = ini.find("robot");
  if (robot == nullptr)
    return error.refuse(Status::kMissingKey, 0, "robot", {}, "the section is missing");
  TRY(load_sections(ini, pipeline, error));
  TRY(load_command(ini, *robot, pipeline, error));
  TRY(check_command(ini, *robot, pipeline, error));
  TRY(read_recording(ini, pipeline, error));
  TRY(read_collision(ini, pipeline, error));
  TRY(read_schedule(ini, pipeline, error));
  const double period_s = pipeline.robot.period_s(), reserve = pipeline.guard.stop_reserve;
  const double stretch = pipeline.guard.max_stretch;
  pipeline.takes_joints = channels_.joint != nullptr && left_.joint == nullptr;
  pipeline.takes_poses = channels_.task != nullptr && left_.task == nullptr;
  if (pipeline.takes_joints)
    channels_.joint->settings = {pipeline.guard.effective(), period_s, reserve, stretch};
  if (pipeline.takes_poses)
    channels_.task->settings = {pipeline.task_limits, period_s, reserve, stretch};
  return Status::kOk;
}

Status Loader::load_sections(const Ini& ini, Pipeline& pipeline, LoadError& error) {
  for (int i = 0; i < ini.section_count(); ++i) {
    TRY(load_section(ini, ini.section(i), pipeline, error));
  }
  return Status::kOk;
}

Status Loader::load_section(const Ini& ini, const IniSection& section, Pipeline& pipeline,
                            LoadError& error) {
  PortTable& ports = pipeline.ports;
  if (section.name == "robot") {
    TRY(refuse_unknown_keys(ini, section, error, [&](KeyFinder& finder) {
      pipeline.robot.describe(finder);
      pipeline.robot.describe_command(finder);
    }));
    SectionReader reader(ini, section, ports, error);
    pipeline.robot.describe(reader);
    if (reader.failed()) return error.status;
    if (!offered_.wrench) ports.withhold(&pipeline.robot.ft.value);
    return check_robot(ini, section, pipeline.robot, error);
  }
  if (section.name == "guard") return read_settings(ini, section, ports, error, pipeline.guard);
  if (section.name == "collision") {
    pipeline.collision.given = true;
    return read_settings(ini, section, ports, error, pipeline.collision);
  }
  if (section.name == "task_limits") {
    TRY(read_settings(ini, section, ports, error, pipeline.task_limits));
    return check_workspace(ini, section, pipeline.task_limits, error);
  }
  if (section.name == "executive")
    return read_settings(ini, section, ports, error, pipeline.executive);
  if (section.name == "recorder")
    return read_settings(ini, section, ports, error, pipeline.recorder);
  for (std::size_t i = 0; i < board_section_count_; ++i) {
    const BoardSection& board = board_sections_[i];
    if (board.name != section.name) continue;
    TRY(refuse_unknown_keys(ini, section, error,
                            [&](KeyFinder& finder) { board.find(board.settings, finder); }));
    SectionReader reader(ini, section, ports, error);
    board.read(board.settings, reader);
    return error.status;
  }
  return load_block(ini, section, pipeline, error);
}

Status Loader::load_block(const Ini& ini, const IniSection& section, Pipeline& pipeline,
                          LoadError& error) {
  const IniEntry* type = ini.find(section, "type");
  if (type == nullptr)
    return error.refuse(Status::kMissingKey, section.line, section.name, "type",
                        Message("the key is missing; a block is one of ") << block_types());
  Block* block = pipeline.append(section.name);
  if (block == nullptr)
    return error.refuse(Status::kTooLarge, section.line, section.name, {},
                        Message("more than ") << kMaxBlocks << " blocks");
  if (!emplace(*block, type->value))
    return error.refuse(Status::kUnknownType, type->line, section.name, "type",
                        Message("'") << type->value << "' is none of " << block_types());
  TRY(refuse_unknown_keys(ini, section, error, [&](KeyFinder& finder) {
    finder.param("type");
    describe_block(*block, finder);
  }));
  SectionReader reader(ini, section, pipeline.ports, error);
  reader.offer(left_);
  describe_block(*block, reader);
  return error.status;
}

Status Loader::load_command(const Ini& ini, const IniSection& section, Pipeline& pipeline,
                            LoadError& error) {
  SectionReader reader(ini, section, pipeline.ports, error);
  pipeline.robot.describe_command(reader);
  if (reader.failed()) return error.status;
  const RobotSection& robot = pipeline.robot;
  const int commands = robot.q_c.wired() + robot.dq_c.wired() + robot.tau_c.wired();
  if (commands != 1)
    return error.refuse(Status::kNotConnected, section.line, section.name, {},
                        Message("")
                            << commands << " commands, expected exactly one of q_c, dq_c, tau_c");
  return Status::kOk;
}

Status Loader::check_robot(const Ini& ini, const IniSection& section, const RobotSection& robot,
                           LoadError& error) const {
  if (robot.name.empty())
    return error.refuse(Status::kMissingKey, section.line, section.name, "name",
                        "the key is missing (the robot the file is written for)");
  if (std::string_view(robot.name) != Robot::kName)
    return error.refuse(Status::kNotOffered, line_of(ini, section, "name"), section.name, "name",
                        Message("'")
                            << robot.name << "', this program is built for " << Robot::kName);
  if (robot.period_us < offered_.min_period_us || robot.period_us > offered_.max_period_us)
    return error.refuse(Status::kNotOffered, line_of(ini, section, "period_us"), section.name,
                        "period_us",
                        Message("") << robot.period_us << " us, the robot offers "
                                    << static_cast<int>(offered_.min_period_us) << " to "
                                    << static_cast<int>(offered_.max_period_us));
  return Status::kOk;
}

/// A box that holds no point would refuse every reference.
Status Loader::check_workspace(const Ini& ini, const IniSection& section, const TaskLimits& limits,
                               LoadError& error) {
  for (int i = 0; i < 3; ++i) {
    if (limits.p_min[i] <= limits.p_max[i]) continue;
    return error.refuse(
        Status::kBadValue, line_of(ini, section, "max_position"), section.name, "max_position",
        Message("axis ") << i + 1 << ": " << limits.p_max[i] << " m is below min_position, "
                         << limits.p_min[i] << " m");
  }
  return Status::kOk;
}

Status Loader::check_command(const Ini& ini, const IniSection& section, const Pipeline& pipeline,
                             LoadError& error) const {
  const CommandMode mode = pipeline.robot.mode();
  const bool offered = mode == CommandMode::kEffort     ? offered_.effort
                       : mode == CommandMode::kVelocity ? offered_.velocity
                                                        : offered_.position;
  const char* key = mode == CommandMode::kEffort     ? "tau_c"
                    : mode == CommandMode::kVelocity ? "dq_c"
                                                     : "q_c";
  if (!offered)
    return error.refuse(Status::kNotOffered, line_of(ini, section, key), section.name, key,
                        "the robot does not take this kind of command");
  return Status::kOk;
}

}  // namespace tactus
