// Startup: takes the drives from power-on to cyclic operation, one stage after the other:
//
//   reset     NMT reset communication; every node answers with its boot-up message
//   identify  NMT pre-operational; the identity of every node is read by SDO. All must be those of
//             the file before anything is written to a drive
//   setup     the other steps of NodeSetup for one node after the other, by SDO
//   start     NMT start; every node's heartbeat reports "operational"
//   sync      a SYNC in every period, until all nodes have sent feedback in kSteady cycles in a row
//
// It neither waits nor reads a clock: advance() is called with the time until it does not return
// kArming. No drive is enabled.
#pragma once

#include "hal/can/node.hpp"
#include "hal/can/node_setup.hpp"
#include "hal/can/sdo_client.hpp"
#include "hal/cia402/line_writer.hpp"

namespace tactus::can {

class Startup {
 public:
  static constexpr int kSteady = 5;                         ///< cycles
  static constexpr std::int64_t kSettled_ns = 100'000'000;  ///< without a further boot-up message

  Startup(Nodes& nodes, Outboxes& out, SdoClient& sdo,
          const std::array<Name, kMaxBuses>& interfaces, Message& why)
      : nodes_(nodes), out_(out), sdo_(sdo), interfaces_(interfaces), why_(why) {}

  /// Begins with the reset. The settings must outlive the start-up. [init]
  void begin(const CanSettings& can, const cia402::Cia402Settings& drive, const PdoLayout& layout,
             CommandMode mode, int period_us, int buses, std::int64_t now_ns);
  /// Takes the next step that is possible now. kArming: it continues; kBusTimeout, kRefusedByRobot,
  /// with the reason. [init]
  Status advance(std::int64_t now_ns);
  /// Values read from the drives. [init]
  const cia402::StartupFindings& findings() const { return findings_; }
  /// Bus that answers are awaited from. [init]
  int bus() const { return bus_; }

 private:
  enum class Stage : std::uint8_t { kReset, kIdentify, kSetup, kStart, kSync, kDone };

  Status reset(std::int64_t now_ns);
  Status setup(std::int64_t now_ns);
  Status start(std::int64_t now_ns);
  Status sync(std::int64_t now_ns);
  void enter(Stage stage, std::int64_t now_ns);
  void list_steps();
  int steps_end() const;
  void leave_out();
  void ask(std::int64_t now_ns);
  Status next_step(std::int64_t now_ns);
  Status finish_step(std::int64_t now_ns);
  bool is_left_out(const SetupStep& step) const;
  Status finish_line(std::int64_t now_ns);
  Status judge_value(const SetupStep& step, std::int64_t now_ns);
  Status judge_fact(std::uint32_t row);
  Status unwatched();
  Status silent(int joint, const char* what, int limit_ms);

  Nodes& nodes_;
  Outboxes& out_;
  SdoClient& sdo_;
  const std::array<Name, kMaxBuses>& interfaces_;
  Message& why_;
  const CanSettings* can_ = nullptr;
  const cia402::Cia402Settings* drive_ = nullptr;
  const PdoLayout* layout_ = nullptr;
  CommandMode mode_ = CommandMode::kEffort;
  int period_us_ = 1, buses_ = 0, bus_ = 0;

  Stage stage_ = Stage::kReset;
  std::int64_t since_ns_ = 0;  // in this stage
  int joint_ = 0;              // being identified or set up
  int step_ = 0;
  std::int64_t step_ns_ = 0;    // when the step began
  bool watched_ = false;        // the drive has a watchdog of its own
  int boot_ups_ = 0;            // of all nodes since the reset
  std::int64_t booted_ns_ = 0;  // time of the last boot-up
  NodeSetup steps_;
  cia402::DriveFacts facts_;  // of joint_
  cia402::LineWriter lines_;
  cia402::StartupFindings findings_;
  std::int64_t sync_ns_ = 0;  // of the last SYNC
  int steady_ = 0;            // cycles in a row with feedback of all
};

}  // namespace tactus::can
