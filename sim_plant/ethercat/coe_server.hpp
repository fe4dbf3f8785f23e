// CoeServer: the mailbox of an emulated drive: SDO transfers (expedited, normal, segmented), SDO
// information and emergencies (ETG.1000.6). Messages in, messages out into a queue.
#pragma once

#include "hal/ethercat/protocol_coe.hpp"
#include "hal/ethercat/protocol_frame.hpp"
#include "sim_plant/ethercat/coe_information.hpp"
#include "sim_plant/ethercat/coe_objects.hpp"

namespace tactus::segment {

/// Bytes of the longest message: what a frame has room for.
inline constexpr std::size_t kMostMailbox = ethercat::kMaxData;

struct MailboxMessage {
  std::array<std::uint8_t, kMostMailbox> bytes{};
  std::size_t size = 0;
};

/// What a message led to.
struct CoeResult {
  bool written = false;  ///< an object has a new value
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
};

class CoeServer {
 public:
  static constexpr std::size_t kQueue = 8;

  explicit CoeServer(CoeObjects& objects) : objects_(objects), information_(objects) {}

  /// Forgets transfers and messages; `bytes` is the length of the mailbox of answers. [any]
  void reset(std::size_t bytes);
  /// Takes a message from the mailbox, `size` bytes long with what follows it. [any]
  CoeResult receive(const std::uint8_t* message, std::size_t size, bool preop, bool powered);
  /// Answers all SDO requests on an index with an abort, 0: none. [any]
  void refuse(std::uint16_t index, can::SdoAbort code) {
    refused_ = index;
    refusal_ = code;
  }
  void emergency(const can::Emergency& emergency);

  /// Copies the next message to send; false: there is none. [any]
  bool take(MailboxMessage& message);

 private:
  enum class Transfer : std::uint8_t { kNone, kDownload, kUpload };

  void answer_sdo(const std::uint8_t* body, std::size_t size, CoeResult& result);
  void begin_upload();
  void give_segment(std::uint8_t command);
  void begin_download(const std::uint8_t* body, std::size_t size, CoeResult& result);
  void take_segment(const std::uint8_t* body, std::size_t size, CoeResult& result);
  void finish_download(CoeResult& result, bool segment);
  void abort(can::SdoAbort code);
  std::uint8_t* begin(std::uint16_t service, std::size_t body);
  std::uint8_t* begin_sdo(std::uint8_t command, std::size_t body);
  void error(std::uint16_t code);
  void post_information();

  CoeObjects& objects_;
  CoeInformation information_;
  std::array<MailboxMessage, kQueue> queue_;
  std::size_t first_ = 0, count_ = 0;
  std::size_t room_ = 0;      // of a mailbox
  std::uint8_t counter_ = 0;  // of the last message to the master
  std::uint8_t seen_ = 0;     // and of the last from it; 0: none
  bool preop_ = false, powered_ = false;
  Transfer transfer_ = Transfer::kNone;
  bool toggle_ = false;
  std::uint16_t index_ = 0;
  std::uint8_t sub_ = 0;
  drives::ObjectBytes data_;
  std::size_t done_ = 0, whole_ = 0;
  std::uint16_t refused_ = 0;
  can::SdoAbort refusal_ = can::SdoAbort::kNone;
};

}  // namespace tactus::segment
