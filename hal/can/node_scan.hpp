// NodeScan: finds the nodes of a bus and reads what they say about themselves. It only reads: no
// node changes its state. Frames in, frames out, time passed in.
//
//   ask      the device type of every node, 1 to 127, a request every kSpacing_ns
//   details  the objects of each node that answered or sent heartbeats, one after the other
//   listen   until heartbeats have had their time
#pragma once

#include "hal/can/node_report.hpp"

namespace tactus::can {

struct ScanTimes {
  std::int64_t answer_ns = 100'000'000;    ///< for an SDO answer
  std::int64_t listen_ns = 1'000'000'000;  ///< for heartbeats, from the beginning
  std::int64_t whole_ns = 60'000'000'000;  ///< after which the scan ends, whatever nodes do
};

class NodeScan {
 public:
  static constexpr std::int64_t kSpacing_ns = 1'000'000;

  /// Begins a scan and discards the previous one. [init]
  void begin(const ScanTimes& times, std::int64_t now_ns);
  /// Copies the next frame to send; false: there is none now. [init]
  bool take(CanFrame& request);
  /// Takes any frame of the bus. [init]
  void receive(const CanFrame& frame, std::int64_t now_ns);
  /// Goes on; false: the scan is complete. Called at least every millisecond. [init]
  bool advance(std::int64_t now_ns);

  /// Returns the report of a node, 1 to 127. [any]
  const NodeReport& report(int node) const { return reports_[static_cast<std::size_t>(node)]; }
  /// Nodes that answered or sent heartbeats. [any]
  int count() const;

 private:
  enum class Stage : std::uint8_t { kAsk, kWait, kDetails, kListen, kDone };
  /// Groups of objects, in the order in which they are read.
  enum class Part : std::uint8_t { kNumbers, kTexts, kHistory, kRpdos, kTpdos, kEnd };

  struct Address {
    std::uint16_t index = 0;
    std::uint8_t sub = 0;
  };

  // node_scan.cpp
  void ask_next(std::int64_t now_ns);
  void read_on(std::int64_t now_ns);
  bool find_node();
  NodeReport& current() { return reports_[static_cast<std::size_t>(node_)]; }

  // node_objects.cpp
  bool find_object(Address& object);
  Address pdo_object() const;
  void keep();
  void keep_pdo(PdoReport& pdo);
  void skip();

  ScanTimes times_;
  Stage stage_ = Stage::kDone;
  std::int64_t began_ns_ = 0, asked_ns_ = 0;
  int node_ = 0;
  Part part_ = Part::kNumbers;
  int row_ = 0;   // of the part: item, label, entry, PDO
  int step_ = 0;  // of a PDO
  bool has_request_ = false;
  CanFrame request_;
  SdoClient sdo_;
  std::array<NodeReport, kMaxNode + 1> reports_;
};

}  // namespace tactus::can
