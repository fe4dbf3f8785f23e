// BoardFeed: sends the waypoints of a file to a board, as many at a time as its window takes.
#pragma once

#include <variant>

#include "gateway/gateway_section.hpp"
#include "gateway/reference_frames.hpp"
#include "gateway/trajectory/smoothed_reader.hpp"
#include "program/pil/board_client.hpp"
#include "program/session/trajectory_input.hpp"

namespace tactus::pil {

template <class Space>
class FileFeed {
 public:
  /// Opens the file, reads it as `host` does, and begins its trajectory on the board. False:
  /// refused; `why` has the source.
  bool begin(BoardClient& board, const char* path, const GatewaySection& gateway,
             const SmoothedReader<Space>& host, Message& why);
  /// Sends what the board takes now. False: it refused. [any]
  bool feed(BoardClient& board, Message& why);

 private:
  static constexpr int kMost = 16;  // waypoints of one message

  void fill();
  int fitting() const;
  bool refused(Status status, BoardClient& board, Message& why) const;

  SmoothedReader<Space> reader_;
  CsvError error_;
  Fields fields_ = 0;
  std::array<Waypoint<Space>, kMost> next_;
  int count_ = 0;  // of next_
  bool at_end_ = false, whole_ = false;
};

/// A trajectory of either space; idle until a trajectory begins.
class BoardFeed {
 public:
  /// Begins a trajectory that this computer has read and judged. False: refused.
  bool begin(BoardClient& board, const TrajectoryInput& input, const GatewaySection& gateway,
             Message& why);
  bool feed(BoardClient& board, Message& why);

 private:
  std::variant<std::monostate, FileFeed<JointSpace>, FileFeed<TaskSpace>> file_;
};

}  // namespace tactus::pil
