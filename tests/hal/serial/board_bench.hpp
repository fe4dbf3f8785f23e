// BoardBench: a board in the emulator and a plant on this computer, for tests that interfere with
// the link between them.
#pragma once

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "gateway/fnv1a.hpp"
#include "gateway/reference_frames.hpp"
#include "kernel/cycle/ladder.hpp"
#include "program/pil/fault_text.hpp"
#include "sim_plant/arm/sim_hal.hpp"
#include "tests/support/testing.hpp"

namespace tactus::pil {

using serial::Kind;
using serial::Order;
using serial::Pace;

/// What happens to the state on its way to the board in one cycle.
enum class Fate { kArrives, kIsLost, kIsCorrupted };

/// The board of this test, which is build/BOARD/tests/… or build/BOARD-SANITIZERS/tests/…
inline std::string board_name() {
  char program[512] = {};
  assert_true(readlink("/proc/self/exe", program, sizeof program - 1) > 0);
  std::string path(program);
  path.resize(path.rfind("/tests/"));
  path.erase(0, path.rfind('/') + 1);
  return path.substr(0, path.find('-'));
}

struct BoardBench {
  EmulatedBoard emulator;
  BoardClient board{emulator};
  SimHal plant;
  RobotState state;
  std::int64_t time_ns = 0;
  std::uint32_t seen = 0;  ///< results that the plant has got

  /// Starts the board whose image can provoke faults.
  void boot() {
    Message why;
    if (emulator.start(image_of("build", board_name(), "/image-faults.elf"), why))
      return board.begin();
    std::fprintf(stderr, "%s\n", why.c_str());
    assert_true(false);
  }

  /// Sends a text in parts and has it loaded.
  Status load(std::string_view text) {
    std::uint8_t bytes[serial::kMaxPayload];
    for (std::size_t at = 0; at < text.size(); at += 1000) {
      ByteWriter part(bytes, sizeof bytes);
      part.u32(static_cast<std::uint32_t>(at));
      part.text(text.substr(at, 1000));
      TRY(board.request(Kind::kText, part));
    }
    ByteWriter whole(bytes, sizeof bytes);
    whole.u32(static_cast<std::uint32_t>(text.size()));
    whole.u64(fnv1a(text));
    return board.request(Kind::kLoad, whole);
  }
  Status request(Kind kind, std::uint8_t byte) {
    std::uint8_t bytes[1];
    ByteWriter payload(bytes, sizeof bytes);
    payload.u8(byte);
    return board.request(kind, payload);
  }

  /// Loads the embedded pipeline and starts it, with the plant where it begins.
  void start(Pace pace) {
    ASSERT_OK(load({}));
    ASSERT_OK(request(Kind::kStart, static_cast<std::uint8_t>(pace)));
    plant.set_period(1e-3);
    ASSERT_OK(plant.load(PlantParams(), 1));
    ASSERT_OK(plant.connect(CommandMode::kEffort));
    time_ns = 0;
    seen = board.results();
  }

  /// One cycle in lock-step.
  Status step(Order order) {
    ASSERT_OK(plant.read({time_ns}, state));
    TRY(board.step(order, state, time_ns));
    seen = board.results();
    ASSERT_OK(plant.write(board.result().command));
    time_ns += 1'000'000;
    return board.result().status;
  }

  /// One period of a board with its own timer: the plant gets what came, the board its answer.
  Status turn(Order order, Fate fate = Fate::kArrives) {
    if (board.results() != seen) ASSERT_OK(plant.write(board.result().command));
    seen = board.results();
    ASSERT_OK(plant.read({board.result().stamp_ns}, state));
    std::uint8_t bytes[serial::kMaxFrame];
    const std::size_t size = board.put_state(order, state, bytes);
    if (fate == Fate::kIsCorrupted) bytes[size / 2] ^= 0x10;
    TRY(board.turn(bytes, fate == Fate::kIsLost ? 0 : size));
    return board.result().status;
  }

  /// Some periods of a board with its own timer, whatever they end with.
  void turns(int count, Order order) {
    for (int i = 0; i < count; ++i) static_cast<void>(turn(order));
  }

  Rung rung() const { return static_cast<Rung>(board.result().rung); }
  bool disabled() const { return board.result().command.request == DriveRequest::kDisable; }

  /// Runs until the arm is commanded.
  void arm(Pace pace) {
    Status status = Status::kArming;
    for (int i = 0; i < 3000 && status != Status::kOk; ++i)
      status = pace == Pace::kLockStep ? step(Order::kArmed) : turn(Order::kArmed);
    ASSERT_OK(status);
    assert_true(rung() == Rung::kNominal);
  }
};

/// The text that the image has.
inline std::string pipeline_text() {
  std::ifstream file(std::string("pipelines/") + Robot::kName + "_jrg_pdgc.ini");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A bench that has never run; the last one's emulator is ended.
inline BoardBench& fresh() {
  static BoardBench* bench = nullptr;
  delete bench;
  bench = new BoardBench;
  bench->boot();
  return *bench;
}

}  // namespace tactus::pil
