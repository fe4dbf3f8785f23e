#include "kernel/load/section_reader.hpp"

#include <cmath>

#include "kernel/load/number.hpp"

namespace tactus {
namespace {

/// True for a decimal number without point and exponent, however large.
bool is_whole(std::string_view text) {
  double value = 0.0;
  bool digits = parse_number(text, value);
  for (const char c : text) digits = digits && ((c >= '0' && c <= '9') || c == '+' || c == '-');
  return digits;
}

constexpr const char* kOutOfRange = " is out of range; it must be ";

bool dimensionless(const char* unit) {
  return std::string_view(unit) == "1";
}

/// Appends the unit of a number, if it has one.
Message& add_unit(Message& text, const char* unit) {
  return dimensionless(unit) ? text : text << " " << unit;
}

}  // namespace

bool SectionReader::next() {
  if (failed() || (checked_ >= 0 && !seeks_)) return false;
  if (seeks_ && !judge_sought(ini_.entry(section_.first + checked_))) return false;
  seeks_ = ++checked_ < section_.count;
  found_ = repeats_ = false;
  names_ = {};
  if (seeks_) sought_ = ini_.entry(section_.first + checked_).key;
  return true;
}

bool SectionReader::judge_sought(const IniEntry& entry) {
  Status status = Status::kUnknownKey;
  Message reason;
  if (!found_) {
    reason << "the section has no such key; it has " << names_;
  } else if (const IniEntry* first = ini_.find(section_, sought_); first != &entry && !repeats_) {
    status = Status::kDuplicate;
    reason << "the key is already given at line " << first->line;
  } else {
    return true;
  }
  static_cast<void>(error_.refuse(status, entry.line, section_.name, entry.key, reason));
  return false;
}

void SectionReader::refuse(Status status, const char* key, std::string_view reason) {
  if (failed() || seeks_) return;  // the first error is the one to report
  const IniEntry* entry = find(key);
  static_cast<void>(
      error_.refuse(status, entry ? entry->line : section_.line, section_.name, key, reason));
}

const IniEntry* SectionReader::find(const char* key) {
  if (!seeks_) return ini_.find(section_, key);
  know(key);
  return nullptr;
}

void SectionReader::refuse_length(const char* key, std::size_t length, std::size_t limit) {
  refuse(Status::kTooLarge, key,
         Message("the value has ") << length << " characters; the limit is " << limit);
}

void SectionReader::refuse_missing(const char* key, const char* unit) {
  Message reason("the key is missing");
  reason << "; add it";
  if (!dimensionless(unit)) reason << ", in " << unit;
  refuse(Status::kMissingKey, key, reason);
}

std::string_view SectionReader::written(const char* key, int index) {
  const IniEntry* entry = find(key);
  std::string_view rest = entry != nullptr ? entry->value : std::string_view();
  std::string_view word = take_word(rest);
  for (int i = 0; i < index && !rest.empty(); ++i) word = take_word(rest);
  return word;
}

void SectionReader::refuse_value(const char* key, const char* of, int index, double value,
                                 const Range& range, const char* unit) {
  Message reason(of);
  if (!reason.empty()) reason << index + 1 << ": ";
  if (find(key) == nullptr)
    reason << "the default " << value;
  else
    reason << written(key, index);
  refuse(Status::kBadValue, key, add_unit(reason, unit) << kOutOfRange << range);
}

bool SectionReader::numbers(const char* key, double* values, int count, bool joints,
                            const char* unit) {
  const IniEntry* entry = find(key);
  if (entry == nullptr) {
    if (!std::isnan(values[0])) return true;
    refuse_missing(key, unit);
    return false;
  }
  std::string_view rest = entry->value;
  int found = 0;
  for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest), ++found) {
    double value = 0.0;
    if (!parse_number(word, value)) {
      refuse(Status::kBadValue, key, Message("'") << word << "' is not a finite number");
      return false;
    }
    if (found < count) values[found] = value;
  }
  if (found == count) return true;
  if (joints && found == 1) {
    for (int i = 1; i < count; ++i) values[i] = values[0];
    return true;
  }
  refuse(Status::kBadValue, key,
         Message("") << found << (found == 1 ? " number" : " numbers") << "; expected " << count
                     << (joints ? " or 1" : ""));
  return false;
}

