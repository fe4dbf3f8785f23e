// What an image did refutes what its bound rests on: shown on events made by hand.
#include <cstdlib>

#include "tests/support/testing.hpp"

namespace {

/// Claims about 100, the cycle, which calls 200 at 110 and 300 at 120; 300 has a loop at 310,
/// entered behind 304, that goes back at 320 at most twice; it may end in a jump to 400, which is
/// no fact's.
constexpr char kClaims[] =
    "/usr/bin/python3 -c \"import array, sys, tempfile; sys.path.insert(0, 'scripts/wcet')\n"
    "import refuted\n"
    "CALL, RETURN = 1 << 30, 1 << 29\n"
    "claims = {'root': [100], 'functions': {'100': 'cycle', '200': 'once', '300': 'turns', '400': "
    "'behind'},\n"
    "  'sites': {'110': [200], '120': [300]}, 'sizes': {}, 'assumed': {400: 80}, 'loops': "
    "[{'function': 300, 'place': "
    "'x.cpp:7',\n"
    "  'often': 2, 'enter': [304], 'parts': [[310, [320]]]}], 'facts': [\n"
    "  {'fact': 'calls', 'kind': 'calls', 'in': [100], 'of': [200], 'inner': [], 'most': 1},\n"
    "  {'fact': 'reaches', 'kind': 'reaches', 'in': [100], 'of': [200, 300], 'inner': [400], "
    "'most': 1}]}\n"
    "def refutes(*events):\n"
    "    file = tempfile.NamedTemporaryFile()\n"
    "    file.write(array.array('I', events).tobytes())\n"
    "    file.flush()\n"
    "    return list(refuted.Replay(refuted.Claims(claims)).run(file.name))\n"
    "cycle = lambda *events: (CALL + 50, 100, 100, *events, RETURN + 1)\n"
    "once = (CALL + 114, 200, 200, RETURN + 1)\n"
    "turns = lambda n, *events: (CALL + 124, 300, 300, 304, 310, *[320, 310] * n, *events, RETURN "
    "+ 1)\n";

bool holds(const char* script) {
  static char command[4096];
  std::snprintf(command, sizeof command, "%s%s\"", kClaims, script);
  return std::system(command) == 0;
}

// Proves BND-9.

void what_the_claims_allow_is_not_refuted(void**) {
  assert_true(
      holds("assert refutes(*cycle(*once, *turns(2), *turns(2))) == []\n"
            "assert refutes(*cycle(*once), *cycle(*once)) == []\n"  // each cycle anew
            "assert refutes(*turns(9), *cycle(*once), *once) == []\n"));
}

void a_loop_that_goes_back_too_often_is_named(void**) {
  assert_true(
      holds("why, = refutes(*cycle(*turns(3)))\n"
            "assert why == 'turns: a loop goes back more than 2 times: x.cpp:7', why\n"));
}

void a_call_that_breaks_a_fact_is_named(void**) {
  assert_true(
      holds("why, = refutes(*cycle(*once, *once))\n"
            "assert why == 'a call of cycle breaks the fact: calls', why\n"
            "why, = refutes(*cycle(*turns(0, 400), *turns(0, 400)))\n"  // it jumps there
            "assert why == 'a call of cycle breaks the fact: reaches', why\n"
            "assert refutes(*cycle(*turns(0, 400), *turns(0))) == []\n"));
}

void a_function_that_takes_more_than_assumed_is_named(void**) {
  assert_true(
      holds("replay = refuted.Replay(refuted.Claims(claims))\n"
            "replay.took(400, 80), replay.took(300, 900)\n"
            "assert not replay.bad\n"
            "replay.took(400, 81)\n"
            "assert list(replay.bad) == ['behind takes 81 instructions, not 80']\n"));
}

void a_callee_that_the_graph_lacks_is_named(void**) {
  assert_true(
      holds("why, = refutes(*cycle(CALL + 114, 300, 300, RETURN + 1))\n"
            "assert why == '0x6e calls 0x12c turns, which is not among its targets', why\n"));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(what_the_claims_allow_is_not_refuted),
      cmocka_unit_test(a_loop_that_goes_back_too_often_is_named),
      cmocka_unit_test(a_call_that_breaks_a_fact_is_named),
      cmocka_unit_test(a_function_that_takes_more_than_assumed_is_named),
      cmocka_unit_test(a_callee_that_the_graph_lacks_is_named),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
