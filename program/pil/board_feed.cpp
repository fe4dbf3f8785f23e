#include "program/pil/board_feed.hpp"

#include <algorithm>

#include "gateway/verdict_text.hpp"

namespace tactus::pil {

using serial::Kind;

namespace {

void note_held(TrajectoryTerms& terms, const JointSpace::Header& header) {
  terms.held = header.held;
}
void note_held(TrajectoryTerms&, const TaskSpace::Header&) {}

}  // namespace

template <class Space>
bool FileFeed<Space>::refused(Status status, BoardClient& board, Message& why) const {
  constexpr bool kTip = std::is_same_v<Space, TaskSpace>;
  ByteReader from = board.answer();
  Verdict verdict = read_verdict(from);
  if (!from.ok()) verdict = {status};
  why = Message("the board refused the trajectory: ");
  why << describe(verdict, kTip ? VerdictAxes::kTip : VerdictAxes::kJoints, kInfinity);
  return false;
}

/// As many waypoints as a payload holds behind their number.
template <class Space>
int FileFeed<Space>::fitting() const {
  const std::size_t each = sizeof(double) * static_cast<std::size_t>(1 + Space::numbers(fields_));
  return std::min(kMost, static_cast<int>((serial::kMaxPayload - 1) / each));
}

template <class Space>
void FileFeed<Space>::fill() {
  while (!at_end_ && count_ < fitting()) {
    at_end_ = reader_.next(next_[static_cast<std::size_t>(count_)], error_) != RowResult::kWaypoint;
    if (at_end_) return;
    fields_ = reader_.fields();
    ++count_;
  }
}

template <class Space>
bool FileFeed<Space>::begin(BoardClient& board, const char* path, const GatewaySection& gateway,
                            const SmoothedReader<Space>& host, Message& why) {
  const bool partial = gateway.partial_joints == PartialJoints::kHold;
  count_ = 0;
  at_end_ = whole_ = false;
  if (!reader_.open(path, partial, 0, error_) || !reader_.lines().regular() ||
      !reader_.restart_as(host, error_)) {
    why = Message(path);
    why << ": cannot be read a second time, for the board";
    return false;
  }
  fill();
  TrajectoryTerms terms;
  typename Space::Header header{};
  reader_.note_terms(header);
  note_held(terms, header);
  terms.poses = std::is_same_v<Space, TaskSpace>;
  terms.fields = fields_;
  terms.interpolation = gateway.interpolation;
  terms.exact = gateway.times == Times::kExact;
  if (gateway.start_s > 0.0) terms.start_s = gateway.start_s;
  terms.motion = gateway.motion_frame;
  terms.wrench = gateway.wrench_frame;
  std::uint8_t payload[serial::kMaxPayload];
  ByteWriter writer(payload, sizeof payload);
  write_terms(writer, terms);
  const Status status = board.request(Kind::kTrajectory, writer);
  return status == Status::kOk ? feed(board, why) : refused(status, board, why);
}

template <class Space>
bool FileFeed<Space>::feed(BoardClient& board, Message& why) {
  while (!whole_) {
    fill();
    if (count_ == 0) {
      const Status status = board.request(Kind::kEnd);
      whole_ = status == Status::kOk;
      return whole_ || status == Status::kWindowFull || refused(status, board, why);
    }
    std::uint8_t payload[serial::kMaxPayload];
    ByteWriter writer(payload, sizeof payload);
    writer.u8(static_cast<std::uint8_t>(count_));
    for (int i = 0; i < count_; ++i)
      write_waypoint(writer, next_[static_cast<std::size_t>(i)], fields_);
    const Status status = board.request(Kind::kWaypoints, writer);
    if (status != Status::kOk) return refused(status, board, why);
    ByteReader from = board.answer();
    static_cast<void>(read_verdict(from));
    const int taken = static_cast<int>(from.u32());
    const bool all = taken >= count_;
    std::copy(next_.begin() + std::min(taken, count_), next_.begin() + count_, next_.begin());
    count_ -= std::min(taken, count_);
    if (!all) return true;
  }
  return true;
}

bool BoardFeed::begin(BoardClient& board, const TrajectoryInput& input,
                      const GatewaySection& gateway, Message& why) {
  const char* const path = input.path.c_str();
  if (const auto* poses = std::get_if<2>(&input.file))
    return file_.emplace<2>().begin(board, path, gateway, poses->reader(), why);
  return file_.emplace<1>().begin(board, path, gateway, std::get_if<1>(&input.file)->reader(), why);
}

bool BoardFeed::feed(BoardClient& board, Message& why) {
  if (auto* joints = std::get_if<1>(&file_)) return joints->feed(board, why);
  if (auto* poses = std::get_if<2>(&file_)) return poses->feed(board, why);
  return true;
}

}  // namespace tactus::pil
