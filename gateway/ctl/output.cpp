#include "gateway/ctl/output.hpp"

#include <google/protobuf/util/json_util.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "kernel/core/status.hpp"
#include "kernel/cycle/rung.hpp"
#include "kernel/reference/motion/motion_phase.hpp"

namespace tactus::ctl {
namespace {

constexpr std::uint32_t kFirstOfCycle = 64;  // statuses of the cycle and of the wire, up to 109
constexpr std::uint32_t kLastOfWire = 109;

template <class E>
std::string name_or_number(std::uint32_t value) {
  return value < kNames<E>.size() ? kNames<E>[value] : std::to_string(value);
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

void Output::result(const Report& report) {
  object("result", report);
  std::string line = name_of(report.outcome());
  if (report.stretch() > 0.0)
    line += formatted("; slowed down by %.2g %% to keep limits", report.stretch() * 100.0);
  if (!report.text().empty()) line += ": " + printed(report.text());
  if (report.status() >= kFirstOfCycle && report.status() <= kLastOfWire)
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
  std::string name = Report::Outcome_Name(outcome);
  std::transform(name.begin(), name.end(), name.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  return name;
}

std::string phase_name(std::uint32_t phase) {
  return name_or_number<Phase>(phase);
}

std::string rung_name(std::uint32_t rung) {
  return name_or_number<Rung>(rung);
}

std::string status_name(std::uint32_t status) {
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
