// The calls of a script that change how the arm moves: force mode, freedrive, watchdogs.
#include "sim_plant/ur/script/script_motion.hpp"

namespace tactus::ur {
namespace {

using Kind = ScriptValue::Kind;

/// force_mode(task_frame, selection_vector, wrench, type, limits).
void start_force_mode(const ScriptCall& call, Machine& machine) {
  const ScriptValue* frame = call.find("task_frame", 0);
  const ScriptValue* selection = call.find("selection_vector", 1);
  const ScriptValue* wrench = call.find("wrench", 2);
  const ScriptValue* limits = call.find("limits", 4);
  for (const ScriptValue* value : {frame, selection, wrench, limits})
    if (value == nullptr || !value->six())
      return machine.messages.text("force_mode: six numbers are missing");
  ForceMode mode;
  mode.task_frame = frame->vector();
  mode.selection = selection->vector();
  mode.wrench = wrench->vector();
  mode.type = integer(call.number("type", 3, 2.0));
  mode.limits = limits->vector();
  machine.start_force_mode(mode);
}

/// rtde_set_watchdog(variable_name, min_frequency, action="pause").
void set_watchdog(const ScriptCall& call, Machine& machine) {
  const ScriptValue* name = call.find("variable_name", 0);
  const ScriptValue* word = call.find("action", 2);
  const bool named = name != nullptr && name->kind == Kind::kText;
  const InputField field = find_input(named ? name->text : "", machine.settings.version);
  if (field.type == FieldType::kNotFound)
    return machine.messages.text("rtde_set_watchdog: there is no such input");
  LateAction action = LateAction::kPause;
  if (word != nullptr && word->text == "stop") action = LateAction::kStop;
  if (word != nullptr && word->text == "ignore") action = LateAction::kIgnore;
  machine.watchdogs.set(field, call.number("min_frequency", 1, 0.0), action, machine.cycle);
}

}  // namespace

bool run_mode_call(const ScriptCall& call, Machine& machine) {
  const std::string_view name = call.name;
  if (name == "force_mode") {
    start_force_mode(call, machine);
  } else if (name == "end_force_mode") {
    machine.force_mode = {};
  } else if (name == "force_mode_set_damping") {
    machine.force_damping = call.number("damping", 0, kForceDamping);
  } else if (name == "freedrive_mode" || name == "teach_mode") {
    machine.freedrive = true;
  } else if (name == "end_freedrive_mode" || name == "end_teach_mode") {
    machine.freedrive = false;
  } else if (name == "rtde_set_watchdog") {
    set_watchdog(call, machine);
  } else {
    return false;
  }
  return true;
}

}  // namespace tactus::ur
