// ReferenceRequests: the references that clients send, from their messages to the intake of the
// pipeline: points, velocities, chunks, and trajectories in parts.
#pragma once

#include "gateway/server/clients.hpp"
#include "gateway/server/state_publisher.hpp"

namespace tactus {

class ReferenceRequests {
 public:
  ReferenceRequests(References& references, const Pipeline& pipeline, const StatePublisher& cycles,
                    Clients& clients)
      : references_(references), pipeline_(pipeline), cycles_(cycles), clients_(clients) {}

  /// Refuses fields that the robot or the pipeline cannot take.
  Reply judge_fields(const tactus_ToServer& message) const;
  /// Refuses a reference sent before a cancel or a stop was in force, whatever place it names.
  /// After a cancel by another client, the owner must show that it has received it.
  Reply judge_void(const tactus_ToServer& message, const Connection& connection) const;
  /// True for the messages that execute() takes.
  static bool takes(pb_size_t kind);
  /// Executes a message of a client that may move the arm.
  Reply execute(const tactus_ToServer& message, const Origin& from, std::int64_t now_ns);
  /// References that were duplicates, or older than the newest.
  std::uint32_t dropped() const { return dropped_; }

 private:
  Reply reply(const Verdict& verdict) const { return reply_to(verdict, references_.axes()); }
  Reply judge_place(Connection& connection, bool given, const tactus_Place& place);
  Reply point(const tactus_Point& given, std::int64_t client_ns, const Origin& from);
  Reply velocity(const tactus_Velocity& given, const Origin& from);
  Reply chunk(const tactus_Chunk& given, const Origin& from, std::int64_t now_ns);
  Reply read_chunk_time(const tactus_Chunk& given, const Connection& connection,
                        std::int64_t now_ns, double& origin_s, double& observed_s) const;
  Verdict judge_targets(const tactus_Chunk& given, double origin_s, std::int64_t now_ns) const;
  Chunk<JointSpace>& chunk_of(const JointSpace&) { return joint_chunk_; }
  Chunk<TaskSpace>& chunk_of(const TaskSpace&) { return task_chunk_; }
  Reply begin(const tactus_Begin& given, const Origin& from, std::int64_t now_ns);
  Reply part(const tactus_Part& part, const Origin& from);
  Reply end(const Origin& from);

  References& references_;
  const Pipeline& pipeline_;
  const StatePublisher& cycles_;
  Clients& clients_;
  Chunk<JointSpace> joint_chunk_;  // that is being read
  Chunk<TaskSpace> task_chunk_;
  std::uint32_t dropped_ = 0;
};

}  // namespace tactus
