// CanSettings: the [can] section of a pipeline file, the buses and the nodes of the drives.
#pragma once

#include "kernel/core/describe.hpp"
#include "kernel/core/load_error.hpp"
#include "kernel/core/types.hpp"

namespace tactus::can {

enum class Frames : std::uint8_t {
  kClassic,  ///< up to 8 bytes
  kFd,       ///< process data in CAN FD frames, SDO in classic ones
};

constexpr const char* name(Frames frames) {
  switch (frames) {
    case Frames::kClassic: return "classic";
    case Frames::kFd: return "fd";
  }
  return nullptr;
}

enum class Commands : std::uint8_t {
  kPlain,   ///< a frame for every drive
  kPacked,  ///< one frame for all drives of a bus; only torques
};

constexpr const char* name(Commands commands) {
  switch (commands) {
    case Commands::kPlain: return "plain";
    case Commands::kPacked: return "packed";
  }
  return nullptr;
}

struct CanSettings {
  static constexpr const char* kSection = "can";  ///< of the pipeline file

  Value interfaces;                       ///< names of the buses, "can0 can1"; must be given
  JointVector bus = JointVector::Ones();  ///< of each joint, from 1
  JointVector node = JointVector::LinSpaced(1, kDof);  ///< of each joint's drive
  int master_node = 127;                               ///< in our heartbeat
  Frames frames = Frames::kClassic;
  Commands commands = Commands::kPlain;
  int bitrate_kbit = 1000, data_bitrate_kbit = 5000;
  double load_share = 0.8;  ///< most of the period that the frames of a cycle may take
  int boot_ms = 3000;       ///< longest time from a reset to the boot-up message
  int sdo_ms = 500;         ///< longest time for an answer to an SDO request
  int connect_ms = 20000;   ///< longest time of the whole start-up
  int heartbeat_ms = 50;    ///< of the drives and of ours; missing for three of them: lost
  /// After which a drive without commands goes to fault; 0: ten periods.
  int command_timeout_ms = 0;
  double vendor = 0, product = 0;  ///< 1018h:1 and :2 of every drive; 0: any

  /// Time-out of the commands, ms. [init]
  int timeout_ms(int period_us) const {
    return command_timeout_ms > 0 ? command_timeout_ms : (10 * period_us + 999) / 1000;
  }

  template <class Visitor>
  void describe(Visitor& visit) {
    visit.text("interfaces", interfaces, "the buses, as `ip link` shows them");
    visit.param("bus", bus, Range{1.0, 4.0}, "1");
    visit.param("node", node, Range{1.0, 127.0}, "1");
    visit.param("master_node", master_node, Range{1.0, 127.0}, "1");
    visit.choice("frames", frames);
    visit.choice("commands", commands);
    visit.param("bitrate_kbit", bitrate_kbit, Range{10.0, 1000.0}, "kbit/s");
    visit.param("data_bitrate_kbit", data_bitrate_kbit, Range{10.0, 12000.0}, "kbit/s");
    visit.param("load_share", load_share, Range{0.01, 1.0}, "1");
    visit.param("boot_ms", boot_ms, Range{10.0, 60000.0}, "ms");
    visit.param("sdo_ms", sdo_ms, Range{1.0, 10000.0}, "ms");
    visit.param("connect_ms", connect_ms, Range{10.0, 120000.0}, "ms");
    visit.param("heartbeat_ms", heartbeat_ms, Range{1.0, 10000.0}, "ms");
    visit.param("command_timeout_ms", command_timeout_ms, Range{0.0, 10000.0}, "ms");
    visit.param("vendor", vendor, Range{0.0, 4294967295.0}, "1");
    visit.param("product", product, Range{0.0, 4294967295.0}, "1");
  }
};

}  // namespace tactus::can
