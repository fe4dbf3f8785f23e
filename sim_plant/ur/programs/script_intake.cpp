#include "sim_plant/ur/programs/script_intake.hpp"

namespace tactus::ur {

bool ScriptIntake::next(std::size_t& used, std::string_view& piece) {
  for (;;) {
    const std::string_view rest(text_.data() + scanned_, size_ - scanned_);
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) return false;
    const std::string_view line = rest.substr(0, end);
    scanned_ += end + 1;
    const std::string_view word = leading_name(line);
    const bool whole = trimmed(without_comment(line)) == "end" && word == "end";
    if (word == "def" || word == "sec") ++depth_;
    if (depth_ > 0) {
      if (word == "while" || word == "if" || word == "thread") ++depth_;
      if (!whole || --depth_ > 0) continue;
    }
    piece = std::string_view(text_.data() + used, scanned_ - used);
    used = scanned_;
    const bool dropped = dropping_;
    dropping_ = false;
    if (!dropped && !trimmed(without_comment(piece)).empty()) return true;
  }
}

void ScriptIntake::drop() {
  dropping_ = true;
  if (scanned_ == 0) {
    text_[0] = ' ';
    size_ = 1;
    return;
  }
  std::memmove(text_.data(), text_.data() + scanned_, size_ - scanned_);
  size_ -= scanned_;
  scanned_ = 0;
}

bool run_direct_command(std::string_view line, Runner& runner, Machine& machine) {
  line = trimmed(without_comment(line));
  double fraction = 0.0;
  if (line == "power on") {
    machine.power.switch_on();
  } else if (line == "power off") {
    runner.stop(machine);
    machine.power.switch_off();
  } else if (line == "set robotmode run") {
    machine.power.release_brakes();
  } else if (line == "set unlock protective stop") {
    machine.safety.unlock_soon();
  } else if (line == "stop program") {
    runner.stop(machine);
  } else if (line == "protective_stop()") {
    machine.protective_stop({Code::kFromScript, 0});
  } else if (number_after(line, "set speed ", fraction)) {
    machine.io.speed_fraction = std::clamp(fraction, 0.0, 1.0);
  } else {
    return line == "run program";
  }
  return true;
}

}  // namespace tactus::ur
