#include "program/results/figure.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>

#include "program/session/files.hpp"

extern char** environ;

namespace tactus {
namespace {

/// Finds scripts/figure in the tree this program was built in; the program is build/<board>/tactus.
bool find_script(FilePath& script) {
  char program[512];
  const ssize_t size = readlink("/proc/self/exe", program, sizeof program);
  if (size <= 0) return false;
  std::string_view root(program, static_cast<std::size_t>(size));
  for (int i = 0; i < 3; ++i) root = root.substr(0, root.rfind('/'));
  script = FilePath(root);
  script << "/scripts/figure";
  return access(script.c_str(), X_OK) == 0;
}

}  // namespace

void draw_figure(const char* folder) {
  FilePath script;
  if (!find_script(script)) {
    std::fprintf(stderr, "no figure: scripts/figure is not next to build/\n");
    return;
  }
  FilePath argument(folder);
  char* const arguments[] = {const_cast<char*>(script.c_str()), const_cast<char*>(argument.c_str()),
                             nullptr};
  pid_t child = 0;
  int status = 0;
  if (posix_spawn(&child, script.c_str(), nullptr, nullptr, arguments, environ) != 0 ||
      waitpid(child, &status, 0) != child || status != 0)
    std::fprintf(stderr, "no figure: scripts/figure failed\n");
}

}  // namespace tactus
