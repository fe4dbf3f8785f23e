// LineReader: the lines of a file, pipe or device, through a buffer of fixed size, with the hash of
// all bytes that were read.
#pragma once

#include <sys/stat.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace tactus {

class LineReader {
 public:
  static constexpr std::size_t kLongest = 4096;  ///< of a line, in bytes

  enum class Result : std::uint8_t {
    kLine,
    kEnd,      // there are no more lines
    kNotYet,   // a pipe had no whole line within the time to wait
    kTooLong,  // the line is longer than kLongest
    kFailed,   // see errno
  };

  LineReader() = default;
  ~LineReader() { close(); }
  LineReader(const LineReader&) = delete;
  LineReader& operator=(const LineReader&) = delete;

  /// Opens a file; the hash of its bytes continues `hash`. Waits for the writer of a named pipe.
  /// False: see errno. [init]
  bool open(const char* path, std::uint64_t hash);
  void close();
  /// Returns to the first line; only of a regular file. False: see errno. [init]
  bool rewind();

  /// Takes the next line, without its end; it stays until the next call. Waits for a pipe at most
  /// `wait_ms`, or until it has a line or is closed if that is negative. [any, not cyclic]
  Result next(std::string_view& line, int wait_ms);

  /// True for a file that can be read twice.
  bool regular() const { return S_ISREG(opened_.st_mode); }
  /// True while size and time of the last change are those with which the file was opened. [any,
  /// not cyclic]
  bool unchanged() const;
  /// Lines taken so far: the number of the last one.
  int line() const { return line_; }
  /// Hash (FNV-1a) of the bytes that were read: of the whole file after kEnd.
  std::uint64_t hash() const { return hash_; }

 private:
  static constexpr std::size_t kBuffer = 1 << 16;
  static_assert(kBuffer > kLongest, "a line fits");

  Result fill(int wait_ms);

  int file_ = -1;
  struct stat opened_ = {};
  std::array<char, kBuffer> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // of the bytes that were read and not yet taken
  bool all_read_ = false;
  int line_ = 0;
  std::uint64_t first_hash_ = 0, hash_ = 0;
};

}  // namespace tactus
