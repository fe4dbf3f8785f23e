#include "program/results/run_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace tactus {
namespace {

constexpr const char* kResults[] = {"summary.json", "scene.json", "waypoints.csv", "log.csv",
                                    "figure.png",   "figure.pdf", "figure.svg"};

/// Keeps other runs out of the folder until this program ends. False: errno is the reason.
bool lock(std::string_view folder) {
  const int file = open(FilePath(folder).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  return file >= 0 && flock(file, LOCK_EX | LOCK_NB) == 0;
}

bool write_text(const FilePath& path, std::string_view text) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return false;
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  return std::fclose(file) == 0 && written;
}

}  // namespace

FilePath in_folder(std::string_view folder, const char* file) {
  FilePath path = folder;
  path << "/" << file;
  return path;
}

bool begin_folder(std::string_view folder, std::string_view pipeline) {
  if (!make_folder(folder)) return false;
  FilePath path = folder;
  if (!lock(folder)) {
    const bool taken = errno == EWOULDBLOCK;
    std::fprintf(
        stderr, "%s: %s\n", path.c_str(),
        taken ? "another run writes into this folder; wait for its end, or choose another --out"
              : std::strerror(errno));
    return false;
  }
  for (const char* name : kResults) {
    path = in_folder(folder, name);
    if (unlink(path.c_str()) == 0 || errno == ENOENT) continue;
    std::fprintf(stderr, "%s: %s\n", path.c_str(), std::strerror(errno));
    return false;
  }
  path = in_folder(folder, "pipeline.ini");
  if (write_text(path, pipeline)) return true;
  std::fprintf(stderr, "%s: %s\n", path.c_str(), std::strerror(errno));
  return false;
}

}  // namespace tactus
