// SmallFile: a file of /proc or /sys, read whole into fixed memory.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace tactus {

class SmallFile {
 public:
  /// Reads the file, at most 8 KiB of it. False: it cannot be read, and error() says why. [init]
  bool read(const char* path);
  /// The errno of the last read(); 0 if it succeeded.
  int error() const { return error_; }
  /// What was read, without the blanks and line ends behind it.
  std::string_view text() const { return {bytes_.data(), size_}; }
  /// What follows `key` on the first line that begins with it, without blanks around; empty if
  /// there is no such line.
  std::string_view line(std::string_view key) const;

 private:
  std::array<char, 8192> bytes_{};
  std::size_t size_ = 0;
  int error_ = 0;
};

/// Whether a list of CPUs as the kernel prints it, "0-3,5", has `cpu` in it. [init]
bool lists_cpu(std::string_view list, int cpu);

/// The whole number a text begins with; -1 if it begins with none or with one of more than nine
/// digits. [init]
int leading_int(std::string_view text);

/// The text up to its first blank.
std::string_view first_word(std::string_view text);

}  // namespace tactus
