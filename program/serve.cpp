// `tactus serve`: runs a pipeline in real time for clients that connect to a socket.
#include <cstdio>
#include <cstring>

#include "gateway/fnv1a.hpp"
#include "gateway/sockets/server_thread.hpp"
#include "gateway/verdict_text.hpp"
#include "program/run_loop.hpp"
#include "program/session/session.hpp"

namespace tactus {
namespace {

void print_line(const char* line) {
  std::printf("%s\n", line);
  std::fflush(stdout);
}

bool refuse(const char* subject, const char* reason) {
  std::fprintf(stderr, "%s: refused: %s\n", subject, reason);
  return false;
}

/// Opens the sockets. Another address than the computer's own needs a key. Datagrams are not
/// encrypted, and so not taken with a key.
bool listen(const Options& options, Listener& listener, Key& key, Text<127>& where) {
  where = options.listen[0] != '\0' ? Text<127>(options.listen) : default_address();
  Address address;
  Message why;
  if (!address.parse(where, why)) return refuse("--listen", why.c_str());
  const bool keyed = options.key[0] != '\0';
  if (!address.loopback() && !keyed)
    return refuse(where.c_str(),
                  "programs on other computers would reach it; give --key FILE, or listen at "
                  "unix:PATH or tcp:127.0.0.1:PORT");
  if (keyed && !Tunnel::prepare()) return refuse("--key", "libsodium cannot be used");
  if (keyed && !read_key(options.key, key, why)) return refuse("--key", why.c_str());
  return listener.open(address, !keyed, why) || refuse(where.c_str(), why.c_str());
}

ServerSetup setup_of(const Session& session, const Options& options, ParameterBook& parameters) {
  ServerSetup setup;
  setup.board = session.board;
  setup.pipeline = stem(options.pipeline);
  setup.configuration = fnv1a(session.text);
  setup.motion_frame = session.gateway.motion_frame;
  setup.wrench_frame = session.gateway.wrench_frame;
  setup.loaded = &session.pipeline;
  setup.joint_window = session.client.capacity();
  setup.task_window = session.task_client.capacity();
  setup.log = print_line;
  setup.parameters = &parameters;
  return setup;
}

void run_cycles(Session& session, RunLoop& loop, LogWriter& writer) {
  Progress progress({}, kInfinity);
  if (session.hal.clock() != nullptr)
    loop.at_robots_pace(*session.hal.clock(), writer, progress);
  else
    loop.in_real_time(writer, progress);
}

/// Says how it ended, and returns the exit code.
int finish(const Session& session, const Options& options, const RunLoop& loop,
           const RunResult& result) {
  if (loop.left() != Status::kOk) {
    print_stop(options.pipeline, "not disabled", loop.left(), {}, loop.left_trouble());
    return kEndedOtherwise;
  }
  if (result.code == 0) return kSucceeded;
  print_stop(options.pipeline, "stopped", result.fault, session.executive.guard().telemetry(),
             loop.trouble());
  return kEndedOtherwise;
}

}  // namespace

int serve(Session& session, const Options& options) {
  static CycleMail mail;
  static ParameterBook parameters(session.pipeline);
  static Server server(setup_of(session, options, parameters), session.client, session.task_client, mail);
  static RunResult result;
  static TrajectoryInput input;  // a server follows none
  static Listener listener;
  Text<127> where;
  static Key key;
  if (!listen(options, listener, key, where)) return kRefused;
  static ServerThread thread(server, listener, options.key[0] != '\0' ? &key : nullptr);
  TrajectoryFeed feed(session, input);
  RunLog log;
  LogWriter writer(log);
  WatchdogThread watchdog;
  Realtime realtime;
  const int error = thread.start();
  if (error != 0) refuse("the thread of the server", std::strerror(error));
  if (error != 0 || !watchdog.start(session.realtime) || !prepare(realtime, session.realtime))
    return kRefused;
  catch_interrupts();
  RunLoop loop(session, input, feed, watchdog, result, {});
  CycleDesk desk(mail, session.executive, session.pipeline);
  loop.serve(desk);
  if (options.virtual_time) {
    session.executive.in_virtual_time();
    loop.in_virtual_time();
  }
  if (!loop.start() || !watchdog.arm(session.realtime)) {
    thread.end();
    loop.stop();
    print_stop(options.pipeline, "refused", result.fault, {}, session.hal.trouble());
    return kRefused;
  }
  std::printf("%s: serves %s; Ctrl-C ends it\n", options.pipeline, where.c_str());
  std::fflush(stdout);
  run_cycles(session, loop, writer);
  watchdog.disarm();
  thread.end();
  return finish(session, options, loop, result);
}

}  // namespace tactus
