// SdoServer: the server of a drive's object dictionary (CiA 301, 7.2.4): expedited and segmented
// transfers in both directions. Block transfers are aborted, so that a client falls back.
#pragma once

#include "hal/can/protocol_frame.hpp"
#include "sim_plant/drives/object_access.hpp"

namespace tactus::drives {

/// What a request led to.
struct SdoAnswer {
  bool sent = false;     ///< `frame` is to be sent
  bool written = false;  ///< an object has a new value
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  can::CanFrame frame;
};

class SdoServer {
 public:
  /// A transfer that pauses for this long is aborted.
  static constexpr std::int64_t kTimeout_ns = 1'000'000'000;

  void reset() { transfer_ = Transfer::kNone; }

  /// Answers a request; frames that are none get no answer. [any]
  SdoAnswer receive(const can::CanFrame& request, std::int64_t now_ns, std::uint8_t node,
                    Dictionary& dictionary, const DeviceState& state);

  /// Aborts a transfer that has waited too long. [any]
  SdoAnswer advance(std::int64_t now_ns, std::uint8_t node);

  /// Returns an abort for a request, for faults that are injected. [any]
  static can::CanFrame abort_frame(std::uint8_t node, std::uint16_t index, std::uint8_t sub,
                                   can::SdoAbort code);

 private:
  enum class Transfer : std::uint8_t { kNone, kDownload, kUpload };
  struct Context {
    Dictionary& dictionary;
    const DeviceState& state;
    SdoAnswer& answer;
    std::uint8_t node;
  };

  void begin_download(const can::CanFrame& request, Context& context);
  void begin_upload(const can::CanFrame& request, Context& context);
  void take_segment(const can::CanFrame& request, Context& context);
  void give_segment(const can::CanFrame& request, Context& context);
  void finish_download(const std::uint8_t* data, std::size_t size, Context& context);
  void abort(Context& context, can::SdoAbort code);
  bool follows(const can::CanFrame& request, Transfer transfer, Context& context);

  Transfer transfer_ = Transfer::kNone;
  std::uint16_t index_ = 0;
  std::uint8_t sub_ = 0;
  bool toggle_ = false;
  std::int64_t deadline_ns_ = 0;
  ObjectBytes bytes_;     // of the transfer
  std::size_t done_ = 0;  // bytes transferred
};

}  // namespace tactus::drives
