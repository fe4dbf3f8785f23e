#include "kernel/reference/feedback.hpp"

#include "kernel/reference/joint_space.hpp"
#include "kernel/reference/task_space.hpp"

namespace tactus {

template <class Space>
void FeedbackPublisher<Space>::start(int divisor, Fields measured) {
  divisor_ = static_cast<std::uint64_t>(divisor);
  cycle_ = 0;
  measured_ = measured;
}

template <class Space>
void FeedbackPublisher<Space>::step(double dt_s, std::uint32_t id, const Point& desired,
                                    const Point& measured, FeedbackMailbox<Space>& mailbox) {
  ++cycle_;
  if (divisor_ == 0 || cycle_ % divisor_ != 0) return;
  Feedback<Space> message;
  message.time_s = static_cast<double>(cycle_) * dt_s;
  message.id = id;
  message.lost = lost_;
  message.desired = desired;
  message.actual = measured.as_measured(measured_);
  message.error = Space::error(desired, message.actual);
  lost_ = mailbox.post(message) ? 0 : lost_ + 1;
}

template class FeedbackPublisher<JointSpace>;
template class FeedbackPublisher<TaskSpace>;

}  // namespace tactus
