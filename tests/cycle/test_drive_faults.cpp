// Tests the executive against a robot whose wire and drives fail at random, in all three modes.
// What must hold in every cycle: one read and one write; no command to drives that are not enabled;
// commands within limits; a log that explains the rung.
#include <cstdlib>

#include "tests/cycle/executive_bench.hpp"
#include "tests/support/random.hpp"
#include "tests/support/trials.hpp"

namespace tactus {
namespace {

constexpr int kCycles = 300;
constexpr double kPeriod_s = ExecutiveBench::kPeriod_s;

int runs() {
  return trials(1000);
}

constexpr const char* kEnds[] = {"q_c = jrg.q_d\ndq_ff = jrg.dq_d\ntau_ff = pd.tau\n",
                                 "dq_c = jrg.dq_d\ntau_ff = pd.tau\n", "tau_c = pd.tau\n"};
constexpr Capabilities kTakesAll = {true, true, true, 100, 100000, true, true, true};
constexpr CommandMode kModes[] = {CommandMode::kPosition, CommandMode::kVelocity,
                                  CommandMode::kEffort};

/// Drives that take their cycles, and a wire that repeats itself; what it is asked for is judged.
class FaultyHal final : public Hal {
 public:
  FaultyHal(Random& random, const JointVector& q, CommandMode mode) : random_(random), mode_(mode) {
    state_.q = q;
    set(DriveState::kDisabled);
  }
  Capabilities capabilities() const override { return kTakesAll; }
  Status connect(CommandMode) override { return Status::kOk; }
  Status read(const CycleTime& now, RobotState& state) override {
    assert_false(read_);
    read_ = true;
    const int fault = random_.below(400);
    frozen_ = fault == 0 ? 1 + random_.below(12) : frozen_ - (frozen_ > 0 ? 1 : 0);
    if (frozen_ == 0) state_.stamp_ns = now.stamp_ns;
    if (fault == 1) fail(random_.below(kDof));
    if (fault == 2) stuck_ = random_.below(60);  // neither arms nor stops
    state = state_;
    const auto joint = static_cast<std::size_t>(random_.below(kDof));
    if (fault == 3) state.drives[joint].valid = false;
    if (fault == 4) state.q[random_.below(kDof)] = std::nan("");
    seen_ = state;
    return fault == 5 ? Status::kBusTimeout : Status::kOk;
  }
  Status write(const RobotCommand& command) override {
    assert_true(read_);
    read_ = false;
    const bool enabled = all(DriveState::kEnabled);
    if (command.request == DriveRequest::kFollow)
      follow(command);
    else
      assert_not_fed(command);
    if (!enabled || command.request != DriveRequest::kFollow) state_.dq.setZero();
    take_step(command.request);
    return random_.below(2000) == 0 ? Status::kConnectionLost : Status::kOk;
  }
  Status disconnect() override {
    set(DriveState::kDisabled);
    return Status::kOk;
  }
  bool followed() const { return followed_; }

 private:
  /// Only enabled drives are commanded, within limits, and from where they were.
  void follow(const RobotCommand& command) {
    for (const Drive& drive : seen_.drives) assert_true(drive.state == DriveState::kEnabled);
    assert_true(command.mode == mode_ && command.value.allFinite());
    const JointVector before = followed_ ? sent_ : held();
    const JointVector step = command.value - before;
    for (int i = 0; i < kDof; ++i) {
      if (mode_ == CommandMode::kPosition)
        assert_true(std::abs(step[i]) <= limits_.dq_max[i] * kPeriod_s + 1e-9);
      else if (mode_ == CommandMode::kVelocity)
        assert_true(std::abs(step[i]) <= limits_.ddq_max[i] * kPeriod_s + 1e-9);
      else
        assert_true(std::abs(step[i]) <= limits_.dtau_max[i] * kPeriod_s + 1e-9);
    }
    judge_feed_forward(command);
    followed_ = true;
    sent_ = command.value;
    if (mode_ == CommandMode::kEffort) {
      state_.tau = sent_;
      state_.dq += kPeriod_s * sent_;
      state_.q += kPeriod_s * state_.dq;
      return;
    }
    state_.dq =
        mode_ == CommandMode::kVelocity ? sent_ : JointVector((sent_ - state_.q) / kPeriod_s);
    state_.q += kPeriod_s * state_.dq;
  }
  /// Feed-forward begins at zero and changes within limits.
  void judge_feed_forward(const RobotCommand& command) {
    const JointVector dq = command.dq_ff - fed_.dq_ff, tau = command.tau_ff - fed_.tau_ff;
    for (int i = 0; i < kDof; ++i) {
      assert_true(std::abs(dq[i]) <= limits_.ddq_max[i] * kPeriod_s + 1e-9);
      assert_true(std::abs(tau[i]) <= limits_.dtau_max[i] * kPeriod_s + 1e-9);
      assert_true(std::abs(command.dq_ff[i]) <= limits_.dq_max[i]);
      assert_true(std::abs(command.tau_ff[i]) <= limits_.tau_max[i]);
    }
    fed_ = command;
  }
  void assert_not_fed(const RobotCommand& command) {
    assert_true(command.dq_ff.isZero(0.0) && command.tau_ff.isZero(0.0));
    followed_ = false;
    fed_ = {};
  }
  JointVector held() const {
    return mode_ == CommandMode::kPosition   ? state_.q
           : mode_ == CommandMode::kVelocity ? state_.dq
                                             : state_.tau;
  }
  void take_step(DriveRequest request) {
    if (stuck_ > 0) {
      --stuck_;
      return;
    }
    const bool wanted = request != DriveRequest::kDisable;
    if (wanted && request == DriveRequest::kArm && !all(DriveState::kEnabled)) {
      if (!all(DriveState::kArming)) left_ = random_.below(30);
      set(--left_ > 0 ? DriveState::kArming : DriveState::kEnabled);
      if (random_.below(100) == 0) fail(random_.below(kDof));
    }
    if (!wanted && all(DriveState::kEnabled)) {
      set(DriveState::kStopping);
      left_ = random_.below(30);
      state_.tau.setZero();
    } else if (!wanted && --left_ <= 0) {
      set(DriveState::kDisabled);
    }
  }
  void set(DriveState state) { state_.drives.fill({state, true}); }
  void fail(int joint) {
    state_.drives[static_cast<std::size_t>(joint)] = {DriveState::kFault, true, Status::kDriveFault,
                                                      false, 7};
  }
  bool all(DriveState state) const {
    bool same = true;
    for (const Drive& drive : state_.drives) same = same && drive.state == state;
    return same;
  }

