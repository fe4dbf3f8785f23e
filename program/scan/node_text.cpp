#include "program/scan/node_text.hpp"

#include <algorithm>

#include "hal/cia402/protocol.hpp"
#include "hal/cia402/protocol_errors.hpp"

namespace tactus {
namespace {

using can::Item;
using can::NodeReport;
using can::PdoReport;

/// Short names of the modes of operation, mode 1 first (CiA 402, 6502h).
constexpr const char* kModes[] = {"pp", "vl", "pv", "tq", "", "hm", "ip", "csp", "csv", "cst"};
constexpr int kModeCount = static_cast<int>(std::size(kModes));

struct ObjectName {
  cia402::Object object;
  const char* name;
};
constexpr ObjectName kObjectNames[] = {
    {cia402::kErrorCode, "error code"},
    {cia402::kControlword, "controlword"},
    {cia402::kStatusword, "statusword"},
    {cia402::kModeOfOperation, "mode of operation"},
    {cia402::kModeDisplay, "display of the mode"},
    {cia402::kPositionActual, "position"},
    {cia402::kVelocityActual, "velocity"},
    {cia402::kTorqueActual, "torque"},
    {cia402::kTargetPosition, "target position"},
    {cia402::kTargetVelocity, "target velocity"},
    {cia402::kTargetTorque, "target torque"},
    {cia402::kVelocityOffset, "velocity offset"},
    {cia402::kTorqueOffset, "torque offset"},
};

/// The first word of a line about a subject.
void begin(std::FILE* out, const char* subject) {
  std::fprintf(out, "  %-9s ", subject);
}

void print_label(std::FILE* out, const char* before, const NodeReport::Label& label) {
  if (!label.empty()) std::fprintf(out, "%s%s", before, label.c_str());
}

void print_number(std::FILE* out, const NodeReport& report, Item item, const char* format) {
  if (report.has(item)) std::fprintf(out, format, report.get(item));
}

void print_identity(std::FILE* out, const NodeReport& report) {
  if (!report.has(Item::kVendor)) return;
  begin(out, "identity");
  std::fprintf(out, "vendor %08Xh", report.get(Item::kVendor));
  print_number(out, report, Item::kProduct, ", product %08Xh");
  print_number(out, report, Item::kRevision, ", revision %08Xh");
  print_number(out, report, Item::kSerial, ", serial number %u");
  std::fprintf(out, "\n");
}

void print_nmt(std::FILE* out, const NodeReport& report) {
  begin(out, "NMT");
  const bool beats = report.has(Item::kHeartbeatTime) && report.get(Item::kHeartbeatTime) > 0;
  if (report.heard)
    std::fprintf(
        out, "%s",
        report.nmt == can::NmtState::kBootUp ? "booted during the scan" : name(report.nmt));
  else
    std::fprintf(out, "no heartbeat was heard%s", report.sends_pdos ? ", sends PDOs" : "");
  if (beats) std::fprintf(out, ", a heartbeat every %u ms", report.get(Item::kHeartbeatTime));
  if (report.has(Item::kHeartbeatTime) && !beats) std::fprintf(out, ", heartbeat off");
  std::fprintf(out, "\n");
}

void print_mode(std::FILE* out, const NodeReport& report) {
  if (report.has(Item::kModeDisplay)) {
    const int mode = static_cast<std::int8_t>(report.get(Item::kModeDisplay));
    std::fprintf(out, ", mode %d", mode);
    if (mode >= 1 && mode <= kModeCount) std::fprintf(out, " %s", kModes[mode - 1]);
  }
  if (!report.has(Item::kSupportedModes)) return;
  std::fprintf(out, "; supports");
  for (int mode = 1; mode <= kModeCount; ++mode)
    if (cia402::supports(report.get(Item::kSupportedModes), static_cast<cia402::Mode>(mode)))
      std::fprintf(out, " %s", kModes[mode - 1]);
}

void print_drive(std::FILE* out, const NodeReport& report) {
  if (report.has(Item::kStatusword)) {
    const auto word = static_cast<std::uint16_t>(report.get(Item::kStatusword));
    begin(out, "drive");
    std::fprintf(out, "%s (statusword %04Xh)", name(cia402::state_of(word)), word);
    print_mode(out, report);
    std::fprintf(out, "\n");
  }
  if (!report.has(Item::kRatedTorque) && !report.has(Item::kIncrements)) return;
  begin(out, "scaling");
  if (report.has(Item::kRatedTorque))
    std::fprintf(out, "rated torque %u mN m", report.get(Item::kRatedTorque));
  if (report.has(Item::kIncrements) && report.has(Item::kRevolutions))
    std::fprintf(out, "%s%u increments per %u revolution%s",
                 report.has(Item::kRatedTorque) ? ", " : "", report.get(Item::kIncrements),
                 report.get(Item::kRevolutions), report.get(Item::kRevolutions) == 1 ? "" : "s");
  std::fprintf(out, "\n");
}

void print_errors(std::FILE* out, const NodeReport& report) {
  if (!report.has(Item::kRegister)) return;  // every device has it
  begin(out, "errors");
  std::fprintf(out, "register %02Xh", report.get(Item::kRegister));
  if (report.has(Item::kErrorCode)) {
    const auto code = static_cast<std::uint16_t>(report.get(Item::kErrorCode));
    std::fprintf(out, ", code %04Xh %s", code, cia402::error_text(code));
  }
  print_number(out, report, Item::kErrorCount, ", %u in the history");
  std::fprintf(out, "\n");
  for (int i = 0; i < report.history_count; ++i) {
    const std::uint32_t entry = report.history[static_cast<std::size_t>(i)];
    const auto code = static_cast<std::uint16_t>(entry);
    begin(out, "");
    std::fprintf(out, "%d: %04Xh %s, additional %04Xh\n", i + 1, code, cia402::error_text(code),
                 entry >> 16);
  }
}

void print_entry(std::FILE* out, std::uint32_t entry) {
  const unsigned index = entry >> 16, sub = entry >> 8 & 0xFF, bits = entry & 0xFF;
  if (index < 0x20) {
    std::fprintf(out, " skip");
  } else {
    std::fprintf(out, " %04Xh:%u", index, sub);
    for (const ObjectName& row : kObjectNames)
      if (row.object.index == index && row.object.sub == sub) std::fprintf(out, " %s", row.name);
  }
  std::fprintf(out, " (%u)", bits);
}

void print_type(std::FILE* out, int type) {
  if (type == 0)
    std::fprintf(out, "at SYNC after an event");
  else if (type == 1)
    std::fprintf(out, "at every SYNC");
  else if (type <= 240)
    std::fprintf(out, "at every %dth SYNC", type);
  else
    std::fprintf(out, type >= 254 ? "at an event" : "on request");
}

void print_pdo(std::FILE* out, const char* direction, int number, const PdoReport& pdo) {
  char subject[16];
  std::snprintf(subject, sizeof subject, "%s %d", direction, number);
  begin(out, subject);
  std::fprintf(out, "%03Xh ", pdo.id & 0x1FFFFFFF);
  print_type(out, pdo.type);
  std::fprintf(out, ":");
  const int count = std::min(pdo.count, PdoReport::kMostEntries);
  for (int i = 0; i < count; ++i) {
    std::fprintf(out, i > 0 ? "," : "");
    print_entry(out, pdo.entries[static_cast<std::size_t>(i)]);
  }
  if (pdo.count == 0) std::fprintf(out, " nothing is mapped");
  if (pdo.count > count) std::fprintf(out, ", and %d more", pdo.count - count);
  std::fprintf(out, "\n");
}

void print_pdos(std::FILE* out, const NodeReport& report) {
  bool known = false, used = false;
  for (const bool receives : {true, false}) {
    const auto& pdos = receives ? report.rpdos : report.tpdos;
    for (int i = 0; i < NodeReport::kPdos; ++i) {
      const PdoReport& pdo = pdos[static_cast<std::size_t>(i)];
      if (pdo.valid()) print_pdo(out, receives ? "RPDO" : "TPDO", i + 1, pdo);
      known = known || pdo.known;
      used = used || pdo.valid();
    }
  }
  if (used || !known) return;
  begin(out, "PDOs");
  std::fprintf(out, "none is in use\n");
}

}  // namespace

void print_node(std::FILE* out, int node, const NodeReport& report) {
  std::fprintf(out, "node %d:", node);
  const unsigned type = report.get(Item::kType);
  if (!report.has(Item::kType))
    std::fprintf(out, " a device of unknown type");
  else if ((type & 0xFFFF) == cia402::kDriveProfile)
    std::fprintf(out, " a drive (CiA 402)");
  else
    std::fprintf(out, " a device of profile %u", type & 0xFFFF);
  print_label(out, ", ", report.label(can::Label::kName));
  print_label(out, ", hardware ", report.label(can::Label::kHardware));
  print_label(out, ", firmware ", report.label(can::Label::kFirmware));
  std::fprintf(out, "\n");
  print_identity(out, report);
  print_nmt(out, report);
  if (report.answers) {
    print_drive(out, report);
    print_errors(out, report);
    print_pdos(out, report);
  } else {
    begin(out, "SDO");
    std::fprintf(out, "it answers no request\n");
  }
  if (!report.trouble.empty()) {
    begin(out, "stopped");
    std::fprintf(out, "%s\n", report.trouble.c_str());
  }
}

}  // namespace tactus
