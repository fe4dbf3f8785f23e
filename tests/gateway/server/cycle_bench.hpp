// The cycle of `tactus serve` in virtual time: an executive, its pipeline and the cycle's end of
// the mailboxes, with a robot that does at once what it is told. The server has its turn where the
// test lets it.
#pragma once

#include "kernel/load/loader.hpp"
#include "program/cycle_endpoint.hpp"
#include "program/session/host_sections.hpp"
#include "tests/gateway/server/client_bench.hpp"
#include "tests/support/armed.hpp"

namespace tactus {

struct ObedientHal final : Hal {
  RobotState state;
  RobotCommand command;  ///< the last one

  ObedientHal() {
    state.drives.fill({DriveState::kEnabled, true});
    state.q = ServerBench::home().q;
  }
  Capabilities capabilities() const override { return {true, true, true, 100, 100000, true}; }
  Status connect(CommandMode) override { return Status::kOk; }
  Status read(const CycleTime& now, RobotState& measured) override {
    measured = state;
    measured.stamp_ns = now.stamp_ns;
    return Status::kOk;
  }
  Status write(const RobotCommand& sent) override {
    command = sent;
    if (sent.request == DriveRequest::kFollow) state.q = sent.value;
    const bool off = sent.request == DriveRequest::kDisable;
    for (Drive& drive : state.drives)
      if (!off || drive.state != DriveState::kFault)
        drive.state = off ? DriveState::kDisabled : DriveState::kEnabled;
    return Status::kOk;
  }
  Status disconnect() override { return Status::kOk; }
};

struct CycleBench : BenchClock {
  ObedientHal hal;
  ChannelMemory<JointSpace> channel;
  ChannelMemory<TaskSpace> task_channel;
  std::array<std::array<Waypoint<JointSpace>, kBenchWaypoints>, kStores> waypoints;
  RoomyPipeline pipeline;
  HostSections sections;
  Executive executive{hal, pipeline};
  CycleMailboxes mailboxes;
  ReferenceClient<JointSpace> joints{channel};
  ReferenceClient<TaskSpace> poses{task_channel};
  alignas(CycleEndpoint) std::array<std::byte, sizeof(CycleEndpoint)> endpoint_place;
  alignas(Server) std::array<std::byte, sizeof(Server)> server_place;
  CycleEndpoint* endpoint = nullptr;
  Server* server = nullptr;

  /// `blocks` are further ones.
  void start(std::string_view blocks = {}) {
    Text<1023> text(
        "[robot]\nname = fer\nperiod_us = 1000\nq_c = jrg.q_d\n"
        "[jrg]\ntype = joint_reference_generator\nq = robot.q\n");
    for (std::size_t i = 0; i < kStores; ++i) {
      channel.stores[i].waypoints = waypoints[i].data();
      channel.stores[i].capacity = kBenchWaypoints;
    }
    LoadError error;
    Loader loader({&channel, &task_channel}, hal.capabilities(), sections);
    ASSERT_OK(loader.load(text << blocks, pipeline, error));
    executive.in_virtual_time();
    ServerSetup setup;
    setup.loaded = &pipeline;
    setup.joint_window = kBenchWaypoints;
    setup.events = &executive.events();
    setup.hal = &hal;
    endpoint = new (endpoint_place.data()) CycleEndpoint(mailboxes, executive, pipeline);
    server = new (server_place.data()) Server(setup, joints, poses, mailboxes);
    ASSERT_OK(start_armed(executive, 1'000'000, now_ns));
    cycle();
    server->work(now_ns);
  }
  /// One cycle, as RunLoop runs it for a server.
  void cycle() {
    now_ns += 1'000'000;
    endpoint->work(executive.cycle({now_ns}));
    endpoint->publish({now_ns});
  }
  /// Connects a client that has said Hello.
  void welcome(TestClient& client, const char* name) {
    client.connect(*this, *server);
    client.hello(name);
    server->work(now_ns);
    client.read();
    assert_int_equal(client.welcomes, 1);
  }
};

}  // namespace tactus
