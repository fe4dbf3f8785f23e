#include "program/host/cyclictest.hpp"

#include <sys/wait.h>

#include <array>
#include <cstdio>

#include "hal/os/small_file.hpp"
#include "program/host/shell.hpp"

namespace tactus {
namespace {

constexpr int kHistogram_us = 20000;  // a longer latency counts as the maximum

bool take_prefix(std::string_view& text, std::string_view prefix) {
  if (text.substr(0, prefix.size()) != prefix) return false;
  text.remove_prefix(prefix.size());
  return true;
}

}  // namespace

Text<255> cyclictest_command(const CyclictestSettings& settings) {
  Text<255> command("cyclictest -q -m -t1 -h ");
  command << kHistogram_us << " -i " << settings.period_us << " -l " << settings.cycles;
  if (settings.priority > 0) command << " -p " << settings.priority;
  if (settings.cpu >= 0) command << " -a " << settings.cpu;
  command << " 2>&1";
  return command;
}

void CyclictestOutput::read_line(std::string_view line) {
  while (!line.empty() && (line.back() == '\n' || line.back() == ' ')) line.remove_suffix(1);
  if (line.empty()) return;
  int count = 0, value_us = 0;
  if (take_prefix(line, "# Max Latencies: ")) {
    max_us_ = leading_int(line);
  } else if (take_prefix(line, "# Histogram Overflows: ")) {
    count = leading_int(line);
    value_us = max_us_;
  } else if (line.front() >= '0' && line.front() <= '9') {
    const std::size_t blank = line.find(' ');
    value_us = leading_int(line);
    count = blank == std::string_view::npos ? -1 : leading_int(line.substr(blank + 1));
  } else if (line.front() != '#' && complaint_.empty()) {
    complaint_ << line;
  }
  for (int i = 0; i < count; ++i) latency_.add(static_cast<std::uint64_t>(value_us) * 1000);
}

bool run_cyclictest(const CyclictestSettings& settings, Histogram& latency, Text<127>& complaint) {
  std::FILE* pipe = popen(cyclictest_command(settings).c_str(), "r");
  if (pipe == nullptr) {
    complaint << "cannot start a process";
    return false;
  }
  CyclictestOutput output(latency);
  std::array<char, 256> line;
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) output.read_line(line.data());
  const int status = pclose(pipe);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  if (code == 0 && latency.count() > 0) return true;
  if (code == kProgramNotFound)
    complaint << "not installed (Debian: rt-tests)";
  else
    complaint << "failed: "
              << (output.complaint().empty() ? "no reason given" : output.complaint().c_str());
  return false;
}

}  // namespace tactus
