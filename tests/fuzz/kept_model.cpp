// MuJoCo compiles the arm once; every controller after the first gets a copy. The linker's --wrap
// leads the call here.
#include <mujoco/mujoco.h>

extern "C" {
mjModel* __real_mj_loadXML(const char* name, const mjVFS* files, char* error, int size);
mjModel* __wrap_mj_loadXML(const char* name, const mjVFS* files, char* error, int size);
}

mjModel* __wrap_mj_loadXML(const char* name, const mjVFS* files, char* error, int size) {
  static mjModel* const kept = __real_mj_loadXML(name, files, error, size);
  return kept != nullptr ? mj_copyModel(nullptr, kept) : nullptr;
}
