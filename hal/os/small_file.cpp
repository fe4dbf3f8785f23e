#include "hal/os/small_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace tactus {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return {};
  text.remove_prefix(begin);
  text.remove_suffix(text.size() - 1 - text.find_last_not_of(kBlanks));
  return text;
}

}  // namespace

bool SmallFile::read(const char* path) {
  size_ = 0;
  const int file = open(path, O_RDONLY | O_CLOEXEC);
  error_ = file < 0 ? errno : 0;
  if (file < 0) return false;
  ssize_t got = 1;
  while (got > 0 && size_ < bytes_.size()) {
    got = ::read(file, bytes_.data() + size_, bytes_.size() - size_);
    if (got > 0) size_ += static_cast<std::size_t>(got);
  }
  error_ = got < 0 ? errno : 0;
  close(file);
  if (got < 0) size_ = 0;
  while (size_ > 0 && kBlanks.find(bytes_[size_ - 1]) != std::string_view::npos) --size_;
  return got >= 0;
}

std::string_view SmallFile::line(std::string_view key) const {
  std::string_view rest = text();
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    if (line.substr(0, key.size()) == key) return trimmed(line.substr(key.size()));
    rest.remove_prefix(line.size() < rest.size() ? line.size() + 1 : rest.size());
  }
  return {};
}

int leading_int(std::string_view text) {
  constexpr std::size_t kMostDigits = 9;
  int value = 0;
  std::size_t digits = 0;
  for (; digits < text.size() && text[digits] >= '0' && text[digits] <= '9'; ++digits) {
    if (digits == kMostDigits) return -1;
    value = 10 * value + (text[digits] - '0');
  }
  return digits > 0 ? value : -1;
}

std::string_view first_word(std::string_view text) {
  return text.substr(0, text.find_first_of(kBlanks));
}

bool lists_cpu(std::string_view list, int cpu) {
  while (!list.empty()) {
    const std::string_view part = list.substr(0, list.find(','));
    const std::size_t dash = part.find('-');
    const int first = leading_int(part);
    const int last = dash != std::string_view::npos ? leading_int(part.substr(dash + 1)) : first;
    if (first >= 0 && cpu >= first && cpu <= last) return true;
    list.remove_prefix(part.size() < list.size() ? part.size() + 1 : list.size());
  }
  return false;
}

}  // namespace tactus
