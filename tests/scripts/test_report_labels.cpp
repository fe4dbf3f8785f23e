// Tests the figures of the report: no label reaches beyond its figure.
#include "tests/program/program_bench.hpp"

namespace tactus {
namespace {

// Proves RUN-7.

void no_label_of_a_figure_is_cut(void**) {
  for (const char* run : {"fer_jrg_pdgc", "fer_trg_ac_cpc_pid"}) {
    setenv("RUN", run, 1);
    assert_int_equal(shell("$P run pipelines/$RUN.ini --no-figure --duration 3 --out $S/runs/$RUN"),
                     1);
  }
  const int code =
      shell("$R/tests/scripts/find_cut_labels.py $S/runs fer_jrg_pdgc fer_trg_ac_cpc_pid");
  print_message("%.*s%.*s", static_cast<int>(output().size()), output().data(),
                static_cast<int>(errors().size()), errors().data());
  assert_int_equal(code, 0);
}

}  // namespace
}  // namespace tactus

int main(int, char** argv) {
  using namespace tactus;
  const CMUnitTest tests[] = {cmocka_unit_test(no_label_of_a_figure_is_cut)};
  return run_program_tests(argv[0], tests);
}
