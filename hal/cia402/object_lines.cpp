#include "hal/cia402/object_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "hal/cia402/hex.hpp"
#include "kernel/core/types.hpp"
#include "kernel/load/ini.hpp"
#include "kernel/load/number.hpp"

namespace tactus::cia402 {
namespace {

constexpr const char* kForm = "; a line is such as 0x2003:1 u16 5, or joint3 0x2003:1 i32 -70";

struct TypeRow {
  const char* name;
  std::uint8_t bytes;
  std::int64_t low, high;  // of whole numbers
};
constexpr TypeRow kTypes[] = {{"u8", 1, 0, 255},         {"u16", 2, 0, 65535},
                              {"u32", 4, 0, 4294967295}, {"i8", 1, -128, 127},
                              {"i16", 2, -32768, 32767}, {"i32", 4, -2147483648LL, 2147483647},
                              {"f32", 4, 0, 0}};

/// Objects that start-up and cycle write, and objects on which the safety of a drive depends.
struct ReservedObjects {
  std::uint16_t first, last;
  const char* why;
};
constexpr const char* kSync = "SYNC is this program's";
constexpr const char* kWatch = "it is part of the watch over this program";
constexpr const char* kMapping = "this program sets up the process data";
constexpr const char* kStopping = "it decides how the drive stops without this program";
constexpr const char* kCommand = "it is a command, which only the cycle gives";
constexpr const char* kSafety = "functional safety is for its maker's tool";
constexpr const char* kUnit = "it changes a unit, a sign or the zero that nobody compares";
constexpr ReservedObjects kReserved[] = {
    {0x1005, 0x1007, kSync},
    {0x100C, 0x100D, kWatch},  // node guarding
    {0x1010, 0x1010, "it stores the drive's parameters; use [cia402] store = 1"},
    {0x1011, 0x1011, "it restores the drive's defaults, which is for its maker's tool"},
    {0x1012, 0x1014, "this program relies on the default identifiers"},  // TIME, EMCY
    {0x1016, 0x1017, kWatch},
    {0x1019, 0x1019, kSync},
    {0x1024, 0x1024, kCommand},   // of the operating system
    {0x1029, 0x1029, kStopping},  // error behaviour
    {0x10F1, 0x10F1, kStopping},  // the same of EtherCAT
    {0x1200, 0x12FF, "this program relies on the default SDO channel"},
    {0x1300, 0x13FF, kSafety},
    {0x1400, 0x1BFF, kMapping},
    {0x1C00, 0x1C4F, kMapping},  // sync managers
    {0x1F00, 0x1FFF, "it starts the device, or loads its program"},
    {0x6007, 0x6007, kStopping},
    {0x6040, 0x6040, kCommand},
    {0x605A, 0x605E, kStopping},
    {0x6060, 0x6060, "[robot] decides the mode of operation"},
    {0x6071, 0x6071, kCommand},
    {0x607A, 0x607A, kCommand},
    {0x607C, 0x607C, kUnit},      // home offset
    {0x607E, 0x607E, kUnit},      // polarity
    {0x6085, 0x6085, kStopping},  // quick stop deceleration
    {0x6089, 0x608C, kUnit},
    {0x6093, 0x6095, kUnit},
    {0x6097, 0x6097, kUnit},
    {0x6098, 0x6098, "[cia402] homing_method decides it"},
    {0x60B0, 0x60B2, kCommand},  // offsets
    {0x60C1, 0x60C1, kCommand},  // interpolation data
    {0x60C2, 0x60C2, "[robot] period_us decides it"},
    {0x60C6, 0x60C6, kStopping},  // largest deceleration
    {0x60E0, 0x60E1, "it limits the torque, which is compared in 6072h alone"},
    {0x60FE, 0x60FE, "it may release the brake"},
    {0x60FF, 0x60FF, kCommand},
    {0x6600, 0x66FF, kSafety},
    {0xF000, 0xFFFF, "it configures the device as a whole"},
};

bool begins(std::string_view text, std::string_view with) {
  return text.size() >= with.size() && std::string_view(text.data(), with.size()) == with;
}

/// The digit's value; 16 for none.
int digit_of(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return 16;
}

/// A whole number, decimal or hexadecimal from 0x on; one that no type has stays beyond all.
bool read_whole(std::string_view text, std::int64_t& value) {
  constexpr std::int64_t kBeyond = std::int64_t{1} << 40;
  const bool negative = begins(text, "-");
  if (negative) text.remove_prefix(1);
  const bool hexadecimal = begins(text, "0x");
  if (hexadecimal) text.remove_prefix(2);
  const int base = hexadecimal ? 16 : 10;
  bool digits = !text.empty();
  value = 0;
  for (const char c : text) {
    digits = digits && digit_of(c) < base;
    if (value < kBeyond) value = base * value + digit_of(c);
  }
  if (negative) value = -value;
  return digits;
}

Status read_joint(std::string_view word, ObjectLine& line, Message& why) {
  std::int64_t number = 0;
  word.remove_prefix(5);
  if (!read_whole(word, number) || number < 1 || number > kDof) {
    why << "'joint" << word << "': the joints are joint1 to joint" << kDof;
    return Status::kBadValue;
  }
  line.joint = static_cast<int>(number) - 1;
  return Status::kOk;
}

Status read_object(std::string_view word, ObjectLine& line, Message& why) {
  std::size_t colon = 0;
  while (colon < word.size() && word[colon] != ':') ++colon;
  std::int64_t index = 0, sub = 0;
  std::string_view rest = word;
  rest.remove_prefix(colon < word.size() ? colon + 1 : colon);
  if (!begins(word, "0x") || !read_whole(std::string_view(word.data(), colon), index) ||
      !read_whole(rest, sub)) {
    why << "'" << word << "' is no object with its sub-index, such as 0x6065:0" << kForm;
    return Status::kBadValue;
  }
  if (index < 0x1000 || index > 0xFFFF || sub < 0 || sub > 255) {
    why << "'" << word << "' is out of range; objects are 0x1000:0 to 0xFFFF:255";
    return Status::kBadValue;
  }
  line.object = {static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub), 0};
  const char* kept = kept_by_program(line.object.index);
  if (kept == nullptr) return Status::kOk;
  why << hex(line.object.index) << " is not for a line: " << kept;
  return Status::kNotOffered;
}

Status read_type(std::string_view word, ObjectLine& line, Message& why) {
  int type = 0;
  for (const TypeRow& row : kTypes) {
    if (word == row.name) {
      line.type = static_cast<ValueType>(type);
      line.object.bytes = row.bytes;
      return Status::kOk;
    }
    ++type;
  }
  why << "unknown type '" << word << "'; expected one of u8, u16, u32, i8, i16, i32, f32";
  return Status::kBadValue;
}

/// Writes as few digits as distinguish it from all other values; nine always suffice.
void append_single(Message& text, float value) {
  constexpr int kMost = 9;
  for (int digits = 1; digits <= kMost; ++digits) {
    Text<24> written;
    double read = 0.0;
    written.append(static_cast<double>(value), digits);
    const bool same = parse_number(written, read) && static_cast<float>(read) == value;
    if (same || digits == kMost) return static_cast<void>(text << std::string_view(written));
  }
}

/// True for "0", "-0.00", "0e5".
bool is_written_as_zero(std::string_view word) {
  for (const char c : word) {
    if (c == 'e' || c == 'E') break;
    if (c >= '1' && c <= '9') return false;
  }
  return true;
}

Status read_float(std::string_view word, ObjectLine& line, Message& why) {
  constexpr float kLeast = std::numeric_limits<float>::min();
  constexpr double kMost = std::numeric_limits<float>::max(), kWrittenMost = 3.4028235e38;
  double value = 0.0;
  if (!parse_number(word, value)) {
    why << "'" << word << "' is not a finite number";
    return Status::kBadValue;
  }
  if (!(std::abs(value) <= kWrittenMost)) {
    why << "f32 " << word << " is out of range; it must be in [";
    append_single(why, static_cast<float>(-kMost));
    why << ", ";
    append_single(why, static_cast<float>(kMost));
    why << "]";
    return Status::kBadValue;
  }
  const auto single = static_cast<float>(std::clamp(value, -kMost, kMost));
  if (!(std::abs(single) >= kLeast) && !is_written_as_zero(word)) {
    why << "f32 " << word << " is too small; write 0, or at least ";
    append_single(why, kLeast);
    return Status::kBadValue;
  }
  std::memcpy(&line.bits, &single, sizeof single);
  return Status::kOk;
}

Status read_value(std::string_view word, ObjectLine& line, Message& why) {
  if (line.type == ValueType::kF32) return read_float(word, line, why);
  const TypeRow& type = kTypes[static_cast<std::size_t>(line.type)];
  std::int64_t value = 0;
  if (!read_whole(word, value)) {
    why << "'" << word << "' is not a whole number, decimal or from 0x on hexadecimal";
    return Status::kBadValue;
  }
  if (value < type.low || value > type.high) {
    why << type.name << " " << word << " is out of range; it must be in ["
        << static_cast<int>(type.low) << ", " << static_cast<std::size_t>(type.high) << "]";
    return Status::kBadValue;
  }
  const auto mask = 0xFFFFFFFFU >> (32 - 8 * type.bytes);
  line.bits = static_cast<std::uint32_t>(value) & mask;
  return Status::kOk;
}

Status read_line(std::string_view text, ObjectLine& line, Message& why) {
  std::string_view rest = text;
  std::string_view word = take_word(rest);
  if (begins(word, "joint")) {
    TRY(read_joint(word, line, why));
    word = take_word(rest);
  }
  const std::string_view type = take_word(rest), value = take_word(rest);
  if (value.empty() || !take_word(rest).empty()) {
    why << "'" << text << "' is no object, type and value" << kForm;
    return Status::kBadValue;
  }
  TRY(read_object(word, line, why));
  TRY(read_type(type, line, why));
  return read_value(value, line, why);
}

}  // namespace