  Random& random_;
  const CommandMode mode_;
  const JointLimits limits_;
  RobotState state_, seen_;
  JointVector sent_ = JointVector::Zero();
  RobotCommand fed_;
  bool read_ = false, followed_ = false;
  int frozen_ = 0, stuck_ = 0, left_ = 0;
};

struct FaultRun {
  ChannelMemory<JointSpace> channel;
  RoomyPipeline pipeline;
  ReferenceClient<JointSpace> client{channel};
  int takeovers = 0;

  void load(std::size_t mode) {
    Text<511> text("[robot]\nname = fer\nperiod_us = 1000\n");
    text << kEnds[mode]
         << "[executive]\narming_ms = 40\ndisabling_ms = 20\nstop_ms = 100\nrest_ms = 10\n"
         << "[jrg]\ntype = joint_reference_generator\nq = robot.q\n"
         << "[pd]\ntype = pd_gravity\nq_d = jrg.q_d\nq = robot.q\ndq = robot.dq\nkp = 400\nkd = "
            "40\n";
    Loader loader({&channel}, kTakesAll);
    LoadError error;
    ASSERT_OK(loader.load(text, pipeline, error));
  }

  void go(Random& random, CommandMode mode) {
    const JointLimits limits;
    const JointVector middle = 0.5 * (limits.q_min + limits.q_max);
    FaultyHal hal(random, middle, mode);
    Executive executive(hal, pipeline);
    ASSERT_OK(executive.start());
    Rung explained = Rung::kDisabled;
    std::uint32_t read = 0;
    for (std::int64_t k = 1; k <= kCycles; ++k) {
      const Status status = executive.cycle({k * ExecutiveBench::kPeriod_ns});
      assert_true(!hal.followed() || status != Status::kArming);
      if (random.below(15) == 0 || status == Status::kArming)
        takeovers += executive.arm() == Status::kOk && executive.rung() == Rung::kNominal;
      if (random.below(150) == 0) executive.halt();
      if (random.below(5) == 0) send(random, middle);
      Event event;
      for (; read < executive.events().count(); ++read) {
        if (!executive.events().read(read, event)) continue;
        assert_true(event.from == explained);
        assert_true(event.to == next(event.from, event.cause, mode));
        explained = event.to;
      }
      assert_true(explained == executive.rung());
    }
  }
  void send(Random& random, const JointVector& middle) {
    JointSpace::Point point;
    point.q = middle + JointVector::Constant(random.uniform(-0.02, 0.02));
    std::uint32_t id = 0;
    static_cast<void>(client.send(point, id));
    Report report;
    while (client.poll(report)) {
    }
  }
};

// Proves LAD-14, LAD-7, LAD-8.

void no_fault_of_wire_or_drives_leads_to_a_command_that_is_not_allowed(void**) {
  static std::optional<FaultRun> run;
  int takeovers = 0;
  for (int i = 0; i < runs(); ++i) {
    Random random{static_cast<std::uint64_t>(20261122 + i)};
    run.emplace();
    const auto mode = static_cast<std::size_t>(i % 3);
    run->load(mode);
    run->go(random, kModes[mode]);
    takeovers += run->takeovers;
  }
  print_message("%d runs, the arm was taken over %d times\n", runs(), takeovers);
  assert_true(takeovers > runs());
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(no_fault_of_wire_or_drives_leads_to_a_command_that_is_not_allowed),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