void SectionReader::param(const char* key, double& value, const Range& range, const char* unit) {
  double read = value;
  if (!numbers(key, &read, 1, false, unit)) return;
  if (!range.contains(read)) return refuse_value(key, "", 0, read, range, unit);
  value = read;
}

void SectionReader::param(const char* key, int& value, const Range& range, const char* unit) {
  const IniEntry* entry = find(key);
  if (entry == nullptr) {
    if (value == kRequiredInt) refuse_missing(key, unit);
    return;
  }
  if (!is_whole(entry->value))
    return refuse(Status::kBadValue, key,
                  Message("'") << entry->value << "' is not a whole number");
  int read = 0;
  if (!parse_number(entry->value, read) || !range.contains(read))
    return refuse_value(key, "", 0, read, range, unit);
  value = read;
}

void SectionReader::param(const char* key, JointVector& value, const Range& range,
                          const char* unit) {
  JointVector read = value;
  if (!numbers(key, read.data(), kDof, true, unit)) return;
  for (int i = 0; i < kDof; ++i) {
    if (!range.contains(read[i])) return refuse_value(key, "joint ", i, read[i], range, unit);
  }
  value = read;
}

void SectionReader::param(const char* key, Vector3& value, const Range& range, const char* unit) {
  Vector3 read = value;
  if (!numbers(key, read.data(), 3, false, unit)) return;
  for (int i = 0; i < 3; ++i) {
    if (!range.contains(read[i])) return refuse_value(key, "", i, read[i], range, unit);
  }
  value = read;
}

void SectionReader::limit(const char* key, JointVector& value, const char* unit) {
  JointVector read = value;
  if (!numbers(key, read.data(), kDof, true, unit)) return;
  for (int i = 0; i < kDof; ++i) {
    if (!(read[i] > 0.0 && read[i] <= value[i]))
      return refuse(Status::kBadValue, key,
                    add_unit(Message("joint ") << i + 1 << ": " << written(key, i), unit)
                        << kOutOfRange << "> 0 and at most the robot's " << value[i]);
  }
  value = read;
}

int SectionReader::choose(const char* key, const char* const* words, std::size_t count) {
  const IniEntry* entry = find(key);
  if (entry == nullptr) return -1;
  Message reason("unknown value '");
  reason << entry->value << "'; expected one of";
  for (std::size_t i = 0; i < count; ++i) {
    if (entry->value == words[i]) return static_cast<int>(i);
    reason << (i == 0 ? " " : ", ") << words[i];
  }
  refuse(Status::kBadValue, key, reason);
  return -1;
}

const void* SectionReader::source(const char* key, Quantity quantity, bool required) {
  const IniEntry* entry = find(key);
  if (entry == nullptr) {
    if (required)
      refuse(Status::kNotConnected, key,
             Message("the input is not connected; it takes a ") << info(quantity).name);
    return nullptr;
  }
  const PortEntry* port = ports_.find(entry->value);
  if (port == nullptr) {
    refuse(Status::kUnknownPort, key,
           Message("unknown output '")
               << entry->value << "'; expected one of [robot] or of a block above");
    return nullptr;
  }
  if (!port->offered) {
    refuse(Status::kNotOffered, key,
           Message("") << entry->value << ": the robot has no such sensor");
    return nullptr;
  }
  if (port->quantity != quantity) {
    refuse(Status::kWrongQuantity, key,
           Message("") << entry->value << " is a " << info(port->quantity).name
                       << ", but the input takes a " << info(quantity).name << "; wire one");
    return nullptr;
  }
  return port->value;
}

void SectionReader::add_output(const PortEntry& entry) {
  if (!seeks_ && !ports_.add(entry))
    refuse(Status::kTooLarge, entry.port, Message("more than ") << kMaxPorts << " outputs");
}

}  // namespace tactus
