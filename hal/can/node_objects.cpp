// Which objects of a node a NodeScan reads, in which order, and where their values go.
#include <algorithm>
#include <string_view>

#include "hal/can/node_scan.hpp"
#include "hal/cia402/protocol.hpp"
#include "hal/net/printable.hpp"

namespace tactus::can {
namespace {

constexpr std::uint16_t kItemIndices[kItems] = {kDeviceType,
                                                kIdentity,
                                                kIdentity,
                                                kIdentity,
                                                kIdentity,
                                                kErrorRegister,
                                                kErrorHistory,
                                                kHeartbeatProducer,
                                                cia402::kErrorCode.index,
                                                cia402::kStatusword.index,
                                                cia402::kModeDisplay.index,
                                                cia402::kSupportedModes.index,
                                                cia402::kRatedTorque.index,
                                                cia402::kEncoderIncrements.index,
                                                cia402::kEncoderRevolutions.index};
constexpr std::uint8_t kItemSubs[kItems] = {0, 1, 2, 3, 4, 0, 0, 0, 0, 0, 0, 0, 0, 1, 2};
constexpr std::uint16_t kLabelIndices[kLabels] = {kDeviceName, kHardwareVersion, kSoftwareVersion};

// The steps of a PDO: its objects, then its entries.
constexpr int kId = 0, kSent = 1, kCount = 2, kFirstEntry = 3;

int items_of(const NodeReport& report) {
  const bool drive = (report.get(Item::kType) & 0xFFFF) == cia402::kDriveProfile;
  return drive ? kItems : static_cast<int>(Item::kErrorCode);
}

int history_of(const NodeReport& report) {
  const std::uint32_t kept = report.get(Item::kErrorCount) & 0xFF;
  return static_cast<int>(std::min<std::uint32_t>(kept, NodeReport::kMostHistory));
}

}  // namespace

bool NodeScan::find_object(Address& object) {
  for (; part_ != Part::kEnd; part_ = static_cast<Part>(static_cast<int>(part_) + 1), row_ = 0) {
    const auto at = static_cast<std::size_t>(row_);
    switch (part_) {
      case Part::kNumbers:
        if (row_ >= items_of(current())) continue;
        object = {kItemIndices[at], kItemSubs[at]};
        return true;
      case Part::kTexts:
        if (row_ >= kLabels) continue;
        object = {kLabelIndices[at], 0};
        return true;
      case Part::kHistory:
        if (row_ >= history_of(current())) continue;
        object = {kErrorHistory, static_cast<std::uint8_t>(row_ + 1)};
        return true;
      case Part::kRpdos:
      case Part::kTpdos:
        if (row_ >= NodeReport::kPdos) continue;
        object = pdo_object();
        return true;
      case Part::kEnd: break;
    }
  }
  return false;
}

NodeScan::Address NodeScan::pdo_object() const {
  const bool receives = part_ == Part::kRpdos;
  const int communication = (receives ? kRpdoCommunication : kTpdoCommunication) + row_;
  const int mapping = (receives ? kRpdoMapping : kTpdoMapping) + row_;
  if (step_ == kId) return {static_cast<std::uint16_t>(communication), kPdoId};
  if (step_ == kSent) return {static_cast<std::uint16_t>(communication), kPdoType};
  return {static_cast<std::uint16_t>(mapping), static_cast<std::uint8_t>(step_ - kCount)};
}

void NodeScan::keep() {
  NodeReport& report = current();
  const auto at = static_cast<std::size_t>(row_);
  switch (part_) {
    case Part::kNumbers: report.set(static_cast<Item>(row_), sdo_.value()); break;
    case Part::kTexts: {
      const std::string_view text(reinterpret_cast<const char*>(sdo_.data()), sdo_.size());
      // Some nodes send the zero at the end of a text too.
      report.labels[at] = NodeReport::Label(printable(text.substr(0, text.find('\0'))));
      break;
    }
    case Part::kHistory:
      report.history[at] = sdo_.value();
      report.history_count = row_ + 1;
      break;
    case Part::kRpdos: return keep_pdo(report.rpdos[at]);
    case Part::kTpdos: return keep_pdo(report.tpdos[at]);
    case Part::kEnd: return;
  }
  ++row_;
}

void NodeScan::keep_pdo(PdoReport& pdo) {
  const std::uint32_t value = sdo_.value();
  if (step_ == kId) {
    pdo.known = true;
    pdo.id = value;
  } else if (step_ == kSent) {
    pdo.type = static_cast<std::uint8_t>(value);
  } else if (step_ == kCount) {
    pdo.count = static_cast<int>(value & 0xFF);
  } else {
    pdo.entries[static_cast<std::size_t>(step_ - kFirstEntry)] = value;
  }
  ++step_;
  const bool complete = step_ >= kFirstEntry + std::min(pdo.count, PdoReport::kMostEntries);
  if (!pdo.valid() || (step_ >= kFirstEntry && complete)) skip();
}

/// Goes on behind an object that the node does not have.
void NodeScan::skip() {
  step_ = 0;
  row_ = part_ == Part::kHistory ? NodeReport::kMostHistory : row_ + 1;
}

}  // namespace tactus::can
