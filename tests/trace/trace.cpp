#include "tests/trace/trace.hpp"

#include <cstring>

#include "gateway/fnv1a.hpp"
#include "kernel/pipeline/recorder.hpp"

namespace tactus {
namespace {

constexpr int kMostNumbers = 7;  // of a port that is recorded: a pose, or joints

using Line = Text<128>;

std::uint64_t bits_of(double value) {
  std::uint64_t bits = 0;
  static_assert(sizeof bits == sizeof value);
  std::memcpy(&bits, &value, sizeof bits);
  return bits;
}

}  // namespace

Text<16> hexadecimal(std::uint64_t bits) {
  constexpr char kDigits[] = "0123456789abcdef";
  Text<16> text;
  for (int shift = 60; shift >= 0; shift -= 4)
    text << std::string_view(&kDigits[bits >> shift & 15U], 1);
  return text;
}

void Trace::add(const char* name, double value) {
  add_bits(name, 0, bits_of(value));
}

void Trace::add(const char* name, std::uint64_t value) {
  add_bits(name, 0, value);
}

void Trace::add(const char* name, const double* values, int count) {
  for (int i = 0; i < count; ++i) add_bits(name, i, bits_of(values[i]));
}

void Trace::add(const char* name, const Pose& pose) {
  const double numbers[] = {pose.p.x(), pose.p.y(), pose.p.z(), pose.r.w(),
                            pose.r.x(), pose.r.y(), pose.r.z()};
  add(name, numbers, 7);
}

/// Digital outputs are left out: boards without streams have no such ports.
void Trace::add(const PortEntry& port) {
  static_assert(kDof <= kMostNumbers);
  if (port.quantity == Quantity::kDigitalOutputs) return;
  Line name;
  if (prints_values()) name << std::string_view(port.block) << "." << port.port;
  if (port.quantity == Quantity::kJacobian) {
    const auto& jacobian = *static_cast<const Jacobian*>(port.value);
    return add(name.c_str(), jacobian.data(), 6 * kDof);
  }
  double numbers[kMostNumbers];
  add(name.c_str(), numbers, flatten(port, numbers));
}

void Trace::add_bits(const char* name, int index, std::uint64_t bits) {
  char bytes[8];
  for (int i = 0; i < 8; ++i) bytes[i] = static_cast<char>(bits >> 8 * i & 255U);
  hash_ = fnv1a({bytes, sizeof bytes}, hash_);
  if (!prints_values()) return;
  Line line;
  line << static_cast<std::size_t>(cycles_) << " " << name << " " << index << " "
       << std::string_view(hexadecimal(bits)) << "\n";
  print_(line.c_str());
}

void Trace::end_cycle() {
  if (window_.step != 0 && in_window() && cycles_ % window_.step == 0) {
    Line line;
    line << static_cast<std::size_t>(cycles_) << " " << std::string_view(hexadecimal(hash_))
         << "\n";
    print_(line.c_str());
  }
  ++cycles_;
}

}  // namespace tactus
