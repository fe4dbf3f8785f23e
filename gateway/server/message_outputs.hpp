// The digital outputs in messages: which there are, and the channels of a chunk.
#pragma once

#include "gateway/chunk.hpp"
#include "gateway/tactus.pb.h"
#include "kernel/core/load_error.hpp"

namespace tactus {

/// kOk if all bits of `mask` are among the outputs that the pipeline puts out; else kNotOffered:
/// `why` names the field, the output, what there is, and the remedy. [any]
Status judge_outputs(std::uint32_t mask, std::uint32_t offered, const char* field, Message& why);

/// Judges the channels of a chunk: each of another output that there is, with a value for each
/// target, and their lead. kNotOffered, kBadValue as above. [any]
Status judge_channels(const tactus_Chunk& from, std::uint32_t offered, Message& why);

/// Writes the channels that were judged into a chunk whose targets were read. [any]
template <class Space>
void read_channels(const tactus_Chunk& from, Chunk<Space>& chunk) {
  chunk.outputs_mask = 0;
  chunk.outputs_lead_s = from.outputs_lead_s;
  for (pb_size_t k = 0; k < from.channels_count; ++k) {
    const tactus_Channel& channel = from.channels[k];
    const std::uint32_t bit = std::uint32_t{1} << channel.output;
    chunk.outputs_mask |= bit;
    for (pb_size_t i = 0; i < channel.values_count; ++i)
      if (channel.values[i]) chunk.outputs[i] |= bit;
  }
}

}  // namespace tactus
