// Fuzzes what comes through the socket of a bus: packets of any length and content. A second
// reading of the bytes says which of them are frames.
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>

#include "hal/can/can_socket.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace {

using namespace tactus::can;

constexpr std::size_t kLongest = 100;
constexpr CanFilter kFilters[] = {{0x180, 0x780}, {0x700, 0x700}};

struct Expected {
  std::uint32_t frames = 0, malformed = 0, foreign = 0, errors = 0;
};

/// Judges a packet by its bytes, as the kernel's documentation describes them.
void judge(const std::uint8_t* packet, std::size_t size, bool fd, Expected& sum) {
  const bool is_long = size == 72;
  if (size != 16 && !(fd && is_long)) return void(++sum.malformed);
  const std::uint8_t length = packet[4], flags = packet[3];
  const bool error = (flags & 0x20) != 0;
  if (length > (is_long ? 64 : 8) || (error && (is_long || length != 8)))
    return void(++sum.malformed);
  if (error) return void(++sum.errors);
  if ((flags & 0x80) != 0) return void(++sum.foreign);
  const int id = (packet[1] & 7) << 8 | packet[0];
  if ((id >= 0x180 && id < 0x200) || id >= 0x700) ++sum.frames;
}

void receive(CanSocket& can, Expected& got) {
  static CanFrame frames[CanSocket::kBatch];
  constexpr int kMostCalls = 4096 / CanSocket::kBatch + 1;  // an input has as many packets at most
  for (int call = 0; call < kMostCalls; ++call) {
    const int count = can.receive(frames, CanSocket::kBatch);
    for (int i = 0; i < count; ++i) {
      const CanFrame& frame = frames[i];
      MUST(frame.id <= 0x7FF && frame.size <= (frame.fd ? kMaxData : kClassicData));
      MUST(!frame.remote || frame.size == 0);
      for (std::size_t at = frame.size; at < kMaxData; ++at) MUST(frame.data[at] == 0);
    }
    got.frames += static_cast<std::uint32_t>(count);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const bool fd = (data[0] & 1) != 0;
  int ends[2];
  MUST(socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends) == 0);
  CanSocket can;
  can.adopt(ends[0], fd, kFilters, 2);
  Expected expected, got;
  // Each record: the length of a packet, its bytes.
  for (std::size_t at = 1, packets = 1; at < size; ++packets) {
    std::uint8_t packet[kLongest] = {};
    const std::size_t length = data[at++] % kLongest, given = std::min(length, size - at);
    std::memcpy(packet, data + at, given);
    at += given;
    MUST(send(ends[1], packet, length, 0) == static_cast<ssize_t>(length));
    judge(packet, length, fd, expected);
    if (packets % 32 == 0) receive(can, got);
  }
  receive(can, got);
  const LinkHealth& health = can.health();
  MUST(!health.lost && got.frames == expected.frames && health.malformed == expected.malformed);
  MUST(health.foreign == expected.foreign && health.error_frames == expected.errors);
  close(ends[1]);
  receive(can, got);
  MUST(health.lost && got.frames == expected.frames && health.malformed == expected.malformed);
  return 0;
}
