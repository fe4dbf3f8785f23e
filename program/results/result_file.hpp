// ResultFile: a file of a run while it is written. The first error is kept, and nothing is written
// after it, so that the file is a beginning of what it was to be.
#pragma once

#include <sys/types.h>

#include <cstdio>

#include "program/session/files.hpp"

namespace tactus {

class ResultFile {
 public:
  /// `option` of the command line chooses another place for the file.
  explicit ResultFile(const char* option = "--out") : option_(option) {}
  ~ResultFile() { finish(); }
  ResultFile(const ResultFile&) = delete;
  ResultFile& operator=(const ResultFile&) = delete;

  /// Creates or truncates the file at `path`. False: prints the reason to stderr.
  bool open(const char* path);
  /// The stream to write to; close() finds what could not be written.
  std::FILE* stream() const { return stream_; }
  const FilePath& path() const { return path_; }

  /// Closes the file; returns the first errno of open(2), write(2) or close(2), or 0.
  int finish();
  /// Closes the file. False if anything could not be written: prints which file and why, and
  /// between them `extent`, its progress.
  bool close(const char* extent = "");

 private:
  static ssize_t write(void* file, const char* bytes, std::size_t size);
  bool begin_stream();

  const char* option_;
  FilePath path_;
  int file_ = -1;
  int error_ = 0;
  std::FILE* stream_ = nullptr;
};

}  // namespace tactus
