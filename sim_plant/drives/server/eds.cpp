#include "sim_plant/drives/server/eds.hpp"

#include <cinttypes>

#include "sim_plant/drives/object_access.hpp"

namespace tactus::drives {
namespace {

struct Name {
  std::uint16_t index;
  const char* text;
};
constexpr Name kNames[] = {
    {0x1000, "Device type"},
    {0x1001, "Error register"},
    {0x1003, "Pre-defined error field"},
    {0x1005, "COB-ID SYNC"},
    {0x1006, "Communication cycle period"},
    {0x1007, "Synchronous window length"},
    {0x1008, "Manufacturer device name"},
    {0x1009, "Manufacturer hardware version"},
    {0x100A, "Manufacturer software version"},
    {0x1010, "Store parameters"},
    {0x1014, "COB-ID EMCY"},
    {0x1015, "Inhibit time EMCY"},
    {0x1016, "Consumer heartbeat time"},
    {0x1017, "Producer heartbeat time"},
    {0x1018, "Identity object"},
    {0x1019, "Synchronous counter overflow value"},
    {0x1029, "Error behaviour"},
    {0x1200, "SDO server parameter"},
    {0x2003, "Maker's parameters"},
    {0x6007, "Abort connection option code"},
    {0x603F, "Error code"},
    {0x6040, "Controlword"},
    {0x6041, "Statusword"},
    {0x605A, "Quick stop option code"},
    {0x605B, "Shutdown option code"},
    {0x605C, "Disable operation option code"},
    {0x605D, "Halt option code"},
    {0x605E, "Fault reaction option code"},
    {0x6060, "Modes of operation"},
    {0x6061, "Modes of operation display"},
    {0x6064, "Position actual value"},
    {0x6065, "Following error window"},
    {0x6066, "Following error time out"},
    {0x606C, "Velocity actual value"},
    {0x6071, "Target torque"},
    {0x6072, "Max torque"},
    {0x6074, "Torque demand"},
    {0x6075, "Motor rated current"},
    {0x6076, "Motor rated torque"},
    {0x6077, "Torque actual value"},
    {0x6078, "Current actual value"},
    {0x6079, "DC link circuit voltage"},
    {0x607A, "Target position"},
    {0x607D, "Software position limit"},
    {0x6080, "Max motor speed"},
    {0x6084, "Profile deceleration"},
    {0x6085, "Quick stop deceleration"},
    {0x608F, "Position encoder resolution"},
    {0x6091, "Gear ratio"},
    {0x60A8, "SI unit position"},
    {0x60A9, "SI unit velocity"},
    {0x60B0, "Position offset"},
    {0x60B1, "Velocity offset"},
    {0x60B2, "Torque offset"},
    {0x60C2, "Interpolation time period"},
    {0x60F4, "Following error actual value"},
    {0x60FD, "Digital inputs"},
    {0x60FE, "Digital outputs"},
    {0x60FF, "Target velocity"},
    {0x6502, "Supported drive modes"},
};

void print_name(std::FILE* file, std::uint16_t index) {
  for (const Name& name : kNames)
    if (name.index == index) std::fprintf(file, "ParameterName=%s\n", name.text);
  const bool in = index < can::kTpdoCommunication, mapping = (index & 0x0200) != 0;
  if (index >= can::kRpdoCommunication && index < 0x1C00)
    std::fprintf(file, "ParameterName=%s %d %s parameter\n", in ? "RPDO" : "TPDO",
                 (index & 0xFF) + 1, mapping ? "mapping" : "communication");
}

void print_default(std::FILE* file, const Row& row) {
  ObjectBytes bytes;
  if (row.type == Type::kText) {
    static Dictionary dictionary;
    if (read_object(dictionary, row.index, 0, bytes) == can::SdoAbort::kNone)
      std::fprintf(file, "DefaultValue=%.*s\n", static_cast<int>(bytes.size),
                   reinterpret_cast<const char*>(bytes.data.data()));
  } else if ((row.access & kAddNode) != 0) {
    std::fprintf(file, "DefaultValue=$NODEID+0x%" PRIX64 "\n",
                 static_cast<std::uint64_t>(row.value));
  } else {
    std::fprintf(file, "DefaultValue=%" PRId64 "\n", row.value);
  }
}

void print_variable(std::FILE* file, const Row& row) {
  constexpr int kCodes[] = {0x05, 0x06, 0x07, 0x02, 0x03, 0x04, 0x09};  // in the order of Type
  const bool in = (row.access & kRpdo) != 0, out = (row.access & kTpdo) != 0;
  const char* access = (row.access & kWrite) == 0 ? "ro" : in && !out ? "rww" : "rw";
  std::fprintf(file, "ObjectType=0x7\nDataType=0x%04X\nAccessType=%s\n",
               kCodes[static_cast<int>(row.type)], access);
  print_default(file, row);
  std::fprintf(file, "PDOMapping=%d\n", in || out ? 1 : 0);
  if (row.low <= row.high)
    std::fprintf(file, "LowLimit=%" PRId64 "\nHighLimit=%" PRId64 "\n", row.low, row.high);
}

void print_object(std::FILE* file, std::uint16_t index) {
  int subs = 0, last = 0;
  for (const Row& row : kRows) {
    if (row.index != index) continue;
    subs += row.last - row.first + 1;
    last = row.last;
  }
  std::fprintf(file, "\n[%04X]\n", index);
  print_name(file, index);
  const bool variable = last == 0;
  if (!variable) std::fprintf(file, "ObjectType=0x9\nSubNumber=%d\n", subs);
  for (const Row& row : kRows) {
    if (row.index != index) continue;
    if (variable) print_variable(file, row);
    for (int sub = row.first; sub <= row.last && !variable; ++sub) {
      std::fprintf(file, "\n[%04Xsub%X]\n", index, static_cast<unsigned>(sub));
      if (sub == 0)
        std::fprintf(file, "ParameterName=Highest sub-index supported\n");
      else
        std::fprintf(file, "ParameterName=Sub-index %d\n", sub);
      print_variable(file, row);
    }
  }
}

bool is_mandatory(std::uint16_t index) {
  return index == can::kDeviceType || index == can::kErrorRegister || index == can::kIdentity;
}

void print_list(std::FILE* file, const char* name, bool mandatory) {
  for (const bool counts : {true, false}) {
    int count = 0;
    std::uint16_t before = 0;
    for (const Row& row : kRows) {
      if (row.index == before || is_mandatory(row.index) != mandatory) continue;
      before = row.index;
      ++count;
      if (!counts) std::fprintf(file, "%d=0x%04X\n", count, row.index);
    }
    if (counts) std::fprintf(file, "\n[%s]\nSupportedObjects=%d\n", name, count);
  }
}

}  // namespace

bool print_eds(std::FILE* file) {
  std::fputs(
      "[FileInfo]\nFileName=fer_drives.eds\nFileVersion=1\nFileRevision=0\nEDSVersion=4.0\n"
      "Description=Emulated servo drive\n\n"
      "[DeviceInfo]\nVendorName=Tactus\nVendorNumber=0x5443\nProductName=Emulated servo drive\n"
      "ProductNumber=402\nRevisionNumber=0x10000\nBaudRate_1000=1\nSimpleBootUpMaster=0\n"
      "SimpleBootUpSlave=1\nGranularity=8\nDynamicChannelsSupported=0\nGroupMessaging=0\n"
      "NrOfRXPDO=4\nNrOfTXPDO=4\nLSS_Supported=0\n\n"
      "[DummyUsage]\nDummy0001=0\nDummy0002=1\nDummy0003=1\nDummy0004=1\nDummy0005=1\n"
      "Dummy0006=1\nDummy0007=1\n",
      file);
  print_list(file, "MandatoryObjects", true);
  print_list(file, "OptionalObjects", false);
  std::fputs("\n[ManufacturerObjects]\nSupportedObjects=0\n", file);
  std::uint16_t before = 0;
  for (const Row& row : kRows) {
    if (row.index == before) continue;
    before = row.index;
    print_object(file, row.index);
  }
  return std::fflush(file) == 0;
}

}  // namespace tactus::drives
