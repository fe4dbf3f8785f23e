#include "program/results/run_log.hpp"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>

#include "kernel/load/ini.hpp"

namespace tactus {
namespace {

constexpr std::size_t kNumberLength = 32;  // fits the shortest text that gives the same double

}  // namespace

Text<2 * kMaxNameLength + 16> column_name(const PortEntry& port, int number) {
  std::string_view words = info(port.quantity).components, word;
  for (int i = 0; i <= number; ++i) word = take_word(words);
  Text<2 * kMaxNameLength + 16> column(port.block);
  column << "." << port.port << "_";
  return word.empty() ? column << number + 1 : column << word;
}

void write_names(std::FILE* file, const PortEntry& port) {
  for (int i = 0; i < info(port.quantity).recorded; ++i)
    std::fprintf(file, ",%s", column_name(port, i).c_str());
}

bool RunLog::open(const char* path, const Recording& recording) {
  file_ = std::fopen(path, "wb");
  if (file_ == nullptr) {
    std::fprintf(stderr, "%s: %s\n", path, std::strerror(errno));
    return false;
  }
  width_ = recording.width();
  std::fprintf(file_, "time_s");
  for (int i = 0; i < recording.signal_count; ++i) {
    write_names(file_, *recording.signals[static_cast<std::size_t>(i)]);
  }
  std::fprintf(file_, "\n");
  return true;
}

void RunLog::drain(Recorder& recorder) {
  while (recorder.take(row_.data())) write_row(row_.data());
}

void RunLog::write_row(const double* row) {
  std::array<char, kMaxWidth * kNumberLength> text;
  char* to = text.data();
  for (std::size_t i = 0; i < width_; ++i) {
    if (i > 0) *to++ = ',';
    to = std::to_chars(to, text.data() + text.size(), row[i]).ptr;
  }
  *to++ = '\n';
  std::fwrite(text.data(), 1, static_cast<std::size_t>(to - text.data()), file_);
}

bool RunLog::close() {
  const bool failed = std::ferror(file_) != 0;
  return std::fclose(file_) == 0 && !failed;
}

}  // namespace tactus
