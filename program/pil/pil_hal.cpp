#include "program/pil/pil_hal.hpp"

#include <cstdio>
#include <cstring>

#include "gateway/fnv1a.hpp"
#include "program/pil/fault_text.hpp"
#include "program/pil/row_hash.hpp"

namespace tactus::pil {

using serial::Kind;

namespace {

constexpr std::size_t kTextPart = 960;

std::uint64_t bits_of(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

/// The first joint whose numbers are not the same to the last bit; -1: there is none.
int first_difference(const JointVector& a, const JointVector& b) {
  for (int j = 0; j < kDof; ++j)
    if (bits_of(a[j]) != bits_of(b[j])) return j;
  return -1;
}

}  // namespace

Status PilHal::refuse(Status status, const char* what) {
  why_ = Message("the board ");
  why_ << what << ": " << meaning(status);
  return status;
}

Status PilHal::load(const PlantParams& params, double period_s, const Options& options) {
  if (options.realtime) {
    why_ = Message(
        "the clock of an emulated board counts instructions, so it has no real time; leave out"
        " --realtime");
    return Status::kNotOffered;
  }
  plant_.set_period(period_s);
  return plant_.load(params, options.seed);
}

Status PilHal::connect(CommandMode mode) {
  TRY(plant_.connect(mode));
  if (!emulator_.start(image_, why_)) return Status::kConnectionLost;
  board_.begin();
  order_ = serial::Order::kDisabled;
  stepped_ = parted_ = false;
  serial::Greeting greeting;
  const Status status = board_.greet(greeting);
  if (status != Status::kOk) {
    why_ = Message(image_.path);
    why_ << (emulator_.running() ? ": the board does not answer" : ": the emulator has ended")
         << "; make builds the image anew";
    return status;
  }
  if (greeting.version != serial::kVersion || greeting.joints != kDof ||
      std::string_view(greeting.robot) != Robot::kName) {
    why_ = Message("the board is one of ");
    why_ << greeting.robot << ", " << int{greeting.joints} << " joints, protocol "
         << int{greeting.version} << "; expected " << Robot::kName << ", " << kDof << " joints, "
         << int{serial::kVersion};
    return Status::kRefusedByRobot;
  }
  TRY(send_text());
  std::uint8_t pace[1];
  ByteWriter writer(pace, sizeof pace);
  writer.u8(static_cast<std::uint8_t>(serial::Pace::kLockStep));
  const Status started = board_.request(Kind::kStart, writer);
  return started == Status::kOk ? started : refuse(started, "does not start");
}

/// The board reads the text itself, as if it were the embedded one.
Status PilHal::send_text() {
  const std::string_view text = session_->text;
  std::uint8_t payload[serial::kMaxPayload];
  for (std::size_t at = 0; at < text.size(); at += kTextPart) {
    ByteWriter writer(payload, sizeof payload);
    writer.u32(static_cast<std::uint32_t>(at));
    writer.text(text.substr(at, kTextPart));
    const Status status = board_.request(Kind::kText, writer);
    if (status != Status::kOk) return refuse(status, "does not take the pipeline");
  }
  ByteWriter writer(payload, sizeof payload);
  writer.u32(static_cast<std::uint32_t>(text.size()));
  writer.u64(fnv1a(text));
  const Status status = board_.request(Kind::kLoad, writer);
  if (status == Status::kOk) return status;
  ByteReader from = board_.answer();
  const std::string_view reason = from.text(from.u8());
  why_ = Message("the board refuses the pipeline: ");
  why_ << reason;
  return status;
}

/// The outputs are still those of the last cycle.
Status PilHal::read(const CycleTime& now, RobotState& state) {
  if (!parted_ && stepped_ && board_.result().row != row_hash(session_->pipeline.recording)) {
    why_ = Message("cycle ");
    why_ << std::size_t{board_.result().cycle}
         << ": the board has recorded other values than this computer";
    parted_ = true;
  }
  if (parted_) return Status::kMismatch;
  TRY(plant_.read(now, state));
  state_ = state;
  now_ns_ = now.stamp_ns;
  return Status::kOk;
}

Status PilHal::write(const RobotCommand& command) {
  if (parted_) return plant_.write(command);  // which disables the drives
  if (command.request == DriveRequest::kArm) order_ = serial::Order::kArmed;
  // A stop has ended the trajectory on both machines, and the board refuses further waypoints.
  if (!refuses(session_->executive.rung()) && !feed_.feed(board_, why_))
    return Status::kRefusedByRobot;
  if (board_.step(order_, state_, now_ns_) != Status::kOk) return silent();
  stepped_ = true;
  TRY(plant_.write(board_.result().command));
  const Status status = compare(command);
  parted_ = status != Status::kOk;
  return status;
}

Status PilHal::compare(const RobotCommand& command) {
  const RobotCommand& other = board_.result().command;
  why_ = Message("cycle ");
  why_ << std::size_t{board_.result().cycle} << ": the board's ";
  if (other.mode != command.mode || other.request != command.request) {
    why_ << "request is " << static_cast<int>(other.request) << ", this computer's "
         << static_cast<int>(command.request) << "; the board says "
         << meaning(board_.result().status);
    return Status::kMismatch;
  }
  const struct {
    const char* name;
    const JointVector &theirs, &ours;
  } parts[] = {{"command", other.value, command.value},
               {"velocity feed-forward", other.dq_ff, command.dq_ff},
               {"torque feed-forward", other.tau_ff, command.tau_ff}};
  for (const auto& part : parts) {
    const int joint = first_difference(part.theirs, part.ours);
    if (joint < 0) continue;
    char numbers[96];
    std::snprintf(numbers, sizeof numbers, " of joint %d is %a, this computer's %a", joint + 1,
                  part.theirs[joint], part.ours[joint]);
    why_ << part.name << numbers;
    return Status::kMismatch;
  }
  why_ = Message();
  return Status::kOk;
}

/// No result arrived: the board has restarted after a fault, or it is gone.
Status PilHal::silent() {
  serial::Greeting greeting;
  why_ = Message("the board does not answer any more");
  if (board_.greet(greeting) == Status::kOk && greeting.fault != serial::FaultCause::kNone)
    why_ = fault_text(board_);
  return Status::kConnectionLost;
}

bool PilHal::begin(const TrajectoryInput& input) {
  if (!input.given()) return true;
  if (feed_.begin(board_, input, session_->gateway, why_)) return true;
  std::fprintf(stderr, "%s: %s\n", input.path.c_str(), why_.c_str());
  return false;
}

Status PilHal::disconnect() {
  if (emulator_.running()) static_cast<void>(board_.request(Kind::kStop));
  emulator_.stop();
  return plant_.disconnect();
}

}  // namespace tactus::pil
