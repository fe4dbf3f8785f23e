// Tests the memory of a pipeline's blocks: they take the sizes of their kinds, and a file whose
// blocks need more than the board has is refused.
#include "kernel/pipeline/kinds.hpp"
#include "tests/load/loader_bench.hpp"
#include "tests/support/testing.hpp"

namespace tactus {
namespace {

constexpr std::size_t kModelAndGenerator = sizeof(RobotModel) + sizeof(JointReferenceGenerator);
constexpr std::size_t kNeeded = kModelAndGenerator + 2 * sizeof(PdGravity);

/// Loads the valid file into a pipeline with `kBytes` for its blocks.
template <std::size_t kBytes>
Status load(std::size_t& left, LoadError& error) {
  static ChannelMemory<JointSpace> channel;
  static PipelineMemory<kBytes> pipeline;
  static SimSections board;
  const Status status = Loader({&channel}, kTorqueRobot, board).load(kValid, pipeline, error);
  left = pipeline.memory.left();
  return status;
}

// Proves MEM-4.

void blocks_take_the_sizes_of_their_kinds(void**) {
  std::size_t left = 0;
  LoadError error;
  ASSERT_OK(load<kNeeded + 100>(left, error));
  assert_int_equal(left, 100);
  ASSERT_OK(load<kNeeded>(left, error));
  assert_int_equal(left, 0);
}

void a_block_that_does_not_fit_is_refused_with_what_it_takes_and_what_is_left(void**) {
  std::size_t left = 0;
  LoadError error;
  ASSERT_STATUS(load<kNeeded - 1>(left, error), Status::kTooLarge);
  const Message expected = Message("the block takes ")
                           << sizeof(PdGravity) << " bytes; of the board's " << kNeeded - 1
                           << " for blocks " << sizeof(PdGravity) - 1 << " are left";
  assert_string_equal(error.reason.c_str(), expected.c_str());
  assert_string_equal(error.section.c_str(), "stiff");
  assert_string_equal(error.key.c_str(), "type");
  assert_int_equal(error.line, 34);
}

}  // namespace
}  // namespace tactus

int main() {
  using namespace tactus;
  const CMUnitTest tests[] = {
      cmocka_unit_test(blocks_take_the_sizes_of_their_kinds),
      cmocka_unit_test(a_block_that_does_not_fit_is_refused_with_what_it_takes_and_what_is_left),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
