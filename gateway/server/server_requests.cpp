// Server: the execution of requests.
#include <cctype>

#include "gateway/server/server.hpp"

namespace tactus {
namespace {

/// Printable characters only, as names go into logs and terminals.
Name printable_name(const char* text) {
  Name name;
  for (; *text != '\0'; ++text)
    name << std::string_view(std::isprint(static_cast<unsigned char>(*text)) != 0 ? text : "?", 1);
  return name.empty() ? Name("a client") : name;
}

bool needs_lease(const tactus_ToServer& message) {
  switch (message.which_request) {
    case tactus_ToServer_parameters_tag: return !message.request.parameters.check;
    case tactus_ToServer_point_tag:
    case tactus_ToServer_velocity_tag:
    case tactus_ToServer_chunk_tag:
    case tactus_ToServer_resume_tag:
    case tactus_ToServer_rearm_tag:
    case tactus_ToServer_tare_tag: return true;
    default: return false;
  }
}

bool offered(std::uint32_t feature, bool parameters, bool outputs, bool tare, bool wrap) {
  return (wrap && feature == tactus_Feature_FEATURE_WRAP) ||
         (tare && feature == tactus_Feature_FEATURE_TARE) ||
         (parameters && feature == tactus_Feature_FEATURE_PARAMETERS) ||
         (outputs && feature == tactus_Feature_FEATURE_OUTPUTS) ||
         feature == tactus_Feature_FEATURE_NONE || feature == tactus_Feature_FEATURE_CHUNKS ||
         feature == tactus_Feature_FEATURE_VELOCITIES;
}

Reply not_offered(std::string_view what) {
  Message text("this server does not offer ");
  text << what << "; Welcome.features names what it offers";
  return {Status::kNotOffered, text};
}

void write_joints(const Pipeline& pipeline, tactus_Welcome& to) {
  const JointLimits limits = pipeline.guard.references();
  to.joints_count = kDof;
  for (int i = 0; i < kDof; ++i) {
    tactus_Joint& joint = to.joints[i];
    set_text(joint.name, Robot::kJointNames[static_cast<std::size_t>(i)]);
    joint.min_rad = limits.q_min[i];
    joint.max_rad = limits.q_max[i];
    joint.velocity = limits.dq_max[i];
    joint.acceleration = limits.ddq_max[i];
    joint.jerk = limits.dddq_max[i];
    joint.effort = limits.tau_max[i];
    joint.continuous = (Robot::kContinuousJoints >> i & 1U) != 0;
    joint.prismatic = is_prismatic<Robot>(i);
  }
}

/// Writes what digital outputs there are, and their names if they all have one.
void write_outputs(const ServerSetup& setup, tactus_Welcome& to) {
  to.outputs = setup.loaded->robot.offered;
  for (std::size_t i = 0; i < setup.output_names.size(); ++i) {
    if ((to.outputs >> i & 1u) == 0) continue;
    if (setup.output_names[i] == nullptr) {
      to.output_names_count = 0;
      return;
    }
    set_text(to.output_names[to.output_names_count++], setup.output_names[i]);
  }
}

tactus_TaskLimits task_limits(const TaskLimits& limits) {
  return {limits.v_max, limits.a_max,     limits.j_max,
          limits.w_max, limits.alpha_max, limits.dalpha_max};
}

}  // namespace

Reply Server::execute(int slot, const Origin& from, std::int64_t now_ns) {
  for (pb_size_t i = 0; i < request_.requires_count; ++i)
    if (!offered(request_.requires[i], parameters_.offered(),
                 setup_.loaded->robot.commands_outputs(), orders_.offers_tare(),
                 references_.wraps()))
      return not_offered("a feature that the message requires");
  const pb_size_t what = request_.which_request;
  if (what == tactus_ToServer_hello_tag) return greet(slot, from, now_ns);
  if (at(slot).state == Connection::State::kNew)
    return {Status::kNotStarted, "the first message of a connection must be Hello"};
  const bool checks =
      what == tactus_ToServer_begin_tag
          ? request_.request.begin.check
          : references_.with_intake([&from](auto& intake) { return intake.checks(from); });
  const bool follows = what == tactus_ToServer_part_tag || what == tactus_ToServer_end_tag ||
                       what == tactus_ToServer_begin_tag;
  const bool moves = follows ? !checks : needs_lease(request_) || raises(what);
  if (moves && lease_.owner() != slot) {
    Message text(describe(Status::kNotOwner));
    if (lease_.owner() != Lease::kNoOwner)
      text << ": " << std::string_view(at(lease_.owner()).name) << ", with priority "
           << static_cast<int>(lease_.priority());
    return {Status::kNotOwner, text << remedy({Status::kNotOwner})};
  }
  Reply why = requests_.judge_fields(request_);
  if (why.status == Status::kOk && moves) why = requests_.judge_void(request_, at(slot));
  if (why.status == Status::kOk && moves) why = judge_stops(slot);
  if (why.status != Status::kOk) return why;
  if (ReferenceRequests::takes(what)) return requests_.execute(request_, from, now_ns);
  switch (what) {
    case tactus_ToServer_lease_tag: return lease(slot, now_ns);
    case tactus_ToServer_cancel_tag:
    case tactus_ToServer_override_tag:
    case tactus_ToServer_pause_tag:
    case tactus_ToServer_resume_tag: return control(from);
    case tactus_ToServer_stop_tag: return stop(from, now_ns);
    case tactus_ToServer_rearm_tag:
      return orders_.post(CycleOrder::kRearm, from, cycles_.newest().faults);
    case tactus_ToServer_tare_tag: return orders_.post_tare(from, cycles_.newest().faults);
    case tactus_ToServer_parameters_tag:
      return parameters_.offered() ? parameters_.set(request_.request.parameters, from)
                                   : not_offered("parameters");
    case tactus_ToServer_list_parameters_tag:
      return parameters_.offered() ? parameters_.list(request_.request.list_parameters, from)
                                   : not_offered("parameters");
    case tactus_ToServer_subscribe_tag: return subscribe(slot, now_ns);
    case tactus_ToServer_ping_tag: return {};
    default: return {Status::kUnknownKey, "unknown message; this server speaks version 1"};
  }
}

/// True for an override above the one that was in force when the newest snapshot was made: only its
/// owner makes the arm faster. The cycle judges again.
bool Server::raises(pb_size_t what) const {
  return what == tactus_ToServer_override_tag &&
         !(request_.request.override.rate <= cycles_.newest().override);
}

/// A request that makes the arm move again, or faster, is valid only if its client has received all
/// stops by others.
Reply Server::judge_stops(int slot) const {
  std::uint32_t stops = 0;
  switch (request_.which_request) {
    case tactus_ToServer_rearm_tag: stops = request_.request.rearm.stops; break;
    case tactus_ToServer_resume_tag: stops = request_.request.resume.stops; break;
    case tactus_ToServer_override_tag: stops = request_.request.override.stops; break;
    default: return {};
  }
  if (!stops_.issued(stops))
    return {Status::kBadValue,
            "stops is missing or was never told: give that of the latest State, Answer or Welcome"};
  if (stops_.known(stops, at(slot).session)) return {};
  return {Status::kEpochVoid,
          "since this was asked the arm was stopped, canceled, paused or slowed down, not by this "
          "client; look at the latest State, and ask again"};
}

Reply Server::greet(int slot, const Origin& from, std::int64_t now_ns) {
  Connection& connection = at(slot);
  if (connection.state == Connection::State::kOpen)
    return {Status::kDuplicate, "Hello was said before"};
  const tactus_Hello& hello = request_.request.hello;
  if (hello.version != tactus_Version_VERSION_PRESENT) {
    Message text("this server speaks version 1 of the messages, not ");
    return {Status::kBadValue, text << static_cast<double>(hello.version)};
  }
  connection.state = Connection::State::kOpen;
  connection.name = printable_name(hello.client);
  welcome(connection, from.number, now_ns);
  Message text(connection.name);
  text << " has joined";
  clients_.announce("joined", Status::kOk, text.c_str(), now_ns, slot);
  return {};
}

void Server::welcome(Connection& to, std::uint32_t number, std::int64_t now_ns) {
  const Pipeline& pipeline = *setup_.loaded;
  tactus_Welcome& welcome = clients_.begin_message(tactus_ToClient_welcome_tag).message.welcome;
  welcome.number = number;
  welcome.version = tactus_Version_VERSION_PRESENT;
  set_text(welcome.board, setup_.board);
  set_text(welcome.robot, Robot::kName);
  set_text(welcome.pipeline, setup_.pipeline);
  welcome.configuration = setup_.configuration;
  welcome.session = to.session;
  welcome.server_ns = now_ns;
  welcome.client_ns = to.client_ns;
  welcome.period_s = pipeline.robot.period_s();
  write_joints(pipeline, welcome);
  welcome.has_task = pipeline.takes_poses;
  welcome.task = task_limits(pipeline.task_limits);
  welcome.takes_poses = pipeline.takes_poses;
  welcome.takes_joints = pipeline.takes_joints && !pipeline.takes_poses;
  welcome.window =
      static_cast<std::uint32_t>(pipeline.takes_poses ? setup_.task_window : setup_.joint_window);
  welcome.longest_part = kLongestPart;
  if (references_.takes_any()) {
    welcome.longest_chunk = kChunkTargets;
    welcome.features[welcome.features_count++] = tactus_Feature_FEATURE_CHUNKS;
    welcome.features[welcome.features_count++] = tactus_Feature_FEATURE_VELOCITIES;
    if (pipeline.robot.commands_outputs())
      welcome.features[welcome.features_count++] = tactus_Feature_FEATURE_OUTPUTS;
  }
  if (parameters_.offered())
    welcome.features[welcome.features_count++] = tactus_Feature_FEATURE_PARAMETERS;
  if (references_.wraps()) welcome.features[welcome.features_count++] = tactus_Feature_FEATURE_WRAP;
  if (orders_.offers_tare())
    welcome.features[welcome.features_count++] = tactus_Feature_FEATURE_TARE;
  welcome.parameter_sets = parameters_.sets();
  write_outputs(setup_, welcome);
  welcome.epoch = references_.epoch();
  welcome.stops = stops_.newest();
  set_text(welcome.motion_frame, setup_.motion_frame);
  set_text(welcome.wrench_frame, setup_.wrench_frame);
  static_cast<void>(clients_.put(to));
}

Reply Server::lease(int slot, std::int64_t now_ns) {
  const tactus_Lease& lease = request_.request.lease;
  if (lease.wish > tactus_Lease_Wish_RELEASE) return {Status::kBadValue, "Lease.wish is unknown"};
  if (lease.wish == tactus_Lease_Wish_RELEASE) {
    if (lease_.owner() != slot) return {Status::kNotOwner, "this client has no lease to give back"};
    lease_.end();
    const Origin client = {slot, at(slot).session, 0};
    references_.with_intake([&](auto& intake) {
      if (!intake.comes(client)) return;
      intake.refuse(client, {Status::kNotOwner});
      references_.begin_epoch();
    });
    Message text(at(slot).name);
    clients_.send_event("lease", Status::kOk, text << " has given the lease back", now_ns);
    return {};
  }
  const std::uint32_t timeout_ms = lease.timeout_ms == 0 ? kDefaultLease_ms : lease.timeout_ms;
  if (timeout_ms < kShortestLease_ms || timeout_ms > kLongestLease_ms)
    return {Status::kBadValue, "Lease.timeout_ms is not from 20 to 60000"};
  if (lease.priority > kHighestPriority)
    return {Status::kBadValue, "Lease.priority is not from 0 to 255"};
  const int before = lease_.owner();
  const LeaseResult taken = lease_.take(slot, lease.priority, kMillisecond_ns * timeout_ms, now_ns);
  if (taken == LeaseResult::kRefused) {
    Message text(std::string_view(at(before).name));
    text << " owns the motion with priority " << static_cast<int>(lease_.priority())
         << "; ask with a higher one, or wait until it is given back";
    return {Status::kNotOwner, text};
  }
  at(slot).canceled = false;
  if (taken == LeaseResult::kRenewed) return {};
  Message text(at(slot).name);
  text << " owns the motion";
  if (taken == LeaseResult::kTakenOver) {
    references_.give_up(at(before).session);
    references_.end_motion();
    text << ", taken over from " << std::string_view(at(before).name);
  }
  clients_.announce("lease", Status::kOk, text.c_str(), now_ns);
  return {};
}

Reply Server::stop(const Origin& from, std::int64_t now_ns) {
  const Reply posted = orders_.post(CycleOrder::kStop, from, cycles_.newest().faults);
  if (posted.status != Status::kOk) return posted;
  begin_end();
  stops_.add(from.session);
  Message text(at(from.slot).name);
  text << " has stopped the arm";
  clients_.announce("stop", Status::kHalted, text.c_str(), now_ns);
  return {};
}

Reply Server::control(const Origin& from) {
  if (!references_.takes_any()) return not_offered("references");
  const pb_size_t what = request_.which_request;
  const bool by_owner = lease_.owner() == from.slot;
  ControlKind kind = ControlKind::kResume;
  ControlEffect effect = {" has ended the pause", -1.0, by_owner};
  double rate = 1.0;
  if (what == tactus_ToServer_cancel_tag) {
    kind = ControlKind::kCancel;
    effect.what = " has canceled what runs";
  } else if (what == tactus_ToServer_pause_tag) {
    kind = ControlKind::kPause;
    effect.what = " has paused the arm";
  } else if (what == tactus_ToServer_override_tag) {
    const std::uint32_t stops = request_.request.override.stops;
    kind = by_owner && stops_.known(stops, from.session) ? ControlKind::kOverride
                                                         : ControlKind::kSlowDown;
    effect.what = " has set the override";
    rate = request_.request.override.rate;
    effect.percent = 100.0 * rate;
  }
  const Verdict verdict = references_.with_intake(
      [&](auto& intake) { return intake.control(from, kind, rate, effect); });
  const bool slows = kind != ControlKind::kResume && !raises(what) && rate >= 0.0;
  if (verdict.ok() && slows) stops_.add(from.session);
  if (verdict.ok() && kind == ControlKind::kCancel) {
    begin_end();
    const int owner = lease_.owner();
    if (owner != Lease::kNoOwner) {
      references_.give_up(at(owner).session);
      at(owner).canceled = !by_owner;
    }
  }
  return reply_to(verdict, references_.axes());
}

Reply Server::subscribe(int slot, std::int64_t now_ns) {
  const tactus_Subscribe& subscription = request_.request.subscribe;
  Connection& connection = at(slot);
  connection.states = {kMillisecond_ns * subscription.state_ms, now_ns};
  connection.feedback = {kMillisecond_ns * subscription.feedback_ms, now_ns};
  connection.events = subscription.events;
  return {};
}

}  // namespace tactus
