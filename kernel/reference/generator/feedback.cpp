#include "kernel/reference/generator/feedback.hpp"

#include "kernel/reference/space/joint_space.hpp"
#include "kernel/reference/space/task_space.hpp"

namespace tactus {

template <class Space>
void FeedbackPublisher<Space>::start(int divisor, Fields measured) {
  divisor_ = divisor;
  measured_ = measured;
}

template <class Space>
void FeedbackPublisher<Space>::step(std::int64_t cycle, double time_s, std::uint32_t id,
                                    const Point& desired, const Point& measured,
                                    FeedbackQueue<Space>& queue) {
  if (divisor_ == 0 || cycle % divisor_ != 0) return;
  Feedback<Space> message;
  static_cast<Progress&>(message) = *this;
  message.time_s = time_s;
  message.id = id;
  message.lost = lost_;
  message.desired = desired;
  message.actual = measured.as_measured(measured_);
  message.error = Space::error(desired, message.actual);
  lost_ = queue.post(message) ? 0 : lost_ + 1;
}

template class FeedbackPublisher<JointSpace>;
template class FeedbackPublisher<TaskSpace>;

}  // namespace tactus
