// Fuzzes the link between a board and the computer at its other end: bytes of any kind, frames with
// a right check sum whose payloads are of any kind, and the references in them.
#include "gateway/reference_server.hpp"
#include "hal/serial/board_link.hpp"
#include "tests/fuzz/fuzzing.hpp"

namespace {

using namespace tactus;
using namespace tactus::serial;

/// The input as it comes, and nothing that is sent.
struct Wire final : ByteLink {
  std::array<std::uint8_t, 2 * kMaxFrame> bytes;
  std::size_t count = 0;

  std::size_t receive(std::uint8_t* to, std::size_t capacity) override {
    const std::size_t taken = std::min(count, capacity);
    std::copy_n(bytes.begin(), taken, to);
    count = 0;
    return taken;
  }
  void send(const std::uint8_t*, std::size_t size) override { MUST(size <= kMaxFrame); }
};

struct Channel : ChannelMemory<JointSpace, 4, 32, 2> {
  Waypoint<JointSpace> waypoints[kStores][8];

  Channel() {
    for (std::size_t i = 0; i < kStores; ++i) {
      stores[i].waypoints = waypoints[i];
      stores[i].capacity = 8;
    }
  }
};

void judge_state(ByteReader payload) {
  RobotState state;
  Order order;
  const std::size_t size = payload.left();
  if (!read_state(payload, order, state)) return;
  std::array<std::uint8_t, 512> again;
  ByteWriter writer(again.data(), again.size());
  write_state(writer, order, state);
  MUST(writer.ok() && writer.size() == size);
}

void execute(ReferenceServer<JointSpace>& server, const Frame& frame) {
  ByteReader payload(frame.payload, frame.size);
  TrajectoryTerms terms;
  std::uint32_t id = 0;
  int taken = 0;
  switch (frame.kind) {
    case Kind::kTrajectory:
      if (read_terms(payload, terms)) static_cast<void>(server.begin(terms));
      break;
    case Kind::kWaypoints: {
      const int count = payload.u8();
      static_cast<void>(server.take(payload, count, taken));
      MUST(taken >= 0 && taken <= count);
      break;
    }
    case Kind::kEnd: static_cast<void>(server.end(id)); break;
    case Kind::kPoint: static_cast<void>(server.point(terms, payload, id)); break;
    case Kind::kControl:
      static_cast<void>(server.control(static_cast<ControlKind>(payload.u8()), payload.f64(), id));
      break;
    default: break;
  }
}

/// Whole frames: kind, size and payload each.
void deal_frames(const fuzz::Tape& tape, Wire& wire, BoardLink& link) {
  static Channel channel;
  static PortTable ports;
  new (&channel) Channel;
  ReferenceClient<JointSpace> client(channel);
  ReferenceServer<JointSpace> server(client, ports);
  CycleTime now;
  std::uint16_t number = 0;
  for (std::size_t at = 0; at + 2 <= tape.size;) {
    const auto kind = static_cast<Kind>(tape.data[at]);
    const std::size_t size = std::min<std::size_t>(4U * tape.data[at + 1], tape.size - at - 2);
    wire.count = write_frame({kind, ++number, tape.data + at + 2, size}, wire.bytes.data());
    link.poll();
    judge_state(link.state());
    static_cast<void>(link.tick(now));
    Frame message;
    if (link.message(message)) {
      MUST(message.size == size &&
           std::equal(message.payload, message.payload + size, tape.data + at + 2));
      execute(server, message);
      link.answer(Status::kOk);
      link.answered();
    }
    link.send_answer();
    static_cast<void>(server.poll());
    at += 2 + size;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const fuzz::Tape tape(data, size);
  Wire wire;
  BoardLink link(wire);
  if (tape.hangs) {
    deal_frames(tape, wire, link);
    return 0;
  }
  Frame message;
  tape.deal([&](const std::uint8_t* piece, std::size_t count) {
    wire.count = std::min(count, wire.bytes.size());
    std::copy_n(piece, wire.count, wire.bytes.begin());
    link.poll();
    judge_state(link.state());
    if (link.message(message)) MUST(message.size <= kMaxPayload);
  });
  return 0;
}
