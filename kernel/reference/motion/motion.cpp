#include "kernel/reference/motion/motion_members.hpp"

#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

// With streams, kernel/streams/motion_streams.cpp instantiates it.
#if TACTUS_CHUNK_TARGETS == 0
namespace tactus {

template class Motion<JointSpace>;
template class Motion<TaskSpace>;

}  // namespace tactus
#endif
