// A reference generator and PD with gravity compensation in a loop of your own, without file and
// executive. The arm of this example has unit inertia at every joint.
#include <tactus/fer.hpp>
// The robot's header comes first.
#include <tactus/control.hpp>
#include <tactus/model.hpp>
#include <tactus/reference.hpp>

#include <cstdio>

using namespace tactus;

static ChannelMemory<JointSpace> channel;

int main() {
  const double dt_s = 1e-3;
  JointVector q = JointVector::Zero(), dq = JointVector::Zero();
  q << 0.0, -0.8, 0.0, -2.4, 0.0, 1.6, 0.8;

  RobotModel model;
  model.q.source = &q;
  model.dq.source = &dq;
  JointReferenceGenerator generator;
  generator.q.source = &q;
  generator.dq.source = &dq;
  generator.channel = &channel;
  channel.settings.period_s = dt_s;
  PdGravity law;
  law.q_d.source = &generator.q_d.value;
  law.q.source = &q;
  law.dq.source = &dq;
  law.g.source = &model.g.value;
  law.params.kp.setConstant(100.0);
  law.params.kd.setConstant(20.0);

  if (model.start() != Status::kOk || generator.start() != Status::kOk ||
      law.start() != Status::kOk)
    return 1;
  ReferenceClient<JointSpace> client(channel);
  JointSpace::Point target;
  target.q = q + JointVector::Constant(0.3);
  std::uint32_t id = 0;
  const Verdict verdict = client.send(target, id);
  if (!verdict.ok()) return std::printf("refused: %s\n", name(verdict.status));

  for (int cycle = 0; cycle < 4000; ++cycle) {
    if (model.step(dt_s) != Status::kOk || generator.step(dt_s) != Status::kOk ||
        law.step(dt_s) != Status::kOk)
      return 1;
    dq += dt_s * (law.tau.value - model.g.value);  // your robot
    q += dt_s * dq;
    Report report;
    while (client.poll(report)) std::printf("%u: %s\n", report.id, name(report.outcome));
  }
  std::printf("largest error %.2g rad\n", (target.q - q).cwiseAbs().maxCoeff());
  return (target.q - q).cwiseAbs().maxCoeff() < 1e-4 ? 0 : 1;
}
