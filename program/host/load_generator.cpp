#include "program/host/load_generator.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <initializer_list>

#include "program/host/shell.hpp"

namespace tactus {
namespace {

/// The command line of stress-ng.
class Command {
 public:
  void add(std::initializer_list<const char*> words) {
    for (const char* word : words)
      if (count_ + 1 < words_.size()) words_[count_++] = const_cast<char*>(word);
  }
  char* const* words() const { return words_.data(); }

 private:
  std::array<char*, 24> words_{};  // ends with a null
  std::size_t count_ = 0;
};

/// Becomes a silent program that ends with the one that started it.
[[noreturn]] void become(char* const* words) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  const int nothing = open("/dev/null", O_WRONLY);
  dup2(nothing, STDOUT_FILENO);
  dup2(nothing, STDERR_FILENO);
  execvp(words[0], words);
  _exit(kProgramNotFound);
}

/// Returns the process, or -1 and fills in the reason.
pid_t start_process(const Command& command, Text<127>& complaint) {
  const pid_t process = fork();
  if (process == 0) become(command.words());
  if (process < 0) complaint << "stress-ng cannot be started: " << std::strerror(errno);
  return process;
}

/// Returns the exit code of a process that has ended.
int exit_code(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

Text<31> names_of(const Load& load) {
  Text<31> names;
  if (load.cpu) names << "cpu";
  if (load.memory) names << (names.empty() ? "memory" : ", memory");
  if (load.disk) names << (names.empty() ? "disk" : ", disk");
  return names;
}

LoadGenerator::~LoadGenerator() {
  Text<127> ignored;
  stop(ignored);
}

bool LoadGenerator::installed(Text<127>& complaint) {
  int status = 0;
  Command command;
  command.add({"stress-ng", "--version"});
  const pid_t process = start_process(command, complaint);
  if (process < 0 || waitpid(process, &status, 0) != process) return false;
  const int code = exit_code(status);
  if (code == kProgramNotFound)
    complaint << "stress-ng is not there: install stress-ng (Debian: apt-get install stress-ng)";
  else if (code != 0)
    complaint << "stress-ng --version: exit code " << code;
  return code == 0;
}

/// Loads every CPU, the memory beyond any cache, and the disk of the present folder.
bool LoadGenerator::start(const Load& load, Text<127>& complaint) {
  constexpr timespec kBegin = {1, 0};  // its processes are started and have their memory
  Command command;
  command.add({"stress-ng", "--quiet", "--timeout", "0"});  // none
  if (load.cpu) command.add({"--cpu", "0"});                // one for each CPU
  if (load.memory) command.add({"--vm", "1", "--vm-bytes", "10%"});
  if (load.disk) command.add({"--hdd", "1", "--hdd-bytes", "128m"});
  process_ = start_process(command, complaint);
  if (process_ >= 0) nanosleep(&kBegin, nullptr);
  return process_ >= 0;
}

bool LoadGenerator::stop(Text<127>& complaint) {
  if (process_ < 0) return true;
  int status = 0;
  const bool ended = waitpid(process_, &status, WNOHANG) == process_;
  if (ended) {
    complaint << "stress-ng ended before the measurement: exit code " << exit_code(status);
  } else {
    kill(process_, SIGTERM);
    waitpid(process_, &status, 0);
  }
  process_ = -1;
  return !ended;
}

}  // namespace tactus
