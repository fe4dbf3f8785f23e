// wcet-record PIPELINE TAPE [TRAJECTORY]: runs a pipeline, with its own trajectory or another, on
// the simulated plant and writes the robot's measurements and the client's requests to a tape. Exit
// code 1 with a message on the error stream.
#include <cstdio>
#include <cstdlib>

#include "gateway/reference_client.hpp"
#include "gateway/trajectory/trajectory_reader.hpp"
#include "kernel/cycle/executive.hpp"
#include "program/session/files.hpp"
#include "program/sim/sim_sections.hpp"
#include "sim_plant/arm/sim_hal.hpp"
#include "tests/support/armed.hpp"
#include "tests/wcet/tape.hpp"

namespace tactus {
namespace {

std::FILE* tape = nullptr;

template <class T>
void put(const T& value) {
  std::fwrite(&value, sizeof value, 1, tape);
}
void put_vector(const double* values, Eigen::Index count) {
  for (Eigen::Index i = 0; i < count; ++i) put(values[i]);
}

/// The simulated robot, while a tape is recorded.
class RecordingHal final : public Hal {
 public:
  explicit RecordingHal(SimHal& robot) : robot_(robot) {}
  Capabilities capabilities() const override { return robot_.capabilities(); }
  Status connect(CommandMode mode) override { return robot_.connect(mode); }
  Status read(const CycleTime& now, RobotState& state) override {
    TRY(robot_.read(now, state));
    if (records_) put_state(state, TapeOp::kCycle);
    state_ = state;
    return Status::kOk;
  }
  Status write(const RobotCommand& command) override { return robot_.write(command); }
  Status disconnect() override { return robot_.disconnect(); }
  /// Begins the tape with the state in which the arm was taken over.
  void begin() {
    put_state(state_, TapeOp::kStart);
    records_ = true;
  }

 private:
  static void put_state(const RobotState& state, TapeOp op) {
    put(TapeOp::kState);
    for (const JointVector* value : {&state.q, &state.dq, &state.tau})
      for (int i = 0; i < kDof; ++i) put(static_cast<float>((*value)[i]));
    for (int i = 0; i < 6; ++i) put(static_cast<float>(state.ft[i]));
    put(op);
  }

