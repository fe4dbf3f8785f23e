// Output: what the verbs say, to people or, with --json, to scripts: one object per line on
// standard output.
#pragma once

#include <google/protobuf/message.h>
#include <tactus.pb.h>

#include <string>

namespace tactus::ctl {

class Output {
 public:
  explicit Output(bool json) : json_(json) {}

  bool json() const { return json_; }
  /// One line for people, on standard output; nothing with --json.
  void say(const std::string& text);
  /// One line for scripts: {"kind":{...}}; nothing without --json.
  void object(const char* kind, const google::protobuf::Message& message);
  /// An error: place, reason and what to do, for people and scripts.
  void error(const std::string& text, int exit_code);
  /// The end of a verb.
  /// `advises`: how to go on if the arm has stopped.
  void result(const Report& report, bool advises = true);
  /// Shows a line that the next one replaces, on a terminal; nothing elsewhere.
  void progress(const std::string& line);
  /// Ends the line that progress() shows.
  void end_progress();

 private:
  bool json_;
  bool showing_ = false;
};

/// Returns "succeeded", "refused", ...
std::string name_of(Report::Outcome outcome);
/// Returns the name of a phase or a rung as the kernel has it; a number if it is none.
std::string phase_name(Phase phase);
std::string rung_name(Rung rung);
/// Returns the meaning of a code, and its number.
std::string status_name(Code status);
/// Returns a number in printf's format.
std::string formatted(const char* format, double value);
/// Returns a text without what must not reach a terminal.
std::string printed(const std::string& text);

}  // namespace tactus::ctl
