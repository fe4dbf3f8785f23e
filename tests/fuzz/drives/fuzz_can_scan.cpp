// Fuzzes a scan of a bus: whatever frames come, it ends, and it only reads.
#include <memory>

#include "hal/can/node_scan.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace {

using namespace tactus::can;

constexpr std::int64_t kMs_ns = 1'000'000;

void check(const NodeScan& scan) {
  int present = 0;
  for (int node = 1; node <= kMaxNode; ++node) {
    const NodeReport& report = scan.report(node);
    present += report.present() ? 1 : 0;
    MUST(report.history_count >= 0 && report.history_count <= NodeReport::kMostHistory);
    for (const NodeReport::Label& label : report.labels)
      for (const char c : std::string_view(label)) MUST(c >= ' ' && c <= '~');
    MUST(report.present() || report.known == 0);
  }
  MUST(present == scan.count());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const auto scan = std::make_unique<NodeScan>();
  const ScanTimes times;
  std::int64_t now_ns = 0;
  std::uint16_t asked = 0;  // the last request's identifier
  std::array<std::uint8_t, kMaxData> question{};
  scan->begin(times, now_ns);
  std::size_t at = 0;
  while (scan->advance(now_ns)) {
    CanFrame request;
    while (scan->take(request)) {
      const int specifier = request.data[0] & kSpecifier;
      MUST(request.id > kSdoRequestBase && request.id <= kSdoRequestBase + kMaxNode);
      MUST(specifier == kUpload || specifier == kUploadSegment || specifier == kAbort);
      asked = request.id;
      question = request.data;
    }
    // Each record: the kind of a frame, then its bytes; an answer names the object of its question.
    if (at < size) {
      const std::uint8_t kind = data[at++];
      CanFrame frame;
      frame.size = 8;
      frame.remote = kind == 0xFF;
      for (std::size_t i = 0; i < 8 && at < size; ++i) frame.data[i] = data[at++];
      if (kind < 0xC0) {
        frame.id = static_cast<std::uint16_t>(asked - kSdoRequestBase + kSdoAnswerBase);
        if (kind < 0x80) std::copy_n(question.begin() + 1, 3, frame.data.begin() + 1);
      } else {
        frame.id = load<std::uint16_t>(frame.data, 0) & 0x7FF;
        frame.size = kind & 0x0F;
      }
      if (asked != 0) scan->receive(frame, now_ns);
    }
    now_ns += at < size ? kMs_ns : 20 * kMs_ns;
    MUST(now_ns <= times.whole_ns + times.listen_ns);
  }
  check(*scan);
  return 0;
}
