// Tests the tools that measure and count the worst case against known answers. Runs from the root
// of the project.
#include <unistd.h>

#include <cstdlib>

#include "tests/support/testing.hpp"

namespace {

#define IMAGE "build/fer_sim-m7/wcet-fer_trg_ac_cpc_pid.elf"  // of make tests
#define PYTHON "/usr/bin/python3 -c \"import sys; sys.path.insert(0, 'scripts/wcet')\n"

bool passes(const char* command) {
  return std::system(command) == 0;
}

// Proves TIM-1.

/// A generalised extreme-value law of known shape, location and scale; its quantile is the oracle.
void a_known_level_is_within_the_interval_in_most_draws(void**) {
  assert_true(passes(PYTHON "import numpy, extremes\n"
                            "inside, quoted, shape, p = 0, 0, 0.1, 1e-3\n"
                            "true = 7 + 2 * ((-numpy.log1p(-p)) ** -shape - 1) / shape\n"
                            "for seed in range(5):\n"
                            "    u = numpy.random.default_rng(seed).uniform(size=300)\n"
                            "    values = 7 + 2 * ((-numpy.log(u)) ** -shape - 1) / shape\n"
                            "    e = extremes.extremes(values, 1, p)\n"
                            "    quoted += not e.why\n"
                            "    inside += e.low <= true <= e.high if not e.why else 0\n"
                            "assert quoted >= 3 and inside >= 0.75 * quoted, (quoted, inside)\""));
}

void what_breaks_an_assumption_is_not_quoted_and_named(void**) {
  assert_true(passes(PYTHON
                     "import numpy, extremes\n"
                     "rng = numpy.random.default_rng(2)\n"
                     "cases = {\n"
                     "  'maxima not independent': rng.normal(size=20000).cumsum(),\n"
                     "  'not of one law': numpy.r_[rng.normal(size=(60, 100)).ravel(),\n"
                     "                             0.4 + rng.normal(size=(60, 100)).ravel()],\n"
                     "  'tail does not fit': numpy.where(rng.uniform(size=20000) < 0.004, 30, 0)\n"
                     "                       + rng.normal(size=20000),\n"
                     "  'tail too heavy': rng.pareto(1.0, size=20000),\n"
                     "  'likelihood not regular': rng.uniform(size=20000),\n"
                     "  'all maxima are the same': numpy.ones(20000),\n"
                     "  'fewer than 50': rng.normal(size=2000)}\n"
                     "for why, values in cases.items():\n"
                     "    quote = extremes.extremes(values, 100, 1e-6).quote()\n"
                     "    assert quote.startswith('not quoted: '), (why, quote)\n"
                     "    assert why in quote or why == 'not of one law' and 'independent' in "
                     "quote, (why, quote)\""));
}

// Proves TIM-2.

/// mov, a hundred times sub and branch, return: 202 instructions; its caller adds a call and a
/// return.
void a_loop_counted_by_hand_has_the_plugins_count(void**) {
  assert_true(passes(
      "d=$(mktemp -d) && printf '.syntax unified\\n.thumb\\n.cpu cortex-m7\\n.word 0x20008000, "
      "start+1\\n"
      ".thumb_func\\n.type loop,%%function\\nloop: movs r0,#100\\n1: subs r0,#1\\nbne 1b\\nbx lr\\n"
      ".thumb_func\\n.type outer,%%function\\nouter: push {lr}\\nbl loop\\nbl loop\\npop {pc}\\n"
      ".thumb_func\\n.type start,%%function\\nstart: bl outer\\nmovs r0,#0x18\\n"
      "ldr r1,=0x20026\\nbkpt 0xab\\nb .\\n' >$d/a.s &&"
      "arm-none-eabi-gcc -nostdlib -Wl,-Ttext=0,--entry=start -o $d/a.elf $d/a.s && "
      "gcc -O2 -shared -fPIC -o $d/p.so tests/wcet/count_plugin.c && "
      "at() { arm-none-eabi-nm $d/a.elf | awk -v n=$1 '$3 == n { print $1 }'; } && "
      "printf %x $((0x$(at loop) + 2)) >$d/marks && "
      "qemu-system-arm -M mps2-an500 -nographic -monitor none -serial none "
      "-semihosting-config enable=on,target=native -kernel $d/a.elf -plugin "
      "$d/p.so,watch=$(at outer),watch=$(at "
      "loop),calls=$d/calls,cover=$d/cover,marks=$d/marks,events=$d/events </dev/null && "
      "events() { od -An -v -tx4 -w4 $d/events | grep -c \"$1\"; } && "
      "test $(events \"^ *0*$(cat $d/marks)\\$\") = 200 && test $(events ' 20000001') = 3 && "
      "test $(events ' 4000') = 3 && "
      "test \"$(cat $d/calls)\" = '408 404' && "
      "grep -q \"^$(printf %x $((0x$(at loop) + 2))) 2 200\\$\" $d/cover && rm -r $d"));
}

// Proves TIM-3.

void twice_the_same_tapes_give_the_same_counts(void**) {
  if (access(IMAGE, F_OK) != 0) print_error(IMAGE " is not there; run make tests\n");
  assert_true(passes(
      PYTHON
      "import emulator, hostile, random\n"
      "text = open('pipelines/fer_trg_ac_cpc_pid.ini').read()\n"
      "stages = emulator.stages(text)\n"
      "tapes = [t.data for t in hostile.by_hand(7)[22:24]] + [hostile.at_random(7, 5).data]\n"
      "tapes += [random.Random(seed).randbytes(300) for seed in range(8)]\n"
      "image, plugin = '" IMAGE
      "', 'build/wcet/count_plugin.so'\n"
      "count = lambda: emulator.count(image, plugin, stages.values(), tapes)\n"
      "first, second = count(), count()\n"
      "assert first == second and len(first) == 11\n"
      "rows = [row for _, mine in first for row in mine]\n"
      "assert all(row[0] > sum(row[1:]) for row in rows) and max(rows)[0] > 100000\""));
}

// Proves TIM-4.

void a_bound_below_a_count_is_an_error_and_what_is_missing_a_dash(void**) {
  assert_true(passes(
      "d=$(mktemp -d) && root=$PWD && mkdir -p $d/build/wcet/x && cd $d/build/wcet/x && "
      "echo '{\"symbols\": {\"a\": \"f<A>(\", \"b\": \"f<B>(\"}, \"stages\": {"
      "\"a\": {\"typical\": {\"instructions\": 5}, "
      "\"worst\": {\"instructions\": 60, \"tape\": \"t\", \"cycle\": 3}}, "
      "\"b\": {\"typical\": {\"instructions\": 7}, "
      "\"worst\": {\"instructions\": 8, \"tape\": \"t\", \"cycle\": 4}}}}' >counted.json && cd $d "
      "&& "
      "$root/scripts/wcet/table x >out && grep -Eq '^  a +- +- +- +5 +60 +- +- +-$' out && "
      "echo '{\"stages\": {\"a\": {\"instructions\": 80}, \"f<B>(int)\": {\"instructions\": 8}}}' "
      ">build/wcet/x/bounds.json && $root/scripts/wcet/table x >out && "
      "grep -Eq ' 60 +80 +0.75 ' out && grep -Eq ' 8 +8 +1.00 ' out && "
      "sed -i s/80/59/ build/wcet/x/bounds.json && ! $root/scripts/wcet/table x >out 2>err && "
      "grep -q 'x: a: counted 60, but the bound is 59' err && test -s build/wcet/wcet.json && rm "
      "-r "
      "$d"));
}

void a_bound_of_the_cycle_far_beyond_its_worst_is_an_error(void**) {
  for (const char* stage : {"cycle", "with rows"}) {
    setenv("stage", stage, 1);
    assert_true(passes(
        "d=$(mktemp -d) && root=$PWD && mkdir -p $d/build/wcet/x && cd $d/build/wcet/x && "
        "echo '{\"symbols\": {}, \"stages\": {\"'\"$stage\"'\": {\"typical\": "
        "{\"instructions\": 5}, "
        "\"worst\": {\"instructions\": 60, \"tape\": \"t\", \"cycle\": 3}}}}' >counted.json && "
        "bound() { echo '{\"stages\": {\"'\"$stage\"'\": {\"instructions\": '$1'}}}' "
        ">bounds.json; } && "
        "bound 150 && (cd $d && $root/scripts/wcet/table x >out) && bound 151 && cd $d && "
        "! $root/scripts/wcet/table x >out 2>err && "
        "grep -q \"x: $stage: its tightness is 0.397, less than 0.400\" err && rm -r $d"));
  }
}

/// 240 cycles at 60 MHz are 4 us: within the period of 4 us, and within the 4 us that the board
/// states, but not within 3 us.
void the_cycle_with_rows_is_compared_with_the_period_and_with_what_the_board_states(void**) {
  assert_true(passes(
      "d=$(mktemp -d) && root=$PWD && cd $d && mkdir -p build/wcet/x boards/y_sim pipelines && "
      "state() { printf 'CORE_MHZ := 60\nCORE_LIMIT_US := %s\n' $1 >boards/y_sim/board.mk; "
      "printf 'name = y\nperiod_us = %s\n' $2 >pipelines/x.ini; } && "
      "echo '{\"symbols\": {}, \"stages\": {\"with rows\": {\"typical\": {\"instructions\": 5}, "
      "\"worst\": {\"instructions\": 60, \"tape\": \"t\", \"cycle\": 3}}}}' "
      ">build/wcet/x/counted.json && "
      "echo '{\"stages\": {\"with rows\": {\"instructions\": 80, \"cycles\": 240}}}' "
      ">build/wcet/x/bounds.json && "
      "state 4 4 && $root/scripts/wcet/table x >out && "
      "grep -q 'at 60 MHz with rows 4 us at most: fits the period of 4 us' out && "
      "state 4 3 && $root/scripts/wcet/table x >out && grep -q 'does not fit the period of 3 us' "
      "out "
      "&& state 3 4 && ! $root/scripts/wcet/table x >out 2>err && "
      "grep -q 'x: with rows: at most 4 us, but its board states 3 us' err && rm -r $d"));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      cmocka_unit_test(a_known_level_is_within_the_interval_in_most_draws),
      cmocka_unit_test(what_breaks_an_assumption_is_not_quoted_and_named),
      cmocka_unit_test(a_loop_counted_by_hand_has_the_plugins_count),
      cmocka_unit_test(twice_the_same_tapes_give_the_same_counts),
      cmocka_unit_test(a_bound_below_a_count_is_an_error_and_what_is_missing_a_dash),
      cmocka_unit_test(a_bound_of_the_cycle_far_beyond_its_worst_is_an_error),
      cmocka_unit_test(
          the_cycle_with_rows_is_compared_with_the_period_and_with_what_the_board_states),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
