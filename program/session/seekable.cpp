#include "program/session/seekable.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace tactus {
namespace {

constexpr std::int64_t kMostBytes = std::int64_t{1} << 30;

bool write_all(int file, const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t count = write(file, bytes, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

/// False if not everything could be copied.
bool copy(int from, int to) {
  std::array<char, 65536> buffer;
  for (std::int64_t total = 0; total < kMostBytes;) {
    const ssize_t size = read(from, buffer.data(), buffer.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return size == 0;
    if (!write_all(to, buffer.data(), static_cast<std::size_t>(size))) return false;
    total += size;
  }
  return true;
}

bool can_only_be_read_once(const FilePath& path) {
  struct stat status;
  return stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

}  // namespace

FilePath seekable(const FilePath& path) {
  if (!can_only_be_read_once(path)) return path;
  const int from = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const int to = memfd_create("trajectory", MFD_CLOEXEC);
  const bool copied = from >= 0 && to >= 0 && copy(from, to);
  if (from >= 0) close(from);
  if (!copied) return path;
  FilePath found("/proc/self/fd/");
  return found << to;
}

}  // namespace tactus
