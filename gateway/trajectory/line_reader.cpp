#include "gateway/trajectory/line_reader.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "gateway/fnv1a.hpp"

namespace tactus {

bool LineReader::open(const char* path, std::uint64_t hash) {
  close();
  file_ = ::open(path, O_RDONLY | O_CLOEXEC);
  if (file_ < 0 || fstat(file_, &opened_) != 0) return false;
  begin_ = end_ = 0;
  all_read_ = false;
  line_ = 0;
  first_hash_ = hash_ = hash;
  return true;
}

void LineReader::close() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

bool LineReader::rewind() {
  if (lseek(file_, 0, SEEK_SET) != 0) return false;
  begin_ = end_ = 0;
  all_read_ = false;
  line_ = 0;
  hash_ = first_hash_;
  return true;
}

bool LineReader::unchanged() const {
  struct stat now = {};
  return fstat(file_, &now) == 0 && now.st_size == opened_.st_size &&
         now.st_mtim.tv_sec == opened_.st_mtim.tv_sec &&
         now.st_mtim.tv_nsec == opened_.st_mtim.tv_nsec;
}

LineReader::Result LineReader::next(std::string_view& line, int wait_ms) {
  for (std::size_t searched = 0;;) {
    const std::string_view unread(buffer_.data() + begin_, end_ - begin_);
    const std::size_t found = unread.find('\n', searched);
    const bool whole = found != std::string_view::npos;
    const std::size_t size = whole ? found : unread.size();
    if (size > kLongest) {
      ++line_;
      return Result::kTooLong;
    }
    if (whole || all_read_) {
      if (!whole && unread.empty()) return Result::kEnd;
      line = unread.substr(0, size);
      if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
      begin_ += size + (whole ? 1 : 0);
      ++line_;
      return Result::kLine;
    }
    searched = size;
    const Result filled = fill(wait_ms);
    if (filled != Result::kLine) return filled;
  }
}

/// Reads more bytes behind those that were not yet taken; kLine to look again, whether there are
/// more, no more, or a signal arrived.
LineReader::Result LineReader::fill(int wait_ms) {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  pollfd readable = {file_, POLLIN, 0};
  const int ready = poll(&readable, 1, wait_ms);
  if (ready < 0 && errno == EINTR) return wait_ms < 0 ? Result::kLine : Result::kNotYet;
  if (ready == 0) return Result::kNotYet;
  const ssize_t size = read(file_, buffer_.data() + end_, buffer_.size() - end_);
  if (size < 0) return errno == EINTR ? Result::kLine : Result::kFailed;
  const auto count = static_cast<std::size_t>(size);
  hash_ = fnv1a({buffer_.data() + end_, count}, hash_);
  all_read_ = count == 0;
  end_ += count;
  return Result::kLine;
}

}  // namespace tactus
