// CanMaster: the names of the buses, and the numbers that its drives must have.
#include <cmath>

#include "hal/can/can_master.hpp"

namespace tactus::can {
namespace {

constexpr std::size_t kLongest = 15;  // characters of the name of a Linux interface

}  // namespace

/// Splits "can0 can1" at blanks.
Status CanMaster::read_interfaces() {
  std::string_view text = can_->interfaces;
  buses_ = 0;
  for (std::size_t rest = text.size(); rest > 0; rest = text.size()) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(word.size());
    if (word.empty()) break;
    TRY(judge_interface(word));
    interfaces_[static_cast<std::size_t>(buses_++)] = Name(word);
  }
  if (buses_ > 0) return Status::kOk;
  why_ = Message("[can] interfaces is missing; name the buses, for example: can0 can1 can2");
  return Status::kMissingKey;
}

Status CanMaster::judge_interface(std::string_view word) {
  why_ = Message("[can] interfaces has '");
  why_ << word << "'";
  if (word.find(',') != std::string_view::npos) {
    why_ << " with a comma; separate names by blanks, for example: can0 can1 can2";
    return Status::kBadValue;
  }
  if (word.size() > kLongest) {
    why_ << ", which has " << word.size() << " characters; an interface has at most " << kLongest
         << ": `ip -brief link` lists them";
    return Status::kTooLarge;
  }
  if (buses_ == kMaxBuses) {
    why_ << " after " << kMaxBuses << " others; there are at most " << kMaxBuses << " buses";
    return Status::kTooLarge;
  }
  for (int bus = 0; bus < buses_; ++bus) {
    if (std::string_view(interfaces_[static_cast<std::size_t>(bus)]) != word) continue;
    why_ << " twice; every bus has an interface of its own";
    return Status::kBadValue;
  }
  why_ = {};
  return Status::kOk;
}

Status CanMaster::judge_identity() {
  for (const double number : {can_->vendor, can_->product}) {
    if (std::floor(number) == number) continue;
    why_ = Message("[can] vendor or product is ");
    why_ << number << "; 1018h:1 and :2 are whole numbers";
    return Status::kBadValue;
  }
  return Status::kOk;
}

}  // namespace tactus::can
