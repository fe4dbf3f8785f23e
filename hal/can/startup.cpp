#include "hal/can/startup.hpp"

#include <algorithm>

#include "hal/cia402/hex.hpp"
#include "kernel/core/nanoseconds.hpp"

namespace tactus::can {
namespace {

constexpr const char* kCheck = "; check power, cabling, bit rate and [can] node and bus";
constexpr const char* kCheckBus =
    "; check power of the drives, cabling, termination, bit rate and [can] interfaces";

}  // namespace

void Startup::begin(const CanSettings& can, const cia402::Cia402Settings& drive,
                    const PdoLayout& layout, CommandMode mode, int period_us, int buses,
                    std::int64_t now_ns) {
  can_ = &can;
  drive_ = &drive;
  layout_ = &layout;
  mode_ = mode;
  period_us_ = period_us;
  buses_ = buses;
  enter(Stage::kReset, now_ns);
}

void Startup::enter(Stage stage, std::int64_t now_ns) {
  stage_ = stage;
  since_ns_ = now_ns;
  joint_ = steady_ = boot_ups_ = 0;
  if (stage == Stage::kIdentify) {
    // A drive that starts by itself (CiA 302-2) is operational, and takes no mapping there.
    for (const Node& node : nodes_)
      out_[static_cast<std::size_t>(node.bus)].add(
          nmt_frame(NmtCommand::kPreOperational, node.id()));
  }
  if (stage == Stage::kIdentify || stage == Stage::kSetup) {
    list_steps();
    ask(now_ns);
  }
  if (stage == Stage::kSync) sync_ns_ = now_ns;
  if (stage != Stage::kReset && stage != Stage::kStart) return;
  const bool reset = stage == Stage::kReset;
  for (Node& node : nodes_) {
    node.heart.start(node.id(), can_->boot_ms * kMillisecond_ns, now_ns);
    out_[static_cast<std::size_t>(node.bus)].add(
        nmt_frame(reset ? NmtCommand::kResetCommunication : NmtCommand::kStart, node.id()));
  }
}

Status Startup::advance(std::int64_t now_ns) {
  switch (stage_) {
    case Stage::kReset: return reset(now_ns);
    case Stage::kIdentify:
    case Stage::kSetup: return setup(now_ns);
    case Stage::kStart: return start(now_ns);
    case Stage::kSync: return sync(now_ns);
    case Stage::kDone: break;
  }
  return Status::kOk;
}

Status Startup::silent(int joint, const char* what, int limit_ms) {
  const Node& node = nodes_[static_cast<std::size_t>(joint)];
  bool heard = false;  // any drive of the bus
  for (const Node& other : nodes_) heard = heard || (other.bus == node.bus && other.heart.known());
  why_ = Message("bus ");
  why_ << std::string_view(interfaces_[static_cast<std::size_t>(node.bus)]) << ": "
       << (heard ? "" : "no drive is heard: ") << label(joint, node) << ": " << what << " within "
       << limit_ms << " ms" << (heard ? kCheck : kCheckBus);
  return Status::kBusTimeout;
}

Status Startup::reset(std::int64_t now_ns) {
  for (int j = 0; j < kDof; ++j) {
    const Node& node = nodes_[static_cast<std::size_t>(j)];
    if (node.heart.boot_ups() > 0) continue;
    bus_ = node.bus;
    const bool over = node.heart.is_lost(now_ns);
    return over ? silent(j, "no boot-up message after its reset", can_->boot_ms) : Status::kArming;
  }
  // One from before the reset, or of a boot loader, is followed by that of the drive.
  int boot_ups = 0;
  for (const Node& node : nodes_) boot_ups += node.heart.boot_ups();
  if (boot_ups != boot_ups_) booted_ns_ = now_ns;
  boot_ups_ = boot_ups;
  if (now_ns - booted_ns_ >= kSettled_ns) enter(Stage::kIdentify, now_ns);
  return Status::kArming;
}

Status Startup::start(std::int64_t now_ns) {
  for (int j = 0; j < kDof; ++j) {
    const Node& node = nodes_[static_cast<std::size_t>(j)];
    if (node.heart.known() && node.heart.state() == NmtState::kOperational) continue;
    bus_ = node.bus;
    const bool over = now_ns - since_ns_ > can_->boot_ms * kMillisecond_ns;
    return over ? silent(j, "no heartbeat that says operational", can_->boot_ms) : Status::kArming;
  }
  enter(Stage::kSync, now_ns);
  return Status::kArming;
}

/// A cycle counts if every node has answered the SYNC before.
Status Startup::sync(std::int64_t now_ns) {
  const std::int64_t period_ns = std::int64_t{1000} * period_us_;
  if (now_ns - sync_ns_ < period_ns) return Status::kArming;
  int silent_joint = -1;
  for (int j = kDof - 1; j >= 0; --j) {
    Node& node = nodes_[static_cast<std::size_t>(j)];
    if (node.frames == 0) silent_joint = j;
    node.frames = 0;
  }
  steady_ = silent_joint < 0 ? steady_ + 1 : 0;
  if (steady_ >= kSteady) {
    stage_ = Stage::kDone;
    return Status::kOk;
  }
  if (silent_joint >= 0 && now_ns - since_ns_ > can_->boot_ms * kMillisecond_ns)
    return silent(silent_joint, "no steady feedback PDO", can_->boot_ms);
  sync_ns_ = now_ns;
  for (int bus = 0; bus < buses_; ++bus) out_[static_cast<std::size_t>(bus)].add(sync_frame());
  return Status::kArming;
}

Status Startup::setup(std::int64_t now_ns) {
  sdo_.advance(now_ns);
  Status status = Status::kArming;
  if (sdo_.progress() == Progress::kDone || sdo_.progress() == Progress::kAborted)
    status = finish_step(now_ns);
  CanFrame request;
  if (sdo_.take(request)) out_[static_cast<std::size_t>(bus_)].add(request);
  return status;
}

/// Lists the steps of the node of joint_, and begins with the first of the stage.
void Startup::list_steps() {
  const Node& node = nodes_[static_cast<std::size_t>(joint_)];
  bus_ = node.bus;
  watched_ = false;
  facts_.clear();
  lines_.begin(drive_->sdo, joint_, findings_);
  steps_.begin(*can_, *layout_, node.slot, mode_, period_us_);
  step_ = stage_ == Stage::kIdentify ? 0 : steps_.identifying();
  leave_out();
}

/// Behind the last step of the stage.
int Startup::steps_end() const {
  return stage_ == Stage::kIdentify ? steps_.identifying() : steps_.count();
}

/// Sends the request of step `step_`.
void Startup::ask(std::int64_t now_ns) {
  const SetupStep& step = steps_.step(step_);
  const std::uint8_t id = nodes_[static_cast<std::size_t>(joint_)].id();
  const bool stores = step.kind == SetupStep::Kind::kStore;
  SdoTimes times;
  times.answer_ns = (stores ? drive_->store_ms : can_->sdo_ms) * kMillisecond_ns;
  times.transfer_ns = std::max(times.transfer_ns, times.answer_ns);
  sdo_.set_times(times);
  if (step.kind == SetupStep::Kind::kLines) {
    const cia402::ObjectLine& line = lines_.line();
    const cia402::Object& object = line.object;
    if (lines_.reads()) return sdo_.upload(id, object.index, object.sub, now_ns);
    return sdo_.download(id, object.index, object.sub, line.bits, object.bytes, now_ns);
  }
  if (step.reads())
    sdo_.upload(id, step.index, step.sub, now_ns);
  else
    sdo_.download(id, step.index, step.sub, step.value, step.bytes, now_ns);
}

/// True for a step without work. The last step of a drive is never left out.
bool Startup::is_left_out(const SetupStep& step) const {
  if (step.kind == SetupStep::Kind::kLines) return lines_.done();
  return step.kind == SetupStep::Kind::kStore && !(drive_->store != 0 && lines_.changed());
}

void Startup::leave_out() {
  while (step_ < steps_end() && is_left_out(steps_.step(step_))) ++step_;
}

/// Goes on with the next step, the next node, or the next stage.
Status Startup::next_step(std::int64_t now_ns) {
  step_ns_ = now_ns;
  ++step_;
  leave_out();
  const bool last = step_ == steps_end(), identified = stage_ == Stage::kIdentify;
  if (last && !identified && !watched_) return unwatched();
  if (last && ++joint_ == kDof) {
    enter(identified ? Stage::kSetup : Stage::kStart, now_ns);
    return Status::kArming;
  }
  if (last) list_steps();
  ask(now_ns);
  return Status::kArming;
}

Status Startup::finish_step(std::int64_t now_ns) {
  const SetupStep& step = steps_.step(step_);
  if (step.kind == SetupStep::Kind::kLines) return finish_line(now_ns);
  if (sdo_.progress() == Progress::kAborted) {
    const bool fixed = sdo_.abort() == SdoAbort::kNoObject ||
                       sdo_.abort() == SdoAbort::kNoSubIndex || sdo_.abort() == SdoAbort::kReadOnly;
    const bool optional =
        step.kind == SetupStep::Kind::kMayWrite || step.kind == SetupStep::Kind::kFact;
    if (!(fixed && optional)) {
      why_ = label(joint_, nodes_[static_cast<std::size_t>(joint_)]);
      why_ << ": " << step.what << ": " << sdo_.describe();
      return sdo_.abort() == SdoAbort::kTimeout ? Status::kBusTimeout : Status::kRefusedByRobot;
    }
  } else if (step.kind == SetupStep::Kind::kFact) {
    facts_.set(step.value, sdo_.value());
  } else if (step.reads()) {
    return judge_value(step, now_ns);
  } else {
    watched_ = watched_ || step.watches;
    bool& stored = findings_.stored[static_cast<std::size_t>(joint_)];
    stored = stored || step.kind == SetupStep::Kind::kStore;
  }
  if (step.kind == SetupStep::Kind::kFact) TRY(judge_fact(step.value));
  return next_step(now_ns);
}

/// Goes on with the lines of the file, or behind the last of them.
Status Startup::finish_line(std::int64_t now_ns) {
  const bool done = sdo_.progress() == Progress::kDone;
  Message said;
  const Status status = lines_.take({done, sdo_.size_known(), sdo_.size(), sdo_.value()}, said);
  if (status == Status::kOk && lines_.done()) return next_step(now_ns);
  if (status == Status::kOk) {
    ask(now_ns);
    return Status::kArming;
  }
  why_ = label(joint_, nodes_[static_cast<std::size_t>(joint_)]);
  why_ << ": " << std::string_view(said);
  if (!done) why_ << ": " << sdo_.describe();
  return !done && sdo_.abort() == SdoAbort::kTimeout ? Status::kBusTimeout : status;
}

/// The identity by itself, and all facts when the last of them is known.
Status Startup::judge_fact(std::uint32_t row) {
  const bool identity = row == cia402::kIdentityFact;
  if (!identity && row + 1 < cia402::kFactCount) return Status::kOk;
  nodes_[static_cast<std::size_t>(joint_)].feedback.error_code =
      static_cast<std::uint16_t>(facts_.get(cia402::kErrorCode));
  const bool velocities = layout_->fd() || mode_ == CommandMode::kVelocity;
  Message said;
  const Status status = identity ? facts_.judge_identity(*drive_, joint_, findings_, said)
                                 : facts_.judge(*drive_, joint_, velocities, findings_, said);
  if (status == Status::kOk) return status;
  why_ = label(joint_, nodes_[static_cast<std::size_t>(joint_)]);
  why_ << ": " << std::string_view(said);
  return status;
}

/// A drive that nothing stops if this program ends must not be enabled by it.
Status Startup::unwatched() {
  why_ = label(joint_, nodes_[static_cast<std::size_t>(joint_)]);
  why_ << ": it takes neither a consumer of our heartbeat (1016h:1) nor a time-out of its commands"
          " (1400h:5), so that it would go on without this program; it cannot be used";
  return Status::kRefusedByRobot;
}

Status Startup::judge_value(const SetupStep& step, std::int64_t now_ns) {
  const std::uint32_t value = sdo_.value();
  const bool right = (value & step.mask) == (step.value & step.mask);
  const bool waits =
      step.kind == SetupStep::Kind::kAwait && now_ns - step_ns_ <= can_->sdo_ms * kMillisecond_ns;
  if (right) return next_step(now_ns);
  if (waits) {
    ask(now_ns);
    return Status::kArming;
  }
  why_ = label(joint_, nodes_[static_cast<std::size_t>(joint_)]);
  why_ << ": " << step.what << " (" << cia402::hex(step.index) << ":" << static_cast<int>(step.sub)
       << ") is " << static_cast<std::size_t>(value) << ", expected "
       << static_cast<std::size_t>(step.value);
  if (step.remedy[0] != '\0') why_ << "; " << step.remedy;
  return Status::kRefusedByRobot;
}

}  // namespace tactus::can
