#include "gateway/ctl/output.hpp"

#include <google/protobuf/util/json_util.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "kernel/core/status.hpp"

namespace tactus::ctl {
namespace {

constexpr int kFirstOfCycle = 64;  // codes of the cycle and of the wire, up to 109
constexpr int kLastOfWire = 109;

/// Returns an enumerator without its prefix, in small letters.
std::string word(const std::string& enumerator, std::size_t prefix) {
  std::string text = enumerator.substr(std::min(prefix, enumerator.size()));
  std::transform(text.begin(), text.end(), text.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return text;
}

std::string json_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : printed(text)) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "\"";
}

}  // namespace

void Output::say(const std::string& text) {
  end_progress();
  if (json_) return;
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);
}

void Output::object(const char* kind, const google::protobuf::Message& message) {
  if (!json_) return;
  google::protobuf::util::JsonPrintOptions form;
  form.always_print_primitive_fields = true;
  form.preserve_proto_field_names = true;
  std::string text;
  if (!google::protobuf::util::MessageToJsonString(message, &text, form).ok()) text = "{}";
  std::printf("{\"%s\":%s}\n", kind, text.c_str());
  std::fflush(stdout);
}

void Output::error(const std::string& text, int exit_code) {
  end_progress();
  std::fprintf(stderr, "tactusctl: %s\n", printed(text).c_str());
  if (!json_) return;
  std::printf("{\"error\":{\"text\":%s,\"exit\":%d}}\n", json_text(text).c_str(), exit_code);
  std::fflush(stdout);
}

void Output::result(const Report& report, bool advises) {
  object("result", report);
  std::string line = name_of(report.outcome());
  if (report.stretch() > 0.0)
    line += formatted("; slowed down by %.2g %% to keep limits", report.stretch() * 100.0);
  if (!report.text().empty()) line += ": " + printed(report.text());
  if (advises && report.status() >= kFirstOfCycle && report.status() <= kLastOfWire)
    line += "; tactusctl watch shows the arm, tactusctl rearm takes it over again";
  say(line);
}

void Output::progress(const std::string& line) {
  if (json_ || isatty(STDERR_FILENO) == 0) return;
  std::fprintf(stderr, "\r%s\x1b[K", line.c_str());
  showing_ = true;
}

void Output::end_progress() {
  if (showing_) std::fputc('\n', stderr);
  showing_ = false;
}

std::string name_of(Report::Outcome outcome) {
  return word(Report::Outcome_Name(outcome), 0);
}

std::string phase_name(Phase phase) {
  const std::string name = Phase_Name(phase);
  return name.empty() ? std::to_string(phase) : word(name, std::strlen("PHASE_"));
}

std::string rung_name(Rung rung) {
  const std::string name = Rung_Name(rung);
  return name.empty() ? std::to_string(rung) : word(name, std::strlen("RUNG_"));
}

std::string status_name(Code status) {
  return std::string(meaning(static_cast<Status>(status))) + " (" + std::to_string(status) + ")";
}

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string printed(const std::string& text) {
  std::string safe = text;
  for (char& c : safe)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return safe;
}

}  // namespace tactus::ctl
