#include "program/results/result_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace tactus {

/// Takes all bytes, also those that cannot be written: the stream would lose the errno.
ssize_t ResultFile::write(void* file, const char* bytes, std::size_t size) {
  ResultFile& self = *static_cast<ResultFile*>(file);
  std::size_t done = 0;
  while (done < size && self.error_ == 0) {
    const ssize_t count = ::write(self.file_, bytes + done, size - done);
    if (count >= 0)
      done += static_cast<std::size_t>(count);
    else if (errno != EINTR)
      self.error_ = errno;
  }
  return static_cast<ssize_t>(size);
}

bool ResultFile::begin_stream() {
  cookie_io_functions_t functions{};
  functions.write = write;
  stream_ = fopencookie(this, "w", functions);
  return stream_ != nullptr;
}

bool ResultFile::open(const char* path) {
  path_ = FilePath(path);
  error_ = 0;
  file_ = ::open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ >= 0 && begin_stream()) return true;
  error_ = errno;
  return close();
}

int ResultFile::finish() {
  if (stream_ != nullptr) std::fclose(stream_);
  stream_ = nullptr;
  if (file_ >= 0 && ::close(file_) != 0 && error_ == 0) error_ = errno;
  file_ = -1;
  return error_;
}

bool ResultFile::close(const char* extent) {
  const int error = finish();
  if (error == 0) return true;
  std::fprintf(stderr, "%s: %s%s; make room or choose another %s\n", path_.c_str(),
               std::strerror(error), extent, option_);
  return false;
}

}  // namespace tactus
