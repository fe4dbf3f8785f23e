#include "hal/can/sdo_client.hpp"
#include "hal/cia402/hex.hpp"

namespace tactus::can {

Message SdoClient::describe() const {
  Message text;
  text << "node " << int{node_} << ": object " << cia402::hex(index_) << ":" << int{sub_} << ": ";
  if (progress_ != Progress::kAborted) {
    text << name(progress_);
    return text;
  }
  const auto ms = [](std::int64_t time_ns) { return static_cast<int>(time_ns / 1'000'000); };
  switch (cause_) {
    case Cause::kNode: text << meaning(abort_); break;
    case Cause::kAnswer: text << "the answer is wrong: " << meaning(abort_); break;
    case Cause::kSilence: text << "no answer within " << ms(times_.answer_ns) << " ms"; break;
    case Cause::kTime: text << "not complete within " << ms(times_.transfer_ns) << " ms"; break;
    case Cause::kValue: text << "the value to write is " << meaning(abort_); break;
  }
  if (heard_other_ && (cause_ == Cause::kSilence || cause_ == Cause::kTime))
    text << ", but one on " << cia402::hex(other_index_) << ":" << int{other_sub_};
  text << " (" << cia402::hex(static_cast<std::uint32_t>(abort_)) << ")";
  return text;
}

}  // namespace tactus::can