const char* name(ValueType type) {
  return kTypes[static_cast<std::size_t>(type)].name;
}

const char* kept_by_program(std::uint16_t index) {
  // The further axes of a device repeat the objects of the first every 800h (CiA 402-2).
  constexpr std::uint16_t kAxes = 0x6000, kAxesEnd = 0xA000, kAxis = 0x800;
  if (index >= kAxes && index < kAxesEnd)
    index = static_cast<std::uint16_t>(kAxes + (index - kAxes) % kAxis);
  for (const ReservedObjects& row : kReserved)
    if (index >= row.first && index <= row.last) return row.why;
  return nullptr;
}

void ObjectLine::append(Message& text, std::uint32_t value) const {
  value &= mask();
  float single = 0.0F;
  switch (type) {
    case ValueType::kF32:
      std::memcpy(&single, &value, sizeof single);
      append_single(text, single);
      break;
    case ValueType::kI8: text << int{static_cast<std::int8_t>(value)}; break;
    case ValueType::kI16: text << int{static_cast<std::int16_t>(value)}; break;
    case ValueType::kI32: text << static_cast<int>(value); break;
    default: text << static_cast<std::size_t>(value);
  }
}

Status ObjectLines::add(std::string_view text, int line, Message& why) {
  if (count_ == kMost) {
    why << "more than " << kMost << " lines";
    return Status::kTooLarge;
  }
  ObjectLine read;
  read.line = line;
  TRY(read_line(text, read, why));
  for (int i = 0; i < count_; ++i) {
    const ObjectLine& other = (*this)[i];
    const bool same = other.object.index == read.object.index &&
                      other.object.sub == read.object.sub &&
                      (read.is_for(other.joint) || other.is_for(read.joint));
    if (!same) continue;
    why << hex(read.object.index) << ":" << int{read.object.sub} << " is already given for ";
    if (other.joint == ObjectLine::kEvery)
      why << "all joints";
    else
      why << "joint " << other.joint + 1;
    why << " at line " << other.line;
    return Status::kDuplicate;
  }
  lines_[static_cast<std::size_t>(count_++)] = read;
  return Status::kOk;
}

}  // namespace tactus::cia402
