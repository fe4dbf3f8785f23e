#include "program/results/run_log.hpp"

#include <charconv>
#include <cinttypes>
#include <string_view>

#include "kernel/load/ini.hpp"
#include "program/results/run_recording.hpp"

namespace tactus {
namespace {

constexpr std::size_t kNumberLength = 32;  // fits the shortest text that gives the same double

/// Returns the number of whole rows below the header of the file at `path`.
std::int64_t count_rows(const char* path) {
  std::FILE* file = std::fopen(path, "rb");
  std::int64_t lines = 0;
  for (int c = 0; file != nullptr && (c = std::getc(file)) != EOF;) lines += c == '\n' ? 1 : 0;
  if (file != nullptr) std::fclose(file);
  return lines > 0 ? lines - 1 : 0;
}

Status record(void* recorder, const RobotState&, double time_s) {
  static_cast<Recorder*>(recorder)->record(time_s);
  return Status::kOk;  // a full ring drops the row and counts it
}

}  // namespace

void start_recorder(Recorder& recorder, Pipeline& pipeline) {
  recorder.start(pipeline.recording);
  pipeline.schedule.bind("recorder", record, &recorder);
}

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
  if (!file_.open(path)) return false;
  width_ = recording.width();
  std::fprintf(file_.stream(), "time_s");
  for (int i = 0; i < recording.signal_count; ++i) {
    write_names(file_.stream(), *recording.signals[static_cast<std::size_t>(i)]);
  }
  std::fprintf(file_.stream(), "\n");
  return true;
}

void RunLog::drain(Recorder& recorder) {
  while (recorder.take(row_.data())) {
    if (file_.stream() != nullptr) write_row(row_.data());
    if (recording_ != nullptr) recording_->write_row(row_.data());
  }
  if (recording_ != nullptr) recording_->write_events();
}

void RunLog::write_row(const double* row) {
  if (rows_ == most_) {
    ++left_out_;
    return;
  }
  std::array<char, kMaxWidth * kNumberLength> text;
  char* to = text.data();
  for (std::size_t i = 0; i < width_; ++i) {
    if (i > 0) *to++ = ',';
    to = std::to_chars(to, text.data() + text.size(), row[i]).ptr;
  }
  *to++ = '\n';
  std::fwrite(text.data(), 1, static_cast<std::size_t>(to - text.data()), file_.stream());
  ++rows_;
}

bool RunLog::close() {
  if (file_.finish() == 0) return true;
  char extent[96];
  std::snprintf(extent, sizeof extent, " after %" PRId64 " of %" PRId64 " rows",
                count_rows(file_.path().c_str()), rows_);
  return file_.close(extent);
}

}  // namespace tactus
