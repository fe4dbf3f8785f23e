// wcet-record PIPELINE TAPE: runs a pipeline on the simulated plant and writes what the robot
// measured and what the client sent. Exit code 1 with a message on the error stream.
#include <cstdio>
#include <cstdlib>

#include "boards/program/files.hpp"
#include "gateway/gateway_section.hpp"
#include "gateway/reference_client.hpp"
#include "gateway/trajectory_csv.hpp"
#include "hal/os/realtime_settings.hpp"
#include "kernel/executive.hpp"
#include "sim_plant/sim_hal.hpp"
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

/// The simulated robot, with a tape running.
class RecordingHal final : public Hal {
 public:
  explicit RecordingHal(SimHal& robot) : robot_(robot) {}
  Capabilities capabilities() const override { return robot_.capabilities(); }
  Status start(CommandMode mode, RobotState& state) override {
    TRY(robot_.start(mode, state));
    put_state(state);
    put(TapeOp::kStart);
    return Status::kOk;
  }
  Status read(RobotState& state) override {
    TRY(robot_.read(state));
    put_state(state);
    put(TapeOp::kCycle);
    return Status::kOk;
  }
  Status write(const RobotCommand& command) override { return robot_.write(command); }
  void stop() override { robot_.stop(); }

 private:
  static void put_state(const RobotState& state) {
    put(TapeOp::kState);
    for (const JointVector* value : {&state.q, &state.dq, &state.tau})
      for (int i = 0; i < kDof; ++i) put(static_cast<float>((*value)[i]));
    for (int i = 0; i < 6; ++i) put(static_cast<float>(state.ft[i]));
  }
  SimHal& robot_;
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

struct Board {
  Pipeline pipeline;
  PlantParams plant;
  GatewaySection gateway;
  RealtimeSettings realtime;
};

/// The pose of that name, and its number among the poses of the pipeline from 1; 0: none.
int find_pose(const PortTable& ports, const Value& name, const Pose*& pose) {
  const PortEntry* const port = name.empty() ? nullptr : ports.find(name);
  int number = port != nullptr ? 1 : 0;
  for (int i = 0; port != nullptr && &ports[i] != port; ++i)
    number += ports[i].quantity == Quantity::kPose ? 1 : 0;
  if (port != nullptr) pose = static_cast<const Pose*>(port->value);
  return number;
}

int put_terms(const Board& board, TaskSpace::Terms& terms) {
  const PortTable& ports = board.pipeline.ports;
  const int motion = find_pose(ports, board.gateway.motion_frame, terms.motion);
  return motion + 16 * find_pose(ports, board.gateway.wrench_frame, terms.wrench);
}
int put_terms(const Board&, JointSpace::Terms&) {
  return 0;
}

/// Stores, client and trajectory of one space.
template <class Space>
struct Way {
  static constexpr int kCapacity = 64;  // as the player's
  Way() {
    for (std::size_t i = 0; i < kStores; ++i) {
      channel.stores[i].waypoints = waypoints[i];
      channel.stores[i].capacity = kCapacity;
    }
  }
  /// Sends the trajectory of that file. Its end, s; < 0: refused.
  double send(const char* path, const Board& board) {
    Trajectory<Space>& trajectory = *client.acquire();
    const int frames = put_terms(board, trajectory.terms);
    CsvError error;
    std::uint32_t id = 0;
    if (!read_trajectory(path, false, trajectory, error)) return -1.0;
    trajectory.interpolation = board.gateway.interpolation;
    if (board.gateway.start_s > 0.0) trajectory.start_s = board.gateway.start_s;
    put(TapeOp::kWaypoints);
    for (const int byte : {frames, int{trajectory.fields},
                           static_cast<int>(trajectory.interpolation), trajectory.count})
      put(static_cast<std::uint8_t>(byte));
    put(trajectory.start_s);
    for (int i = 0; i < trajectory.count; ++i)
      put(trajectory.at(i).time_s), put_point(trajectory.at(i).point);
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
  ReferenceChannel<Space> channel;
  ReferenceClient<Space> client{channel};
  Waypoint<Space> waypoints[kStores][kCapacity];
};

int record(const char* path) {
  static Board board;
  static SimHal robot;
  static Way<JointSpace> joints;
  static Way<TaskSpace> poses;
  Loader loader({&joints.channel, &poses.channel}, robot.capabilities());
  loader.add(board_section("plant", board.plant));
  loader.add(board_section("gateway", board.gateway));
  loader.add(board_section("realtime", board.realtime));
  std::string_view text;
  if (!load_pipeline(path, loader, board.pipeline, text)) return 1;
  const double period_s = board.pipeline.robot.period_s();
  robot.set_period(period_s);
  if (robot.load(board.plant, 1) != Status::kOk) return 1;
  static RecordingHal hal(robot);
  static Executive executive(hal, board.pipeline, nullptr);
  if (executive.start() != Status::kOk) return 1;
  const FilePath file = relative_to(path, board.gateway.trajectory);
  const double end_s = board.pipeline.takes_poses ? poses.send(file.c_str(), board)
                                                  : joints.send(file.c_str(), board);
  if (end_s < 0.0) return std::fprintf(stderr, "%s: refused\n", file.c_str()), 1;
  const double duration_s = board.gateway.start_s + end_s + board.gateway.settle_s;
  for (std::int64_t k = 1; static_cast<double>(k) * period_s <= duration_s; ++k) {
    if (executive.cycle({static_cast<std::int64_t>(1e9 * period_s) * k}) != Status::kOk)
      return std::fprintf(stderr, "%s: %s\n", path, name(executive.latched())), 1;
    joints.poll(), poses.poll();
  }
  return 0;
}

}  // namespace
}  // namespace tactus

int main(int argc, char** argv) {
  if (argc != 3) return std::fprintf(stderr, "usage: wcet-record PIPELINE TAPE\n"), 1;
  tactus::tape = std::fopen(argv[2], "wb");
  if (tactus::tape == nullptr) return std::perror(argv[2]), 1;
  const int code = tactus::record(argv[1]);
  return std::fclose(tactus::tape) == 0 ? code : 1;
}
