#include "kernel/reference/generator/reference_requests_members.hpp"

#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

// With streams, kernel/streams/generator_streams.cpp instantiates them.
#if TACTUS_CHUNK_TARGETS == 0
namespace tactus {

template bool ReferenceGenerator<JointSpace>::has_room() const;
template bool ReferenceGenerator<TaskSpace>::has_room() const;
template void ReferenceGenerator<JointSpace>::take_controls();
template void ReferenceGenerator<TaskSpace>::take_controls();
template void ReferenceGenerator<JointSpace>::take_requests();
template void ReferenceGenerator<TaskSpace>::take_requests();
template void ReferenceGenerator<JointSpace>::end_epoch();
template void ReferenceGenerator<TaskSpace>::end_epoch();

}  // namespace tactus
#endif
