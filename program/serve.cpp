// `tactus serve`: runs a pipeline in real time for clients that connect to a socket.
#include <cstdio>
#include <cstring>

#include "gateway/fnv1a.hpp"
#include "gateway/page/page_thread.hpp"
#include "gateway/sockets/server_thread.hpp"
#include "gateway/verdict_text.hpp"
#include "program/results/run_folder.hpp"
#include "program/results/scene_file.hpp"
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

/// Reads where the page is to be, if there is to be one.
bool read_page(const Options& options, Address& address) {
  Message why;
  const bool none = options.http[0] == '\0';
  return none || parse_page_address(options.http, address, why) || refuse("--http", why.c_str());
}

/// Starts the page, if there is to be one. If the computer cannot, the server continues without.
void start_page(PageThread& page, const Options& options, const Address& address) {
  Message why;
  if (options.http[0] != '\0' && !page.start(address, why))
    std::fprintf(stderr, "--http %s: there is no page: %s; the server goes on\n", options.http,
                 why.c_str());
}

void say_where(const Options& options, const char* where, const PageThread& page) {
  std::printf("%s: serves %s; Ctrl-C ends it\n", options.pipeline, where);
  if (page.started()) std::printf("page: http://127.0.0.1:%d/\n", page.port());
  std::fflush(stdout);
}

ServerSetup setup_of(const Session& session, const Options& options, ParameterBook& parameters) {
  ServerSetup setup;
  setup.board = session.board;
  setup.pipeline = stem(options.pipeline);
  setup.configuration = fnv1a(session.text);
  setup.motion_frame = session.gateway.motion_frame;
  setup.wrench_frame = session.gateway.wrench_frame;
  setup.loaded = &session.pipeline;
  for (int i = 0; i < kMostOutputs; ++i)
    setup.output_names[static_cast<std::size_t>(i)] = session.hal.output_name(i);
  setup.joint_window = session.client.capacity();
  setup.task_window = session.task_client.capacity();
  setup.log = print_line;
  setup.parameters = &parameters;
  setup.events = &session.executive.events();
  setup.hal = &session.hal;
  return setup;
}

void run_cycles(Session& session, RunLoop& loop, LogWriter& writer) {
  Progress progress({}, kInfinity);
  if (session.hal.clock() != nullptr)
    loop.at_robots_pace(*session.hal.clock(), writer, progress);
  else
    loop.in_real_time(writer, progress);
}

/// Opens the log of the session in the folder that --out names.
bool begin_log(Session& session, const Options& options, RunFolder& folder, RunLog& log) {
  if (!folder.begin({options.pipeline, nullptr}, session.text) ||
      !log.open(folder.file("log.csv").c_str(), session.pipeline.recording))
    return false;
  log.limit(options.rows);
  start_recorder(session.recorder, session.pipeline);
  return true;
}

/// Writes what a folder holds beside the log. False: prints why it could not.
bool end_log(const Session& session, const Options& options, const RunLoop& loop, RunFolder& folder,
             RunLog& log, RunResult& result) {
  result.overrides = &options.overrides;
  result.seed = options.seed;
  result.config_hash = fnv1a(session.text);
  result.simulated_s = loop.time_s();
  result.cycles = loop.commanded();
  if (!log.close() || !write_scene(folder.file("scene.json").c_str(), session.pipeline) ||
      !write_summary(folder.summary_part().c_str(), stem(options.pipeline), session, result) ||
      !folder.complete(result.cycles > 0))
    return false;
  std::printf("  written to %s\n", folder.path().c_str());
  if (log.left_out() > 0)
    std::printf("  log.csv has the first %lld rows; %lld later ones were left out (--rows)\n",
                static_cast<long long>(options.rows), static_cast<long long>(log.left_out()));
  return true;
}

/// The session did not succeed if a fault, or a refusal to arm, was all that was left of it when it
/// was ended, nor if it was ended before the arm was armed.
void judge(const RunLoop& loop, RunResult& result) {
  const Status latched = loop.latched();
  const bool ended_well = latched == Status::kOk || latched == Status::kHalted;
  if (result.code == 0 && (!ended_well || loop.cut_while_arming())) end_with(result, latched);
  if (result.code != 0) result.why = loop.why();
  if (result.code != 0 || loop.left() == Status::kOk) return;
  end_with(result, kEndedOtherwise, "drives not disabled");
  result.why = stop_reason(loop.left(), loop.left_trouble());
}

/// Says how it ended, and returns the exit code.
int finish(const Session& session, const Options& options, const RunLoop& loop,
           const RunResult& result) {
  if (loop.left() != Status::kOk)
    print_stop(options.pipeline, "not disabled", loop.left(), loop.left_trouble());
  if (result.code == 0) return kSucceeded;
  explain(session, options, loop);
  return loop.commanded() > 0 ? kEndedOtherwise : kRefused;
}

}  // namespace

int serve(Session& session, const Options& options) {
  static CycleMailboxes mailboxes;
  static ParameterBook parameters(session.pipeline);
  static Server server(setup_of(session, options, parameters), session.client, session.task_client,
                       mailboxes);
  static RunResult result;
  static TrajectoryInput input;  // a server follows none
  static Listener listener;
  Text<127> where;
  static Key key;
  Address page_address;
  if (!read_page(options, page_address) || !listen(options, listener, key, where)) return kRefused;
  static ServerThread thread(server, listener, options.key[0] != '\0' ? &key : nullptr);
  static PortMailbox ports;
  static PageThread page(
      {session.board, stem(options.pipeline), session.pipeline, session.simulated}, thread, ports);
  TrajectoryFeed feed(session, input);
  static RunLog log;
  LogWriter writer(log);
  RunFolder folder(options);
  const bool logs = options.out[0] != '\0';
  if (logs && !(begin_log(session, options, folder, log) && writer.start())) return kRefused;
  WatchdogThread watchdog;
  Realtime realtime;
  const int error = thread.start();
  if (error != 0) refuse("the thread of the server", std::strerror(error));
  if (error == 0) start_page(page, options, page_address);
  if (error != 0 || !watchdog.start(session.realtime) || !prepare(realtime, session.realtime))
    return kRefused;
  catch_interrupts();
  RunLoop loop(session, input, feed, watchdog, result, {});
  CycleEndpoint endpoint(mailboxes, session.executive, session.pipeline);
  if (page.started()) endpoint.attach(ports);
  loop.serve(endpoint);
  if (options.virtual_time) {
    session.executive.in_virtual_time();
    loop.in_virtual_time();
  }
  const bool started = loop.start();
  print_written(options.pipeline, session);
  const bool guarded = started && watchdog.arm(session.realtime);
  if (started && !guarded) end_with(result, kRefused, "refused");
  if (guarded) {
    say_where(options, listener.address().text().c_str(), page);
    run_cycles(session, loop, writer);
  } else {
    loop.stop();
  }
  watchdog.disarm();
  page.end();
  thread.end();
  judge(loop, result);
  const bool written = !logs || end_log(session, options, loop, folder, log, result);
  const int code = finish(session, options, loop, result);
  return written ? code : kEndedOtherwise;
}

}  // namespace tactus
