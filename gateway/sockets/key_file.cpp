#include "gateway/sockets/key_file.hpp"

#include <fcntl.h>
#include <sodium.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace tactus {
namespace {

bool parse(const char* digits, std::size_t size, Key& key) {
  std::size_t count = 0;
  const char* end = nullptr;
  const bool read =
      sodium_hex2bin(key.data(), key.size(), digits, size, nullptr, &count, &end) == 0;
  while (read && end < digits + size && (*end == '\n' || *end == '\r')) ++end;
  return read && count == key.size() && end == digits + size;
}

/// Reads from an open file, so that what is judged is what is read.
bool read_open(int file, Key& key, Message& why) {
  struct stat found {};
  if (fstat(file, &found) != 0 || !S_ISREG(found.st_mode)) {
    why << "it is no regular file";
    return false;
  }
  if (found.st_uid != geteuid() || (found.st_mode & 077) != 0) {
    why << "others may read it: make it yours, then chmod 600";
    return false;
  }
  std::array<char, 2 * 32 + 16> digits;
  const ssize_t size = ::read(file, digits.data(), digits.size());
  const bool good = size > 0 && parse(digits.data(), static_cast<std::size_t>(size), key);
  sodium_memzero(digits.data(), digits.size());
  if (!good) why << "it does not hold 64 hexadecimal digits; openssl rand -hex 32 makes them";
  return good;
}

}  // namespace

bool read_key(const char* path, Key& key, Message& why) {
  why << path << ": ";
  const int file = ::open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) {
    why << std::strerror(errno);
    return false;
  }
  const bool read = read_open(file, key, why);
  ::close(file);
  return read;
}

}  // namespace tactus
