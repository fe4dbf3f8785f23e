#include "kernel/load/loader.hpp"

#include <new>

#include "kernel/load/collision_reader.hpp"
#include "kernel/load/pipeline_sections.hpp"
#include "kernel/load/recording_reader.hpp"
#include "kernel/load/schedule_reader.hpp"
#include "kernel/pipeline/with_block.hpp"

namespace tactus {
namespace {

/// Describes a kind that does not change while it runs.
struct Unchanging : SectionReader {
  template <class Value>
  void tunable(const char*, Value&, const Range&, const char*) {
    static_assert(sizeof(Value) == 0, "a kind with a tunable parameter has retune(); else: param");
  }
};

/// True if it compiles: no kind offers parameters that it cannot change.
template <auto>
constexpr bool kCompiles = true;
template <class... Each>
constexpr bool all_change_what_they_offer(KindList<Each...>) {
  return (
      ... &&
      kCompiles<
          &Each::template describe<std::conditional_t<kTunes<Each>, SectionReader, Unchanging>>>);
}
static_assert(all_change_what_they_offer(Kinds()));

/// Sets the number of the kind called `type`; false if there is none.
bool find_kind(std::string_view type, std::size_t& kind) {
  for (kind = 0; kind < Kinds::kCount; ++kind)
    if (type == Kinds::kTypes[kind]) return true;
  return false;
}

/// Bytes of a block; of a law compiled elsewhere, with its state behind it.
template <class Kind>
std::size_t bytes_of() {
  if constexpr (kIsForeign<Kind>)
    return Kind::size();
  else
    return sizeof(Kind);
}

/// Puts a default block of its kind at the next place in the memory; false if there is none.
bool place(Block& block, Arena& memory) {
  return with_kind(block.kind, [&](auto kind) {
    using Kind = typename decltype(kind)::Type;
    block.place = memory.take(bytes_of<Kind>(), alignof(Kind));
    return block.place != nullptr && new (block.place) Kind() != nullptr;
  });
}

std::size_t size_of(const Block& block) {
  return with_kind(block.kind, [](auto kind) { return bytes_of<typename decltype(kind)::Type>(); });
}

/// Judges what a law that was compiled elsewhere says of itself.
Status judge_description(const Block& block, const IniEntry& type, LoadError& error) {
  Message why;
  const Status status = with_kind(block.kind, [&why](auto kind) {
    using Kind = typename decltype(kind)::Type;
    if constexpr (kIsForeign<Kind>) return Kind::judge_description(why);
    return Status::kOk;
  });
  return status == Status::kOk ? status : error.refuse(status, type.line, block.name, "type", why);
}

/// The time that the laws compiled elsewhere state for a step of theirs, us.
int stated_us(const Pipeline& pipeline) {
  int sum_us = 0;
  for (int i = 0; i < pipeline.count(); ++i) {
    sum_us += with_kind(pipeline[i].kind, [](auto kind) {
      using Kind = typename decltype(kind)::Type;
      if constexpr (kIsForeign<Kind>) return Kind::bound_us();
      return 0;
    });
  }
  return sum_us;
}

void describe_block(const Block& block, SectionReader& reader) {
  with_kind(block.kind, [&](auto kind) {
    static_cast<typename decltype(kind)::Type*>(block.place)->describe(reader);
  });
}

int line_of(const Ini& ini, const IniSection& section, const char* key) {
  const IniEntry* entry = ini.find(section, key);
  return entry ? entry->line : section.line;
}

/// Refuses a budget of the control chain that is less than the laws of the chain state.
Status check_stated(const Ini& ini, const Pipeline& pipeline, LoadError& error) {
  const int budget_us = pipeline.executive.budget(pipeline.robot.period_us);
  const int sum_us = stated_us(pipeline);
  if (sum_us <= budget_us) return Status::kOk;
  const IniSection* section = ini.find("executive");
  return error.refuse(Status::kOverBudget, section ? line_of(ini, *section, "budget_us") : 0,
                      "executive", "budget_us",
                      Message("") << budget_us << " us; the laws of LAWS alone state " << sum_us
                                  << " us for a cycle; raise the budget, or the period");
}

Message block_types() {
  Message words;
  for (std::size_t i = 0; i < Kinds::kCount; ++i) words << (i > 0 ? ", " : "") << Kinds::kTypes[i];
  return words;
}

}  // namespace

Status Loader::load(std::string_view text, Pipeline& pipeline, LoadError& error, OwnLayout) {
  error = {};
  if (pipeline.count() > 0 || pipeline.ports.count() > 0)
    return error.refuse(Status::kBadValue, 0, {}, {},
                        "a file was read into this pipeline before; take a new one");
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
  if constexpr (Kinds::kHasForeign) TRY(check_stated(ini, pipeline, error));
  const double period_s = pipeline.robot.period_s(), reserve = pipeline.guard.stop_reserve;
  const double stretch = pipeline.guard.max_stretch;
  pipeline.takes_joints = channels_.joint != nullptr && left_.joint == nullptr;
  pipeline.takes_poses = channels_.task != nullptr && left_.task == nullptr;
  const JointLimits limits = pipeline.guard.references();
  pipeline.keep_within(limits);
  if (pipeline.takes_joints) channels_.joint->settings = {limits, period_s, reserve, stretch};
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
  PipelineSections sections(ini, section, pipeline.ports, error, offered_);
  pipeline.describe(sections);
  describe_(sections_, sections);
  if (sections.found()) return error.status;
  if (ini.find(section, "type") != nullptr) return load_block(ini, section, pipeline, error);
  return error.refuse(Status::kNotOffered, section.line, section.name, {},
                      Message("this board has no such section; it has ")
                          << sections.names() << "; a block has a type, one of " << block_types());
}

Status Loader::load_block(const Ini& ini, const IniSection& section, Pipeline& pipeline,
                          LoadError& error) {
  const IniEntry& type = *ini.find(section, "type");
  Block block{section.name};
  if (pipeline.count() == kMaxBlocks)
    return error.refuse(Status::kTooLarge, section.line, section.name, {},
                        Message("more than ") << kMaxBlocks << " blocks");
  if (!find_kind(type.value, block.kind))
    return error.refuse(Status::kUnknownType, type.line, section.name, "type",
                        Message("unknown type '")
                            << type.value << "'; expected one of " << block_types());
  if constexpr (Kinds::kHasForeign) TRY(judge_description(block, type, error));
  const std::size_t left = pipeline.memory.left();
  if (!place(block, pipeline.memory))
    return error.refuse(Status::kTooLarge, type.line, section.name, "type",
                        Message("the block takes ")
                            << size_of(block) << " bytes; of the board's " << pipeline.memory.size()
                            << " for blocks " << left << " are left");
  pipeline.append(block);
  SectionReader reader(ini, section, pipeline.ports, error);
  reader.offer(left_);
  while (reader.next()) {
    reader.know("type");
    describe_block(block, reader);
  }
  TRY(error.status);
  const bool models = type.value == RobotModel::kType;
  if (models && pipeline.robot.tool.value.matters() && ini.find(section, "tool") == nullptr)
    return error.refuse(Status::kMissingKey, section.line, section.name, "tool",
                        "[robot] gives a tool or a mounting; add tool = robot.tool");
  return Status::kOk;
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
                            << commands << " commands; expected exactly one of q_c, dq_c, tau_c");
  if (robot.dq_ff.wired() && !robot.q_c.wired())
    return error.refuse(Status::kNotConnected, line_of(ini, section, "dq_ff"), section.name,
                        "dq_ff", "a velocity is fed forward beside q_c only");
  if (robot.tau_ff.wired() && robot.tau_c.wired())
    return error.refuse(Status::kNotConnected, line_of(ini, section, "tau_ff"), section.name,
                        "tau_ff", "a torque is fed forward beside q_c or dq_c only");
  return Status::kOk;
}

Status Loader::check_command(const Ini& ini, const IniSection& section, Pipeline& pipeline,
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
  const char* fed = pipeline.robot.dq_ff.wired() && !offered_.velocity_feed_forward  ? "dq_ff"
                    : pipeline.robot.tau_ff.wired() && !offered_.effort_feed_forward ? "tau_ff"
                                                                                     : nullptr;
  if (fed != nullptr)
    return error.refuse(Status::kNotOffered, line_of(ini, section, fed), section.name, fed,
                        "the robot does not take this feed-forward");
  return check_outputs(ini, section, pipeline, error);
}

Status Loader::check_outputs(const Ini& ini, const IniSection& section, Pipeline& pipeline,
                             LoadError& error) const {
  pipeline.robot.offer_outputs(offered_.outputs);
  if (!pipeline.robot.commands_outputs() || offered_.outputs != 0) return Status::kOk;
  return error.refuse(Status::kNotOffered, line_of(ini, section, "outputs"), section.name,
                      "outputs",
                      "the robot has no digital outputs; remove the key, or take a board whose "
                      "robot has some");
}

}  // namespace tactus
