// RunRecording: the rows and events of a run as an MCAP file. Every recorded output has a channel
// "block.port", whose messages have the time and a named number for each column of log.csv; the
// changes of rung and phase, the reports on the trajectory and the result are messages of /event,
// tactus.Event of gateway/tactus.proto. Times are those of the log.
#pragma once

#include <array>

#include "gateway/mcap_writer.hpp"
#include "kernel/core/mailbox.hpp"
#include "program/results/result_file.hpp"
#include "program/results/summary.hpp"
#include "program/session/session.hpp"

namespace tactus {

class RunRecording {
 public:
  /// Creates the file and the channels. False: prints the reason to stderr. [init]
  bool open(const char* path, const Session& session);

  /// Note a change of the phase of the reference, and a report. [cyclic]
  void watch(const MotionState& motion);
  void watch(const Report& report);

  /// Writes one row of the recorder. [any, one thread]
  void write_row(const double* row);
  /// Writes the events since the last call. [any, the same thread]
  void write_events();
  /// Writes the result and closes the file. False if something could not be written: prints the
  /// reason to stderr.
  bool close(const RunResult& result);

 private:
  struct Note {
    double time_s;
    const char *name, *text;
    Status status;
  };
  void write_event(double time_s, const char* name, Status status, std::string_view text);

  const Session* session_ = nullptr;
  ResultFile file_{"--record"};
  McapWriter writer_;
  McapWriter::Id event_channel_ = 0;
  std::array<McapWriter::Id, kMaxSignals> channels_{};
  Mailbox<Note, 64> notes_;  // what the cycle has noted; a full one loses the newest
  const char* phase_ = nullptr;
  std::uint32_t ladder_events_ = 0;  // that are written
};

}  // namespace tactus
