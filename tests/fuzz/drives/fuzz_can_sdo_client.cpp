// Fuzzes SDO as the master reads it: a transfer, and the frames and pauses of a bus.
#include "hal/can/protocol_canopen.hpp"
#include "hal/can/sdo_client.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace {

using namespace tactus;
using namespace tactus::can;

constexpr std::int64_t kMs_ns = 1'000'000;
constexpr std::uint8_t kNode = 3;

/// Frames that the client may have sent since the last one was received: the next request, or an
/// abort.
int take_all(SdoClient& client, bool& aborts) {
  CanFrame frame;
  int count = 0;
  while (client.take(frame)) {
    MUST(frame.id == kSdoRequestBase + kNode && frame.size == kSdoSize && !frame.remote);
    aborts = frame.data[0] == kAbort;
    ++count;
  }
  return count;
}

/// Whether the object has grown by nothing, or by the bytes of an answer, which are its last.
bool grown_rightly(const SdoClient& client, std::size_t before, const CanFrame& answer) {
  if (client.size() == before) return true;
  const std::size_t grown = client.size() - before, at = grown <= 4 && before == 0 ? 4 : 1;
  const auto* const last = client.data() + before;
  return grown <= kSegmentBytes && client.size() <= SdoClient::kCapacity &&
         (std::equal(last, last + grown, answer.data.begin() + at) ||
          std::equal(last, last + grown, answer.data.begin() + 1));
}

void begin(SdoClient& client, std::uint8_t choice) {
  static constexpr std::uint8_t kBytes[SdoClient::kCapacity + 2] = {1, 2, 3};
  if (choice >= 0x80)
    client.download_bytes(kNode, 0x1008, 0, kBytes, choice - 0x80U + 3U, 0);
  else if (choice >= 0x40)
    client.download(kNode, 0x1008, 0, 0x04030201, static_cast<std::uint8_t>(choice % 4 + 1), 0);
  else
    client.upload(kNode, 0x1008, 0, 0);
}

/// Whether the bytes name the object of every transfer, 1008h:0.
bool names_ours(const CanFrame& frame) {
  return frame.data[1] == 0x08 && frame.data[2] == 0x10 && frame.data[3] == 0;
}
/// A segment names none; it is an answer if one was asked for.
bool is_segment(const CanFrame& frame) {
  return (frame.data[0] & 0xC0) == 0;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const SdoTimes times;
  SdoClient client;
  begin(client, data[0]);
  std::int64_t now_ns = 0, heard_ns = 0;
  bool aborts = false;
  MUST(take_all(client, aborts) == (client.progress() == Progress::kBusy));
  // Each record: a pause, the length of a frame, its bytes.
  for (std::size_t at = 1; at + 2 <= size && client.progress() == Progress::kBusy;) {
    now_ns += data[at] * 4 * kMs_ns;
    client.advance(now_ns);
    CanFrame frame;
    frame.id = static_cast<std::uint16_t>(kSdoAnswerBase + (data[at + 1] & 0x40 ? 4 : kNode));
    frame.size = data[at + 1] & 0x0F;
    frame.remote = (data[at + 1] & 0x80) != 0;
    at += 2;
    for (std::size_t i = 0; i < frame.size && at < size; ++i) frame.data[i] = data[at++];
    const bool answer = frame.id == kSdoAnswerBase + kNode && frame.size == 8 && !frame.remote;
    const bool ours = answer && names_ours(frame), maybe = answer && (ours || is_segment(frame));
    const bool busy = client.progress() == Progress::kBusy;
    MUST(!busy || (now_ns - heard_ns < times.answer_ns && now_ns < times.transfer_ns));
    if (busy && maybe) heard_ns = now_ns;
    const std::size_t before = client.size();
    client.receive(frame, now_ns);
    MUST(client.progress() == Progress::kAborted || grown_rightly(client, before, frame));
    const int sent = take_all(client, aborts);
    MUST(sent <= 1 && (maybe || !busy || sent == 0));
    MUST((client.progress() == Progress::kBusy) == (sent == 1 && !aborts) || (busy && !ours));
    MUST(!client.describe().empty());
  }
  client.advance(now_ns + times.answer_ns);
  MUST(client.progress() != Progress::kBusy && client.progress() != Progress::kIdle);
  return 0;
}
