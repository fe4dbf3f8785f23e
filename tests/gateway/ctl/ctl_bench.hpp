// Starts a server of a simulated UR10 with a socket of its own, and tactusctl against it. In shell
// commands, $T is tactusctl and the address of the server is in the environment. Missed periods do
// not stop the arm, as the computer of a test may be busy.
#pragma once

#include "tests/program/program_bench.hpp"

namespace tactus {

inline constexpr const char* kServe =
    "d=$(dirname $P); export T=$R/build/tactusctl${d##*/ur10_sim} TACTUS_SOCKET=unix:$S/socket; "
    "serve() { : >$S/server.log; rm -f $S/all; { sed 's|trajectories/|'$R'/pipelines/&|' "
    "$R/pipelines/$1.ini; printf "
    "'\\n[executive]\\nmax_slip=1000\\nmax_late=16\\nlate_window=1\\nrest_ms=10\\n'; } "
    ">$S/served.ini; $P serve $S/served.ini --listen $TACTUS_SOCKET >$S/server.log 2>&1 & "
    "echo $! >$S/pid; n=0; until grep -q 'serves unix' $S/server.log; do "
    "n=$((n+1)); test $n -lt 600 || return 1; sleep 0.1; done; }; "
    "end() { kill $(cat $S/pid); tail --pid=$(cat $S/pid) -f /dev/null; }; "
    // Writes $S/there.csv: joint 1 to 0.6 rad in so many seconds.
    "there() { printf 'time_s,q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad,dq1_rad_s,dq2_rad_s,"
    "dq3_rad_s,dq4_rad_s,dq5_rad_s,dq6_rad_s\n%s,0.6,-1.67,1.87,2.94,-1.57,0,0,0,0,0,0,0\n' $1 "
    ">$S/there.csv; }; "
    // Prints the phase of the reference now.
    "phase() { $T watch --every-ms 10 --duration 0.2 | tail -1 | awk '{print $4}'; }; "
    "until_says() { n=0; until grep -qs \"$2\" $1; do n=$((n+1)); test $n -lt 600 || return 1; "
    "sleep 0.1; done; }; ";

/// Runs a script against a fresh server of a pipeline; returns the exit code of the script. The
/// server must end by itself. The last of what it and $S/all say is told if the code is not 0.
inline int served(const char* pipeline, const char* script) {
  Text<8191> whole(kServe);
  whole << "serve " << pipeline << " || exit 90; ( " << script
        << " ); code=$?; end; "
           "test $code = 0 || tail -n 3 $S/server.log $S/all >&2; exit $code";
  const Line path = write("script", {whole.c_str()});
  const int code = shell((Line("bash ") << path).c_str());
  if (code != 0) print_error("%.*s\n", static_cast<int>(errors().size()), errors().data());
  return code;
}

}  // namespace tactus
