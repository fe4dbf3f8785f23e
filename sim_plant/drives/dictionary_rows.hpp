// The objects of an emulated drive (CiA 301, 7.5; CiA 402, 10 and 11): index, sub-indices, type,
// access, default and range. The only list of them.
#pragma once

#include <cstdint>

namespace tactus::drives {

enum class Type : std::uint8_t { kU8, kU16, kU32, kI8, kI16, kI32, kText };

// Access to an object.
inline constexpr std::uint8_t kRead = 1, kWrite = 2, kReadWrite = kRead | kWrite;
inline constexpr std::uint8_t kRpdo = 4, kTpdo = 8;  ///< may be mapped to a PDO
inline constexpr std::uint8_t kAddNode = 16;         ///< the default is that of the row + node
inline constexpr std::uint8_t kAtRest = 32;          ///< writable unless operation is enabled

/// The sub-indices `first` to `last` of one object, all alike.
struct Row {
  std::uint16_t index;
  std::uint8_t first, last;
  Type type;
  std::uint8_t access;
  std::int64_t value = 0;           ///< the default
  std::int64_t low = 0, high = -1;  ///< the range; without one, that of the type
};

inline constexpr int kPdos = 4;               ///< RPDOs, and as many TPDOs
inline constexpr int kMappable = 64;          ///< entries of a PDO's mapping
inline constexpr int kErrorsKept = 8;         ///< of the error history
inline constexpr int kHeartbeatsWatched = 4;  ///< entries of 1016h

inline constexpr std::int64_t kInvalid = 0x80000000, kNoRemote = 0x40000000;

// clang-format off
#define TACTUS_RPDO(n, id, entry, count)                             \
  {0x1400 + (n), 0, 0, Type::kU8, kRead, 5},                         \
  {0x1400 + (n), 1, 1, Type::kU32, kReadWrite | kAddNode, id},       \
  {0x1400 + (n), 2, 2, Type::kU8, kReadWrite, 255},                  \
  {0x1400 + (n), 3, 3, Type::kU16, kReadWrite},                      \
  {0x1400 + (n), 5, 5, Type::kU16, kReadWrite},                      \
  {0x1600 + (n), 0, 0, Type::kU8, kReadWrite, count, 0, kMappable},  \
  {0x1600 + (n), 1, 1, Type::kU32, kReadWrite, entry},               \
  {0x1600 + (n), 2, kMappable, Type::kU32, kReadWrite}
#define TACTUS_TPDO(n, id, entry, count)                                         \
  {0x1800 + (n), 0, 0, Type::kU8, kRead, 6},                                     \
  {0x1800 + (n), 1, 1, Type::kU32, kReadWrite | kAddNode, kNoRemote | (id)},     \
  {0x1800 + (n), 2, 2, Type::kU8, kReadWrite, 255},                              \
  {0x1800 + (n), 3, 3, Type::kU16, kReadWrite},                                  \
  {0x1800 + (n), 5, 5, Type::kU16, kReadWrite},                                  \
  {0x1800 + (n), 6, 6, Type::kU8, kReadWrite, 0, 0, 240},                        \
  {0x1A00 + (n), 0, 0, Type::kU8, kReadWrite, count, 0, kMappable},              \
  {0x1A00 + (n), 1, 1, Type::kU32, kReadWrite, entry},                           \
  {0x1A00 + (n), 2, kMappable, Type::kU32, kReadWrite}
// clang-format on

/// The defaults of torque, speed and resolution are joint 1's of the FER; a drive's settings
/// replace them.
inline constexpr Row kRows[] = {
    {0x1000, 0, 0, Type::kU32, kRead, 0x00020192},
    {0x1001, 0, 0, Type::kU8, kRead | kTpdo},
    {0x1003, 0, 0, Type::kU8, kReadWrite, 0, 0, 0},
    {0x1003, 1, kErrorsKept, Type::kU32, kRead},
    {0x1005, 0, 0, Type::kU32, kReadWrite, 0x80},
    {0x1006, 0, 0, Type::kU32, kReadWrite},
    {0x1007, 0, 0, Type::kU32, kReadWrite},
    {0x1008, 0, 0, Type::kText, kRead},
    {0x1009, 0, 0, Type::kText, kRead},
    {0x100A, 0, 0, Type::kText, kRead},
    {0x1010, 0, 0, Type::kU8, kRead, 1},
    {0x1010, 1, 1, Type::kU32, kReadWrite, 1},  // stores on command
    {0x1014, 0, 0, Type::kU32, kReadWrite | kAddNode, 0x80},
    {0x1015, 0, 0, Type::kU16, kReadWrite},
    {0x1016, 0, 0, Type::kU8, kRead, kHeartbeatsWatched},
    {0x1016, 1, kHeartbeatsWatched, Type::kU32, kReadWrite, 0, 0, 0x007FFFFF},
    {0x1017, 0, 0, Type::kU16, kReadWrite},
    {0x1018, 0, 0, Type::kU8, kRead, 4},
    {0x1018, 1, 1, Type::kU32, kRead, 0x00005443},  // no vendor's number; "TC"
    {0x1018, 2, 2, Type::kU32, kRead, 402},
    {0x1018, 3, 3, Type::kU32, kRead, 0x00010000},
    {0x1018, 4, 4, Type::kU32, kRead | kAddNode, 1000},
    {0x1019, 0, 0, Type::kU8, kReadWrite, 0, 0, 240},
    {0x1029, 0, 0, Type::kU8, kRead, 1},
    {0x1029, 1, 1, Type::kU8, kReadWrite, 0, 0, 2},
    {0x1200, 0, 0, Type::kU8, kRead, 2},
    {0x1200, 1, 1, Type::kU32, kRead | kAddNode, 0x600},
    {0x1200, 2, 2, Type::kU32, kRead | kAddNode, 0x580},
    TACTUS_RPDO(0, 0x200, 0x60400010, 1),
    TACTUS_RPDO(1, kInvalid | 0x300, 0, 0),
    TACTUS_RPDO(2, kInvalid | 0x400, 0, 0),
    TACTUS_RPDO(3, kInvalid | 0x500, 0, 0),
    TACTUS_TPDO(0, 0x180, 0x60410010, 1),
    TACTUS_TPDO(1, kInvalid | 0x280, 0, 0),
    TACTUS_TPDO(2, kInvalid | 0x380, 0, 0),
    TACTUS_TPDO(3, kInvalid | 0x480, 0, 0),
    // A maker's own: of each type, of a range, of what a drive does not keep as it is written.
    {0x2003, 0, 0, Type::kU8, kRead, 5},
    {0x2003, 1, 1, Type::kU16, kReadWrite, 3},
    {0x2003, 2, 2, Type::kI32, kReadWrite, -40, -1000, 1000},
    {0x2003, 3, 3, Type::kU32, kReadWrite, 0x3F000000},  // a float, 0.5
    {0x2003, 4, 4, Type::kU8, kRead, 7},
    {0x2003, 5, 5, Type::kI8, kReadWrite, 2},  // keeps even numbers
    {0x6007, 0, 0, Type::kI16, kReadWrite, 1, 0, 3},
    {0x603F, 0, 0, Type::kU16, kRead | kTpdo},
    {0x6040, 0, 0, Type::kU16, kReadWrite | kRpdo | kTpdo},
    {0x6041, 0, 0, Type::kU16, kRead | kTpdo},
    {0x605A, 0, 0, Type::kI16, kReadWrite, 2, 0, 8},
    {0x605B, 0, 0, Type::kI16, kReadWrite, 0, 0, 1},
    {0x605C, 0, 0, Type::kI16, kReadWrite, 1, 0, 1},
    {0x605D, 0, 0, Type::kI16, kReadWrite, 1, 1, 4},
    {0x605E, 0, 0, Type::kI16, kReadWrite, 2, 0, 4},
    {0x6060, 0, 0, Type::kI8, kReadWrite | kRpdo | kTpdo},
    {0x6061, 0, 0, Type::kI8, kRead | kTpdo},
    {0x6064, 0, 0, Type::kI32, kRead | kTpdo},
    {0x6065, 0, 0, Type::kU32, kReadWrite, 534000},  // 0.2 rad
    {0x6066, 0, 0, Type::kU16, kReadWrite},
    {0x606C, 0, 0, Type::kI32, kRead | kTpdo},
    {0x6071, 0, 0, Type::kI16, kReadWrite | kRpdo | kTpdo},
    {0x6072, 0, 0, Type::kU16, kReadWrite | kRpdo, 29000},
    {0x6074, 0, 0, Type::kI16, kRead | kTpdo},
    {0x6075, 0, 0, Type::kU32, kReadWrite | kAtRest, 1000},
    {0x6076, 0, 0, Type::kU32, kReadWrite | kAtRest, 3000, 1, 1000000},
    {0x6077, 0, 0, Type::kI16, kRead | kTpdo},
    {0x6078, 0, 0, Type::kI16, kRead | kTpdo},
    {0x6079, 0, 0, Type::kU32, kRead | kTpdo, 48000},
    {0x607A, 0, 0, Type::kI32, kReadWrite | kRpdo | kTpdo},
    {0x607C, 0, 0, Type::kI32, kReadWrite},
    {0x607D, 0, 0, Type::kU8, kRead, 2},
    {0x607D, 1, 1, Type::kI32, kReadWrite, -2147483647 - 1},
    {0x607D, 2, 2, Type::kI32, kReadWrite, 2147483647},
    {0x6080, 0, 0, Type::kU32, kReadWrite, 30, 1, 100000},
    {0x6084, 0, 0, Type::kU32, kReadWrite | kRpdo, 26702000, 1},  // 10 rad/s^2
    {0x6085, 0, 0, Type::kU32, kReadWrite | kRpdo, 26702000, 1},
    {0x608F, 0, 0, Type::kU8, kRead, 2},
    {0x608F, 1, 1, Type::kU32, kReadWrite | kAtRest, 16777216, 1},
    {0x608F, 2, 2, Type::kU32, kReadWrite | kAtRest, 1, 1},
    {0x6091, 0, 0, Type::kU8, kRead, 2},
    {0x6091, 1, 1, Type::kU32, kReadWrite | kAtRest, 1, 1},
    {0x6091, 2, 2, Type::kU32, kReadWrite | kAtRest, 1, 1},
    {0x6098, 0, 0, Type::kI8, kReadWrite, 0, -128, 37},
    {0x6099, 0, 0, Type::kU8, kRead, 2},
    {0x6099, 1, 1, Type::kU32, kReadWrite, 534000},  // 0.2 rad/s
    {0x6099, 2, 2, Type::kU32, kReadWrite, 53400},
    {0x60A8, 0, 0, Type::kU32, kRead, 0x00B50000},                 // increments
    {0x60A9, 0, 0, Type::kU32, kReadWrite | kAtRest, 0x00B50300},  // increments/s, or revolutions
    {0x60B0, 0, 0, Type::kI32, kReadWrite | kRpdo | kTpdo},
    {0x60B1, 0, 0, Type::kI32, kReadWrite | kRpdo | kTpdo},
    {0x60B2, 0, 0, Type::kI16, kReadWrite | kRpdo | kTpdo},
    {0x60C2, 0, 0, Type::kU8, kRead, 2},
    {0x60C2, 1, 1, Type::kU8, kReadWrite | kAtRest, 1, 1},
    {0x60C2, 2, 2, Type::kI8, kReadWrite | kAtRest, -3, -6, 0},
    {0x60F4, 0, 0, Type::kI32, kRead | kTpdo},
    {0x60FD, 0, 0, Type::kU32, kRead | kTpdo},
    {0x60FE, 0, 0, Type::kU8, kRead, 2},
    {0x60FE, 1, 1, Type::kU32, kReadWrite | kRpdo | kTpdo},  // bit 0: the brake is closed
    {0x60FE, 2, 2, Type::kU32, kReadWrite},
    {0x60FF, 0, 0, Type::kI32, kReadWrite | kRpdo | kTpdo},
    {0x6502, 0, 0, Type::kU32, kRead | kTpdo, 0x3A0},
};
#undef TACTUS_RPDO
#undef TACTUS_TPDO

}  // namespace tactus::drives
