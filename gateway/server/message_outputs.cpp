#include "gateway/server/message_outputs.hpp"

#include <cmath>

#include "kernel/core/digital_outputs.hpp"

namespace tactus {
namespace {

Message channel_field(pb_size_t channel, const char* field) {
  Message text("Chunk.channels[");
  text << static_cast<int>(channel) << "]." << field;
  return text;
}

/// Lists the outputs of a mask as "0 1 2".
void list(std::uint32_t mask, Message& text) {
  for (int i = 0; i < kMostOutputs; ++i)
    if ((mask >> i & 1u) != 0) text << " " << i;
}

Status judge_output(std::uint32_t output, std::uint32_t offered, const char* field, Message& why) {
  if (output < kMostOutputs && (offered >> output & 1u) != 0) return Status::kOk;
  why << field << ": ";
  if (offered == 0) {
    why << "the pipeline puts out no digital outputs; wire [robot] outputs to its generator";
    return Status::kNotOffered;
  }
  why << "there is no digital output " << static_cast<double>(output) << "; take one of";
  list(offered, why);
  return Status::kNotOffered;
}

}  // namespace

Status judge_outputs(std::uint32_t mask, std::uint32_t offered, const char* field, Message& why) {
  for (std::uint32_t i = 0; i < kMostOutputs; ++i)
    if ((mask >> i & 1u) != 0) TRY(judge_output(i, offered, field, why));
  return Status::kOk;
}

Status judge_channels(const tactus_Chunk& from, std::uint32_t offered, Message& why) {
  std::uint32_t seen = 0;
  for (pb_size_t k = 0; k < from.channels_count; ++k) {
    const tactus_Channel& channel = from.channels[k];
    TRY(judge_output(channel.output, offered, channel_field(k, "output").c_str(), why));
    const std::uint32_t bit = std::uint32_t{1} << channel.output;
    if ((seen & bit) != 0) {
      why << channel_field(k, "output") << ": output " << static_cast<int>(channel.output)
          << " has a channel before this one; give it one";
      return Status::kBadValue;
    }
    seen |= bit;
    if (channel.values_count == from.time_s_count) continue;
    why << channel_field(k, "values") << " has " << static_cast<int>(channel.values_count)
        << " values instead of " << static_cast<int>(from.time_s_count) << "; give one per target";
    return Status::kBadValue;
  }
  if (std::abs(from.outputs_lead_s) <= kLongestLead_s) return Status::kOk;
  why << "Chunk.outputs_lead_s " << from.outputs_lead_s << " s is not from " << -kLongestLead_s
      << " to " << kLongestLead_s << " s; give the latency of the gripper, in s";
  return Status::kBadValue;
}

}  // namespace tactus