  SimHal& robot_;
  RobotState state_;
  bool records_ = false;
};

void put_point(const JointSpace::Point& point) {
  for (const JointVector* value : {&point.q, &point.dq, &point.ddq, &point.tau})
    put_vector(value->data(), kDof);
}
void put_point(const TaskSpace::Point& point) {
  const Eigen::Quaterniond& r = point.x.r;
  put_vector(point.x.p.data(), 3);
  for (const double part : {r.w(), r.x(), r.y(), r.z()}) put(part);
  for (const Vector6* value : {&point.v, &point.a, &point.h, &point.dh})
    put_vector(value->data(), 6);
}

struct Board : SimSections {
  RoomyPipeline pipeline;
};

/// The pose of that name, and its number among the pipeline's poses from 1; 0 if there is none.
int find_pose(const PortTable& ports, const Value& name, const Pose*& pose) {
  const PortEntry* const port = name.empty() ? nullptr : ports.find(name);
  int number = port != nullptr ? 1 : 0;
  for (int i = 0; port != nullptr && &ports[i] != port; ++i)
    number += ports[i].quantity == Quantity::kPose ? 1 : 0;
  if (port != nullptr) pose = static_cast<const Pose*>(port->value);
  return number;
}

int put_terms(const Board& board, TaskSpace::Header& header) {
  const PortTable& ports = board.pipeline.ports;
  const int motion = find_pose(ports, board.gateway.motion_frame, header.motion);
  return motion + 16 * find_pose(ports, board.gateway.wrench_frame, header.wrench);
}
int put_terms(const Board&, JointSpace::Header&) {
  return 0;
}

/// Stores, client and trajectory of one space.
template <class Space>
struct Way {
  static constexpr int kCapacity = std::is_same_v<Space, JointSpace> ? kLongestTape : 64;
  Way() {
    for (std::size_t i = 0; i < kStores; ++i) {
      channel.stores[i].waypoints = waypoints[i];
      channel.stores[i].capacity = kCapacity;
    }
  }
  /// Sends the trajectory of that file. Returns its end, s, or a negative number if it is refused.
  double send(const char* path, const Board& board) {
    Trajectory<Space>& trajectory = *client.acquire();
    const int frames = put_terms(board, trajectory.header);
    CsvError error;
    std::uint32_t id = 0;
    if (!read_trajectory(path, false, trajectory, error)) return -1.0;
    trajectory.interpolation = board.gateway.interpolation;
    if (board.gateway.start_s > 0.0) trajectory.start_s = board.gateway.start_s;
    put(TapeOp::kWaypoints);
    for (const int byte : {frames + trajectory.count / 256, int{trajectory.fields},
                           static_cast<int>(trajectory.interpolation), trajectory.count % 256})
      put(static_cast<std::uint8_t>(byte));
    put(trajectory.start_s);
    for (int i = 0; i < trajectory.count; ++i) {
      put(trajectory.at(i).time_s);
      put_point(trajectory.at(i).point);
    }
    return client.send(trajectory, id).ok() ? trajectory.end_s() : -1.0;
  }
  void poll() {
    Report report;
    while (client.poll(report)) {
    }
    Feedback<Space> feedback;
    while (client.poll_feedback(feedback)) {
    }
  }
  ChannelMemory<Space> channel;
  ReferenceClient<Space> client{channel};
  Waypoint<Space> waypoints[kStores][kCapacity];
};

int record(const char* path, const char* trajectory) {
  static Board board;
  static SimHal robot;
  static Way<JointSpace> joints;
  static Way<TaskSpace> poses;
  Loader loader({&joints.channel, &poses.channel}, robot.capabilities(), board);
  std::string_view text;
  if (!load_pipeline(path, loader, board.pipeline, text)) return 1;
  const double period_s = board.pipeline.robot.period_s();
  robot.set_period(period_s);
  if (robot.load(board.plant, 1) != Status::kOk) return 1;
  static RecordingHal hal(robot);
  static Executive executive(hal, board.pipeline);
  const std::int64_t period_ns = std::int64_t{1000} * board.pipeline.robot.period_us;
  std::int64_t now_ns = 0;
  if (start_armed(executive, period_ns, now_ns) != Status::kOk) return 1;
  hal.begin();
  const FilePath file =
      trajectory != nullptr ? FilePath(trajectory) : relative_to(path, board.gateway.trajectory);
  const double end_s = board.pipeline.takes_poses ? poses.send(file.c_str(), board)
                                                  : joints.send(file.c_str(), board);
  if (end_s < 0.0) {
    std::fprintf(stderr, "%s: refused\n", file.c_str());
    return 1;
  }
  const double duration_s = board.gateway.start_s + end_s + board.gateway.settle_s;
  for (std::int64_t k = 1; static_cast<double>(k) * period_s <= duration_s; ++k) {
    const Status status = executive.cycle({now_ns + period_ns * k});
    // A stop before a collision may be what the file states.
    if (status != Status::kOk && executive.latched() != Status::kCollision) {
      std::fprintf(stderr, "%s: %s\n", path, name(executive.latched()));
      return 1;
    }
    joints.poll();
    poses.poll();
  }
  return 0;
}

}  // namespace
}  // namespace tactus

int main(int argc, char** argv) {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: wcet-record PIPELINE TAPE [TRAJECTORY]\n");
    return 1;
  }
  tactus::tape = std::fopen(argv[2], "wb");
  if (tactus::tape == nullptr) {
    std::perror(argv[2]);
    return 1;
  }
  const int code = tactus::record(argv[1], argv[3]);  // null without one
  return std::fclose(tactus::tape) == 0 ? code : 1;
}
