// PilHal: the simulated robot of a pipeline under the control of a board: processor in the loop.
// This computer runs the same text beside it. In every cycle the plant gets the board's command,
// and the two machines compare, bit by bit, the command and all that is recorded.
#pragma once

#include "program/pil/board_feed.hpp"
#include "program/session/follower.hpp"
#include "program/session/session.hpp"
#include "sim_plant/arm/sim_hal.hpp"

namespace tactus::pil {

class PilHal final : public Hal, public Follower {
 public:
  /// The board's program. [init]
  void set_image(const BoardImage& image) { image_ = image; }
  /// Builds the plant for cycles of `period_s`. kNotOffered for cycles by the wall clock; as
  /// SimHal::load(). [init]
  Status load(const PlantParams& params, double period_s, const Options& options);

  Capabilities capabilities() const override { return plant_.capabilities(); }
  /// Starts the board, hands it the text, which it judges, and connects. [init]
  Status connect(CommandMode mode) override;
  /// kMismatch: the board has recorded something else in the last cycle. [cyclic]
  Status read(const CycleTime& now, RobotState& state) override;
  /// Takes the board through the same cycle; the plant gets its command. [cyclic]
  Status write(const RobotCommand& command) override;
  Status disconnect() override;
  Message trouble() override { return why_; }

  void prepare(const Session& session) override { session_ = &session; }
  bool begin(const TrajectoryInput& input) override;
  void halt() override { order_ = serial::Order::kDisabled; }

 private:
  Status send_text();
  Status refuse(Status status, const char* what);
  Status compare(const RobotCommand& command);
  Status silent();

  SimHal plant_;
  BoardImage image_{};
  const Session* session_ = nullptr;
  EmulatedBoard emulator_;
  BoardClient board_{emulator_};
  BoardFeed feed_;
  Message why_;
  RobotState state_;
  std::int64_t now_ns_ = 0;
  serial::Order order_ = serial::Order::kDisabled;
  bool stepped_ = false;  // the board has run a cycle
  bool parted_ = false;   // the two machines have computed different values
};

}  // namespace tactus::pil
