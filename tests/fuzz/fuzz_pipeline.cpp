// Fuzzes pipeline files. A refusal must name a line and a reason; an accepted file must keep its
// ranges and run: whatever its gains, only finite commands within limits are written.
#include "gateway/reference_client.hpp"
#include "hal/cia402/cia402_settings.hpp"
#include "hal/ur/ur_settings.hpp"
#include "kernel/cycle/executive.hpp"
#include "kernel/load/loader.hpp"
#include "program/sim/sim_sections.hpp"
#include "tests/fuzz/guarded_hal.hpp"
#include "tests/fuzz/number_mutator.hpp"
#include "tests/fuzz/setting_checker.hpp"
#include "tests/support/armed.hpp"

namespace {

using namespace tactus;

constexpr Capabilities kOffered = {true, true, true, 1000, 10000, true};

/// The sections of a board whose robot is simulated, and real in two ways.
struct Sections : SimSections {
  ur::UrSettings ur;
  cia402::Cia402Settings cia402;

  Sections() { cia402.rated_torque.setOnes(); }

  template <class Visitor>
  void describe(Visitor& visit) {
    SimSections::describe(visit);
    visit.section("ur", ur);
    visit.section("cia402", cia402);
  }
};

struct Board {
  ChannelMemory<JointSpace> joints;
  ChannelMemory<TaskSpace> poses;
  RoomyPipeline pipeline;
  Sections sections;
  LoadError error;

  Status load(std::string_view text) {
    Loader loader({&joints, &poses}, kOffered, sections);
    return loader.load(text, pipeline, error);
  }
  void check_settings() {
    fuzz::SettingChecker checker;
    pipeline.describe(checker);
    sections.describe(checker);
  }
};

void check_refusal(const LoadError& error, std::string_view text) {
  const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
  const std::string_view reason = error.reason;
  MUST(error.line >= 0 && error.line <= lines && !reason.empty());
  MUST(error.line > 0 || reason == "the file is empty: it has no section" ||
       reason == "the section is missing");
}

/// The output of a generator by name, or null.
template <class Value>
const Value* reference(const PortTable& ports, std::string_view name) {
  for (int i = 0; i < ports.count(); ++i)
    if (ports[i].port == name) return static_cast<const Value*>(ports[i].value);
  return nullptr;
}

/// Sends a reference close to the present one, in every space that has a generator.
void send_reference(Board& board) {
  std::uint32_t id = 0;
  const PortTable& ports = board.pipeline.ports;
  if (const auto* q = reference<JointVector>(ports, "q_d")) {
    JointSpace::Point point;
    point.q = *q + JointVector::Constant(0.001);
    static_cast<void>(ReferenceClient<JointSpace>(board.joints).send(point, id));
  }
  if (const auto* x = reference<Pose>(ports, "x_d")) {
    TaskSpace::Point point;
    point.x = *x;
    point.x.p += Vector3::Constant(0.0005);
    static_cast<void>(ReferenceClient<TaskSpace>(board.poses).send(point, id));
  }
}

void run(Board& board) {
  JointVector q;
  q << 0.0, -1.67, 1.87, 2.94, -1.57, 0.1;
  const RobotSection& robot = board.pipeline.robot;
  fuzz::GuardedHal hal(q, board.pipeline.guard.effective(), robot.period_s());
  CycleTimes times;
  Executive executive(hal, board.pipeline, {[] { return std::uint64_t{0}; }, times});
  const std::int64_t period_ns = std::int64_t{1000} * robot.period_us;
  std::int64_t now_ns = 0;
  if (start_armed(executive, period_ns, now_ns) != Status::kOk) return;
  for (int i = 1; i <= 24; ++i) {
    if (i < 8) send_reference(board);
    if (i == 16) executive.halt();
    static_cast<void>(executive.cycle({now_ns + period_ns * i}));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  alignas(Board) static unsigned char bytes[sizeof(Board)];
  Board& board = *new (bytes) Board;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const Status status = board.load(text);
  MUST(status == board.error.status);
  if (status == Status::kOk) {
    board.check_settings();
    run(board);
  } else {
    check_refusal(board.error, text);
  }
  board.~Board();
  return 0;
}
