// Starts the board's program as a user does, and reads its output and its files. Tests run from the
// root of the project, after the program has been built.
#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>

#include "kernel/core/text.hpp"
#include "tests/support/testing.hpp"

extern char** environ;

namespace tactus {

using Line = Text<1023>;

inline char program[PATH_MAX];
inline char scratch[] = "/tmp/tactus-program-XXXXXX";  // for everything these tests write

inline constexpr const char* kPipeline =
    "[robot]\nname = fer\nperiod_us = 1000\ntau_c = pd.tau\n"
    "[plant]\nposition_noise_rad = 1e-4\nvelocity_noise_rad_s = 1e-3\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n"
    "kp = 500 400 400 300 20 20 10\nkd = 50 40 40 5 2 2 1\n"
    "[recorder]\ndivisor = 10\ntracking = jrg.q_d robot.q\n";
/// Tolerates what a busy host does to a run in real time: late cycles, overruns, and a second
/// without a cycle. The arm is armed before a client has joined.
inline constexpr const char* kBusyHost =
    "[executive]\nmax_slip = 1000\nmax_late = 16\nlate_window = 1\nmax_overruns = 16\n"
    "overrun_window = 1\nrest_ms = 10\n";
/// The pipeline of a server: slow, and a goal is reached though the arm lags.
inline constexpr const char* kServed =
    "[robot]\nname = fer\nperiod_us = 4000\ntau_c = pd.tau\n"
    "[model]\ntype = robot_model\nq = robot.q\ndq = robot.dq\n"
    "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
    "goal_tolerance = 0.2\nstopped_velocity = 0\n"
    "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\ng = model.g\n"
    "kp = 500 400 400 300 20 20 10\nkd = 50 40 40 5 2 2 1\n";
inline constexpr const char* kWithoutGenerator =
    "[robot]\nname = fer\nperiod_us = 1000\ntau_c = robot.tau\n";
inline constexpr const char* kHeader = "time_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,q7_rad\n";
/// The ready pose, the arm's initial position.
inline constexpr const char* kReady = "0.02,0,-0.785398,0,-2.356194,0,1.570796,0.785398\n";

inline Line in_folder(const char* name) {
  Line path(scratch);
  path << "/" << name;
  return path;
}

inline Line write(const char* name, std::initializer_list<const char*> texts) {
  const Line path = in_folder(name);
  std::FILE* file = std::fopen(path.c_str(), "wb");
  assert_non_null(file);
  for (const char* text : texts) std::fputs(text, file);
  std::fclose(file);
  return path;
}

struct Content {
  std::array<char, 1 << 22> bytes;  // fits a report
  std::string_view text;
};

inline std::string_view content(const char* path, Content& to) {
  std::FILE* file = std::fopen(path, "rb");
  to.text = {};
  if (file == nullptr) return {};
  to.text = {to.bytes.data(), std::fread(to.bytes.data(), 1, to.bytes.size(), file)};
  std::fclose(file);
  return to.text;
}

/// Starts the program in the present folder; its output goes to the files "out" and "err".
inline pid_t spawn(std::initializer_list<const char*> arguments) {
  std::array<char*, 16> words{program};
  std::size_t count = 1;
  for (const char* word : arguments) words[count++] = const_cast<char*>(word);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  constexpr int kFlags = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&files, 1, in_folder("out").c_str(), kFlags, 0666);
  posix_spawn_file_actions_addopen(&files, 2, in_folder("err").c_str(), kFlags, 0666);
  sigset_t kills;  // nohup and a shell's & let tests begin without them
  sigemptyset(&kills);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP}) sigaddset(&kills, signal);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigdefault(&attributes, &kills);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
  pid_t child = 0;
  const int failed = posix_spawn(&child, program, &files, &attributes, words.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (failed != 0) print_error("%s: %s; run make all\n", program, std::strerror(failed));
  assert_int_equal(failed, 0);
  return child;
}

