// SdoClient: reads and writes one object of one node at a time, by expedited and segmented SDO
// transfers (CiA 301, 7.2.4.3). It neither sends nor waits: the caller carries frames and passes
// the time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/can/protocol_frame.hpp"
#include "hal/can/protocol_sdo.hpp"
#include "kernel/core/text.hpp"

namespace tactus::can {

/// kDone and kAborted last until the next transfer begins.
enum class Progress : std::uint8_t { kIdle, kBusy, kDone, kAborted };

constexpr const char* name(Progress progress) {
  switch (progress) {
    case Progress::kIdle: return "no transfer";
    case Progress::kBusy: return "under way";
    case Progress::kDone: return "done";
    case Progress::kAborted: return "aborted";
  }
  return nullptr;
}

struct SdoTimes {
  std::int64_t answer_ns = 500'000'000;      ///< for each answer
  std::int64_t transfer_ns = 5'000'000'000;  ///< for all answers of a transfer together
};

class SdoClient {
 public:
  static constexpr std::size_t kCapacity = 128;  ///< bytes of the longest object

  void set_times(const SdoTimes& times) { times_ = times; }

  /// Begins to write the lowest 1 to 4 bytes of `value` to an object of a node, 1 to 127. A
  /// transfer that is under way is given up: its node gets an abort. [any]
  void download(std::uint8_t node, std::uint16_t index, std::uint8_t sub, std::uint32_t value,
                std::uint8_t bytes, std::int64_t now_ns);
  /// Begins to write any bytes, which are copied. More than kCapacity: ends at once with kTooLong.
  /// [any]
  void download_bytes(std::uint8_t node, std::uint16_t index, std::uint8_t sub,
                      const std::uint8_t* bytes, std::size_t size, std::int64_t now_ns);
  /// Begins to read an object. [any]
  void upload(std::uint8_t node, std::uint16_t index, std::uint8_t sub, std::int64_t now_ns);

  /// Copies the next frame to send; false: there is none. [any]
  bool take(CanFrame& request);
  /// Takes any frame of the bus; one that is no SDO answer of the node is ignored, and so is an
  /// answer or an abort on another object. An answer that breaks the protocol ends the transfer,
  /// and the node gets an abort. [any]
  void receive(const CanFrame& frame, std::int64_t now_ns);
  /// Ends the transfer with kTimeout when its time is over. [any]
  void advance(std::int64_t now_ns);

  Progress progress() const { return progress_; }
  /// Why the transfer was aborted, by either side. [any]
  SdoAbort abort() const { return abort_; }
  /// The object that was read, after kDone. [any]
  const std::uint8_t* data() const { return data_.data(); }
  std::size_t size() const { return size_; }
  /// False for an object of up to four bytes whose node has not indicated the size. [any]
  bool size_known() const { return size_known_; }
  /// The first four bytes as an integer; bytes that the object does not have are 0. [any]
  std::uint32_t value() const { return load<std::uint32_t>(data_, 0); }
  /// Returns node, object and what became of the transfer, such as "node 3: object 6060h:0: value
  /// out of range (06090030h)". [any]
  Message describe() const;

 private:
  enum class TransferStep : std::uint8_t { kNone, kWrite, kWriteSegment, kRead, kReadSegment };
  /// Why a transfer is aborted: by the node, for its answer, for its silence, for the time of the
  /// whole, for the value to write.
  enum class Cause : std::uint8_t { kNode, kAnswer, kSilence, kTime, kValue };

  void begin(std::uint8_t node, std::uint16_t index, std::uint8_t sub, std::int64_t now_ns);
  CanFrame frame(std::uint8_t command) const;
  void ask(const CanFrame& request);
  void ask_for_segment();
  void send_expedited();
  void send_segment();
  void take_downloaded(const CanFrame& answer);
  void take_segment_downloaded(const CanFrame& answer);
  void take_uploaded(const CanFrame& answer);
  void take_segment_uploaded(const CanFrame& answer);
  void take_answer(const CanFrame& answer);
  bool names_object(const CanFrame& answer) const;
  bool is_for_object(const CanFrame& answer) const;
  void finish();
  void give_up(SdoAbort why, Cause cause = Cause::kAnswer);
  void end(SdoAbort why, Cause cause);

  SdoTimes times_;
  Progress progress_ = Progress::kIdle;
  TransferStep step_ = TransferStep::kNone;
  SdoAbort abort_ = SdoAbort::kNone;
  Cause cause_ = Cause::kNode;
  std::uint8_t node_ = 0, sub_ = 0;
  std::uint16_t index_ = 0;
  std::int64_t began_ns_ = 0, heard_ns_ = 0;
  std::array<std::uint8_t, kCapacity> data_{};
  std::size_t size_ = 0;       ///< bytes to write, or read until now
  std::size_t sent_ = 0;       ///< bytes written until now
  std::size_t announced_ = 0;  ///< size indicated by the node, bytes
  bool size_known_ = false;
  bool toggle_ = false;
  bool has_request_ = false, has_abort_ = false;
  CanFrame request_, abort_frame_;
  bool heard_other_ = false;  ///< an answer of the node on another object
  std::uint16_t other_index_ = 0;
  std::uint8_t other_sub_ = 0;
};

}  // namespace tactus::can
