// DueTarget: the target that is due, for executors without a plan: of the newest chunk that has
// arrived, the last point whose time has come.
#pragma once

#include "tests/bench/policies/chunk_file.hpp"

namespace tactus {

class DueTarget {
 public:
  explicit DueTarget(const std::vector<ChunkMessage>& chunks) : chunks_(chunks) {}

  /// Returns the target at `now_ns`, not earlier than at the last call; null before the first.
  const ChunkPoint* at(std::int64_t now_ns) {
    for (; next_ < chunks_.size() && chunks_[next_].t_arrival_ns <= now_ns; ++next_)
      if (newest_ == nullptr || chunks_[next_].number > newest_->number) newest_ = &chunks_[next_];
    if (newest_ == nullptr) return nullptr;
    for (const ChunkPoint& point : newest_->points)
      if (point.t_target_ns <= now_ns) due_ = &point;
    return due_;
  }

 private:
  const std::vector<ChunkMessage>& chunks_;
  std::size_t next_ = 0;
  const ChunkMessage* newest_ = nullptr;
  const ChunkPoint* due_ = nullptr;
};

}  // namespace tactus