inline int exit_code(pid_t child) {
  int status = 0;
  assert_int_equal(waitpid(child, &status, 0), child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

inline int tactus_run(std::initializer_list<const char*> arguments) {
  return exit_code(spawn(arguments));
}

inline std::string_view output() {
  static Content text;
  return content(in_folder("out").c_str(), text);
}
inline std::string_view errors() {
  static Content text;
  return content(in_folder("err").c_str(), text);
}

/// Runs the program for 0.05 s into `name` below the folder.
inline int run_into(const char* name, const char* pipeline, const char* seed = "1",
                    const char* trajectory = nullptr, const char* duration = "0.05") {
  const Line out = in_folder(name);
  if (trajectory == nullptr)
    return tactus_run({"run", pipeline, "--duration", duration, "--no-figure", "--seed", seed,
                       "--out", out.c_str()});
  return tactus_run({"run", pipeline, "--duration", duration, "--no-figure", "--seed", seed,
                     "--out", out.c_str(), "--trajectory", trajectory});
}

/// A file below the folder; the text stays until the next call.
inline std::string_view file_of(const char* name) {
  static Content text;
  return content(in_folder(name).c_str(), text);
}

inline bool has(std::string_view text, std::string_view part) {
  if (text.find(part) != std::string_view::npos) return true;
  std::fprintf(stderr, "'%.*s' is not in\n%.*s\n", static_cast<int>(part.size()), part.data(),
               static_cast<int>(text.size()), text.data());
  return false;
}

inline void assert_has_all(std::string_view text, std::initializer_list<const char*> parts) {
  for (const char* part : parts) assert_true(has(text, part));
}

inline bool exists(const char* name) {
  return access(in_folder(name).c_str(), F_OK) == 0;
}

/// The program is in the parent folder of the tests, build/<board>/tests.
inline bool find_program(const char* test, const char* name) {
  char parent[PATH_MAX + 32];
  if (realpath(test, program) == nullptr) return false;
  *std::strstr(program, "/tests/") = '\0';
  std::snprintf(parent, sizeof parent, "%s/%s", program, name);
  return realpath(parent, program) != nullptr && mkdtemp(scratch) != nullptr;
}

inline int remove_folder(void**) {
  return std::system((Line("rm -r ") << scratch).c_str());
}

/// Runs the tests in a fresh folder for their files; returns the exit code for main().
template <std::size_t N>
int run_program_tests(const char* test, const CMUnitTest (&tests)[N], const char* name = "tactus") {
  if (find_program(test, name)) return cmocka_run_group_tests(tests, nullptr, remove_folder);
  std::fprintf(stderr, "%s: the program is not there; run make all\n", test);
  return 1;
}

/// Runs a shell command with the scratch folder as $S, the project as $R and the program as $P;
/// output() and errors() return its output. Returns the exit code.
inline int shell(const char* command) {
  char root[PATH_MAX];
  assert_non_null(getcwd(root, sizeof root));
  setenv("S", scratch, 1);
  setenv("R", root, 1);
  setenv("P", program, 1);
  unsetenv("MAKEFLAGS");  // of a make that runs the tests
  Text<4095> line("{ ");
  line << command << "; } >" << in_folder("out") << " 2>" << in_folder("err");
  return WEXITSTATUS(std::system(line.c_str()));
}

/// Asserts that a shell command exits with 0; shows what it wrote to standard error otherwise.
inline void assert_succeeds(const char* command) {
  const int code = shell(command);
  if (code != 0) print_error("%.*s\n", static_cast<int>(errors().size()), errors().data());
  assert_int_equal(code, 0);
}

/// The number after `word` in a text.
inline double number_after(std::string_view text, std::string_view word) {
  const std::size_t at = text.find(word);
  assert_true(at != std::string_view::npos);
  return std::atof(std::string(text.substr(at + word.size(), 20)).c_str());
}

}  // namespace tactus
