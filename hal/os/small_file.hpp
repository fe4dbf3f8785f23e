// SmallFile: reads a file of /proc or /sys into fixed memory.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace tactus {

class SmallFile {
 public:
  /// Reads the file, at most 8 KiB of it. False: it cannot be read, and error() has the reason.
  /// [init]
  bool read(const char* path);
  /// The errno of the last read(); 0 if it succeeded.
  int error() const { return error_; }
  /// The content without trailing blanks and line ends.
  std::string_view text() const { return {bytes_.data(), size_}; }
  /// Returns the text after `key` on the first line that begins with it, without blanks around;
  /// empty if there is no such line.
  std::string_view line(std::string_view key) const;

 private:
  std::array<char, 8192> bytes_{};
  std::size_t size_ = 0;
  int error_ = 0;
};

/// True if a list of CPUs as the kernel prints it, "0-3,5", contains `cpu`. [init]
bool lists_cpu(std::string_view list, int cpu);

/// Returns the whole number at the beginning of a text; -1 if there is none or it has more than
/// nine digits. [init]
int leading_int(std::string_view text);

/// Returns the text up to its first blank.
std::string_view first_word(std::string_view text);

}  // namespace tactus
