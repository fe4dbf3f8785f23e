// CyclicFrame: the frame of a cycle and its return.
//
//   LRW   the process data of all drives; where one of them cannot, for all instead:
//     LRD   the inputs, and then
//     LWR   the outputs
//   FRMW  0910h: the reference clock, which all others follow
//   FPRD  0130h: state and status code of one slave after the other
//   ...   one datagram to a mailbox, or to request a state
//
// The inputs are taken only if the working counter shows that every drive has read and written: a
// drive that has not leaves the bytes that were sent, which would pass for inputs.
#pragma once

#include "hal/ethercat/exchange.hpp"
#include "hal/ethercat/startup.hpp"

namespace tactus::ethercat {

/// Counters of frames and of their errors since the start.
struct LineCounts {
  std::int64_t frames = 0;   ///< sent
  std::int64_t lost = 0;     ///< did not return before the next
  std::int64_t late = 0;     ///< returned after the next was sent
  std::int64_t counter = 0;  ///< returned with a wrong working counter
  std::int64_t strange = 0;  ///< foreign or incomplete
};

class CyclicFrame {
 public:
  enum class Arrival : std::uint8_t { kNothing, kWrongCounter, kInputs };

  void start(const ImageShape& image, bool has_clock, const std::uint8_t* source);
  /// Bytes of data that `extra` may have. [cyclic]
  std::size_t room() const { return room_; }
  std::uint8_t* image() { return image_.data(); }
  const std::uint8_t* inputs() const { return received_.data(); }

  /// Composes the next frame; `asked` is the station whose state is read. [cyclic]
  void compose(std::uint16_t asked, const Request& extra, Frame& frame);
  /// Takes any frame. [cyclic]
  void receive(Frame& frame);
  bool awaits() const { return sent_ && !came_; }
  /// Frames in a row that did not return before the next. [any]
  int missing() const { return missing_; }
  /// Closes the cycle and returns the arrival of its frame. [cyclic]
  Arrival close();

  // Contents of the returned frame; valid unless close() gave kNothing. [cyclic]
  std::int64_t reference_ns() const { return reference_ns_; }
  bool has_reference() const { return has_reference_; }
  int asked_counter() const { return asked_counter_; }
  std::uint16_t asked_status() const { return asked_status_; }
  std::uint16_t asked_code() const { return asked_code_; }
  Answer extra() const { return {extra_counter_, extra_.data()}; }

  /// True if every drive has read and written its process data. [cyclic]
  bool exchanged() const;
  /// "the working counter of LRW is 18, expected 21". [any]
  Message counter_text() const;
  const LineCounts& counts() const { return counts_; }

 private:
  enum class PartKind : std::uint8_t { kImage, kClock, kAsked, kExtra };
  /// A datagram of the frame.
  struct Part {
    PartKind kind = PartKind::kExtra;
    Command command = Command::kNop;
    std::uint32_t address = 0;
    std::size_t size = 0;
    int counter = 0;  // working counter of the returned datagram
  };
  static constexpr std::size_t kMostParts = 5;

  void add(PartKind kind, Command command, std::uint32_t address, std::size_t size);
  bool take(const Datagram& datagram, Part& part);

  std::uint8_t source_[6] = {};
  std::array<Part, kMostParts> parts_{};  // of the frame, in their order
  std::size_t count_ = 0, in_frame_ = 0, room_ = 0;
  bool has_clock_ = false, sent_ = false, came_ = false;
  std::uint8_t index_ = 0;
  std::array<std::uint8_t, kMostImage> image_{}, received_{};
  std::array<std::uint8_t, Request::kKept> extra_{};
  std::int64_t reference_ns_ = 0;
  bool has_reference_ = false;
  std::uint16_t asked_status_ = 0, asked_code_ = 0;
  int asked_counter_ = 0, extra_counter_ = 0;
  int missing_ = 0;
  LineCounts counts_;
};

}  // namespace tactus::ethercat
