#include "kernel/reference/generator/reference_generator_members.hpp"

#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

// With streams, kernel/streams/generator_streams.cpp instantiates it.
#if TACTUS_CHUNK_TARGETS == 0
namespace tactus {

template class ReferenceGenerator<JointSpace>;
template class ReferenceGenerator<TaskSpace>;

}  // namespace tactus
#endif
