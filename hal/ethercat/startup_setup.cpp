// Startup: what is read from and written to a drive by SDO.
#include "hal/cia402/hex.hpp"
#include "hal/ethercat/startup.hpp"

namespace tactus::ethercat {
namespace {

constexpr const char* kManual = "; see this object in the drive's manual";
constexpr int kAttempts = 2;  // of a transfer that gets no answer: a frame with it may be lost

}  // namespace

/// Begins to identify the present slave, or to set it up.
void Startup::begin_steps(Stage stage) {
  stage_ = stage;
  attempts_ = 0;
  port_.reset();
  facts_.clear();
  lines_.begin(drive_->sdo, joint(), findings_);
  steps_.begin(*ethercat_, mode_, period_us_);
  step_ = stage == Stage::kIdentify ? 0 : steps_.identifying();
  leave_out();
  ask_object(now_ns_);
}

/// Behind the last step of the stage.
int Startup::steps_end() const {
  return stage_ == Stage::kIdentify ? steps_.identifying() : steps_.count();
}

void Startup::leave_out() {
  while (step_ < steps_end() && is_left_out(steps_.step(step_))) ++step_;
}

/// Begins the transfer of the present step.
void Startup::ask_object(std::int64_t now_ns) {
  const std::size_t bytes = at().boxes.out_bytes;
  coe_.set_time((stores() ? drive_->store_ms : ethercat_->sdo_ms) * kMillisecond_ns);
  if (stage_ == Stage::kMapping)
    return coe_.upload(bytes, mapping_.index(), mapping_.sub(), now_ns);
  const SetupStep& step = steps_.step(step_);
  if (step.kind == SetupStep::Kind::kLines) {
    const cia402::ObjectLine& line = lines_.line();
    const cia402::Object& object = line.object;
    if (lines_.reads()) return coe_.upload(bytes, object.index, object.sub, now_ns);
    return coe_.download(bytes, object.index, object.sub, line.bits, object.bytes, now_ns);
  }
  if (step.reads())
    coe_.upload(bytes, step.index, step.sub, now_ns);
  else
    coe_.download(bytes, step.index, step.sub, step.value, step.bytes, now_ns);
}

Status Startup::take_mailbox(const Answer& answer) {
  can::Emergency emergency;
  (void)port_.take(at().boxes, answer, emergency, now_ns_);  // of the time before: no matter
  if (coe_.progress() == CoeClient::Progress::kBusy) return Status::kOk;
  const bool silent = coe_.abort() == can::SdoAbort::kTimeout;
  if (silent && !stores() && ++attempts_ < kAttempts) {
    ask_object(now_ns_);
    return Status::kOk;
  }
  attempts_ = 0;
  if (silent) {
    Message what = coe_.describe();
    what << "; power the drive off and on, or raise "
         << (stores() ? "[cia402] store_ms" : "[ethercat] sdo_ms");
    return refuse(Status::kBusTimeout, what);
  }
  return stage_ == Stage::kMapping ? finish_mapping() : finish_step();
}

Status Startup::finish_step() {
  const SetupStep& step = steps_.step(step_);
  if (step.kind == SetupStep::Kind::kExpect) TRY(judge_expected(step));
  if (step.kind == SetupStep::Kind::kFact) TRY(take_fact(step));
  if (step.kind == SetupStep::Kind::kStore) TRY(take_stored(step));
  if (step.kind == SetupStep::Kind::kLines) {
    TRY(take_line());
    if (!lines_.done()) {
      ask_object(now_ns_);
      return Status::kOk;
    }
  }
  ++step_;
  leave_out();
  if (step_ == steps_end() && stage_ == Stage::kIdentify) {
    next_slave(Stage::kFeatures, Stage::kSetup);
    if (stage_ == Stage::kSetup) begin_steps(Stage::kSetup);
    return Status::kOk;
  }
  if (step_ == steps_end()) {
    stage_ = Stage::kMapping;
    mapping_.begin(at().data);
  }
  ask_object(now_ns_);
  return Status::kOk;
}

Status Startup::judge_expected(const SetupStep& step) {
  Message what(step.what);
  if (coe_.progress() != CoeClient::Progress::kDone) {
    what << ": " << std::string_view(coe_.describe()) << kManual;
    return refuse(Status::kRefusedByRobot, what);
  }
  if ((coe_.value() & step.mask) == (step.value & step.mask)) return Status::kOk;
  what << " (" << std::string_view(cia402::hex(step.index)) << ":" << int{step.sub} << ") is "
       << static_cast<std::size_t>(coe_.value()) << ", expected "
       << static_cast<std::size_t>(step.value) << "; " << step.remedy;
  return refuse(Status::kRefusedByRobot, what);
}

/// True for a step without work. The last step of a drive is never left out.
bool Startup::is_left_out(const SetupStep& step) const {
  if (step.kind == SetupStep::Kind::kLines) return lines_.done();
  return step.kind == SetupStep::Kind::kStore && !(drive_->store != 0 && lines_.changed());
}

Status Startup::take_line() {
  const bool done = coe_.progress() == CoeClient::Progress::kDone;
  Message what;
  const Status status = lines_.take({done, coe_.size_known(), coe_.size(), coe_.value()}, what);
  if (status == Status::kOk) return status;
  if (!done) what << ": " << std::string_view(coe_.describe()) << kManual;
  return refuse(status, what);
}

Status Startup::take_stored(const SetupStep& step) {
  bool& stored = findings_.stored[static_cast<std::size_t>(joint())];
  if (coe_.progress() == CoeClient::Progress::kDone) {
    stored = true;
    return Status::kOk;
  }
  Message what(step.what);
  what << ": " << std::string_view(coe_.describe()) << kManual;
  return refuse(Status::kRefusedByRobot, what);
}

/// A fact that the drive does not have is none; the identity is judged by itself, and all facts
/// when the last of them is known.
Status Startup::take_fact(const SetupStep& step) {
  Message what;
  if (coe_.progress() == CoeClient::Progress::kDone) {
    facts_.set(step.value, coe_.value());
  } else if (coe_.abort() != can::SdoAbort::kNoObject &&
             coe_.abort() != can::SdoAbort::kNoSubIndex) {
    what << step.what << ": " << std::string_view(coe_.describe()) << kManual;
    return refuse(Status::kRefusedByRobot, what);
  }
  const bool identity = step.value == cia402::kIdentityFact;
  if (!identity && step.value + 1 < cia402::kFactCount) return Status::kOk;
  at().feedback.error_code = static_cast<std::uint16_t>(facts_.get(cia402::kErrorCode));
  const Status status = identity ? facts_.judge_identity(*drive_, joint(), findings_, what)
                                 : facts_.judge(*drive_, joint(), true, findings_, what);
  return status == Status::kOk ? status : refuse(status, what);
}

/// Judges the mapping read back: a drive may keep a mapping of its own that has all objects needed.
Status Startup::finish_mapping() {
  Message what("PDOs: ");
  if (coe_.progress() != CoeClient::Progress::kDone) {
    what << std::string_view(coe_.describe()) << kManual;
    return refuse(Status::kRefusedByRobot, what);
  }
  if (!mapping_.take(coe_.value()))
    return refuse(Status::kTooLarge, "it has more mapped objects than this program has room for");
  if (!mapping_.done()) {
    ask_object(now_ns_);
    return Status::kOk;
  }
  if (const char* missing = at().data.resolve(mode_)) {
    what << "it does not take the mapping, and its own does not have " << missing
         << "; map it with the drive's maker's tool";
    return refuse(Status::kRefusedByRobot, what);
  }
  if (at_ + 1 == kDof) TRY(place_image());
  next_slave(Stage::kSetup, Stage::kProcessData);
  if (stage_ == Stage::kSetup) begin_steps(Stage::kSetup);
  return Status::kOk;
}

}  // namespace tactus::ethercat
