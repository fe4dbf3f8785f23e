#include "sim_plant/arm/arm.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <type_traits>

#include "kernel/core/names.hpp"
#include "sim_plant/arm/compile_arm.hpp"
#include "sim_plant/arm/flange_wrench.hpp"

namespace tactus {
namespace {

static_assert(std::is_same_v<mjtNum, double>, "MuJoCo of double precision");

constexpr double kMaxFreeStep_s = 1e-3;
constexpr double kMaxContactStep_s = 0.25e-3;

/// Visitor of PlantParams::describe that checks whether all settings are in their ranges.
struct RangeCheck {
  bool ok = true;

  void param(const char*, double value, Range range, const char*) {
    ok = ok && range.contains(value);
  }
  template <int N>
  void param(const char* name, const Eigen::Matrix<double, N, 1>& value, Range range,
             const char* unit) {
    for (int i = 0; i < N; ++i) param(name, value[i], range, unit);
  }
  void optional(const char* name, const Vector3& value, Range range, const char* unit) {
    if (!value.hasNaN()) param(name, value, range, unit);
  }
  template <class Enum>
  void choice(const char*, Enum value) {
    ok = ok && static_cast<std::size_t>(value) < kNames<Enum>.size();
  }
};

double sigmoid(double x) {
  return 1.0 / (1.0 + std::exp(-x));
}

/// Friction torque of a joint, N m. The model holds its parameters: see jnt_user in
/// compile_arm.hpp.
double friction(const mjModel* model, int joint, double dq) {
  const double* abc = model->jnt_user + joint * model->nuser_jnt;
  const double a = abc[0], b = abc[1], c = abc[2];
  return a * (sigmoid(b * (dq + c)) - sigmoid(b * c));
}

/// Adds the friction torques to the passive forces.
void add_friction(const mjModel* model, mjData* data) {
  if (model->nuser_jnt < 3) return;  // a model without friction parameters
  for (int i = 0; i < model->njnt; ++i) {
    const int dof = model->jnt_dofadr[i];
    data->qfrc_passive[dof] -= friction(model, i, data->qvel[dof]);
  }
}

/// MuJoCo's callback at the end of its passive forces, and so in every stage of the integrator.
void add_forces(const mjModel* model, mjData* data) {
  add_friction(model, data);
  TipContact::add_attached(model, data);
}

/// Replaces MuJoCo's own handler, which writes a log file into the working directory. mjData still
/// counts warnings; diverged() reads them there.
void stay_silent(const char*) {}

/// Turns a vector of the world into the axes of a base mounted by roll, pitch and yaw, rad.
Vector3 in_base(const double* world, const Vector3& mounting) {
  const Eigen::Matrix3d base = (Eigen::AngleAxisd(mounting[2], Vector3::UnitZ()) *
                                Eigen::AngleAxisd(mounting[1], Vector3::UnitY()) *
                                Eigen::AngleAxisd(mounting[0], Vector3::UnitX()))
                                   .toRotationMatrix();
  return base.transpose() * Eigen::Map<const Vector3>(world);
}

/// Puts the settings into the compiled model and derives its constants again.
void apply(const PlantParams& params, mjModel* model, mjData* scratch) {
  for (int i = 0; i < kDof; ++i) {
    model->dof_armature[i] = params.rotor_inertia[i];
    model->jnt_user[i * model->nuser_jnt] *= params.friction;  // a
  }
  const int payload = mj_name2id(model, mjOBJ_BODY, "payload");
  model->body_mass[payload] = params.payload_kg;
  // The body is moved, not the centre of mass within it: the compiler has noted that the two
  // coincide, and MuJoCo relies on that note (body_sameframe).
  Eigen::Map<Vector3>(model->body_pos + 3 * payload) = params.payload_com;
  mj_setConst(model, scratch);
  if (!params.mounting.hasNaN())
    Eigen::Map<Vector3>(model->opt.gravity) = in_base(model->opt.gravity, params.mounting);
}

}  // namespace

Arm::~Arm() {
  mj_deleteData(data_);
  mj_deleteModel(model_);
}

Status Arm::load(const PlantParams& params) {
  const Scene scene = make_scene(params.scene, params.scene_offset, params.tip_radius);
  return load(params, turned(scene, robot_mjcf().base_link_yaw));
}

Status Arm::load(const PlantParams& params, const Scene& scene) {
  RangeCheck check;
  PlantParams(params).describe(check);
  if (!check.ok) return Status::kBadValue;

  mj_deleteData(data_);
  mj_deleteModel(model_);
  model_ = compile_arm();
  if (model_ != nullptr) model_->nuserdata = 1;  // see TipContact::attach
  data_ = model_ != nullptr ? mj_makeData(model_) : nullptr;
  if (data_ == nullptr) return Status::kTooLarge;

  mjcb_passive = add_forces;  // hooks of the whole process; every arm sets the same
  mju_user_warning = stay_silent;
  apply(params, model_, data_);
  mj_resetData(model_, data_);
  Eigen::Map<JointVector>(data_->qpos) = params.initial_q;
  contact_.load(scene, params.material, mj_name2id(model_, mjOBJ_BODY, "flange"),
                params.payload_tip, params.tip_radius);
  carries_ = params.payload_kg > 0.0;
  contact_.attach(data_);
  stand();
  return Status::kOk;
}

JointVector Arm::stand() {
  Eigen::Map<JointVector>(data_->qvel).setZero();
  contact_.begin(model_, data_, 0.0);
  mj_fwdPosition(model_, data_);
  mj_fwdVelocity(model_, data_);
  Eigen::Map<JointVector>(data_->qacc).setZero();
  sense();
  return Eigen::Map<const JointVector>(data_->qfrc_bias) -
         Eigen::Map<const JointVector>(data_->qfrc_passive);
}

void Arm::step(const JointVector& tau, double dt_s) {
  // The small term makes 1 ms with a rounding error one inner step, not two.
  const double longest_s = contact_.none() ? kMaxFreeStep_s : kMaxContactStep_s;
  const int steps = static_cast<int>(std::ceil(dt_s / longest_s - 1e-9));
  model_->opt.timestep = dt_s / steps;
  Eigen::Map<JointVector>(data_->ctrl) = tau;
  for (int i = 0; i < steps; ++i) {
    mj_step(model_, data_);
    contact_.begin(model_, data_, model_->opt.timestep);
  }
  if (carries_ || !contact_.none()) mj_forward(model_, data_);  // a step ends at its last stage
  sense();
}

/// Updates the sensed wrenches. Poses, velocities and accelerations must belong to one state.
void Arm::sense() {
  contact_wrench_ = contact_.wrench(model_, data_);
  ft_ = carries_ || !contact_.none() ? flange_wrench(model_, data_, contact_wrench_)
                                     : Vector6(Vector6::Zero());
}

JointVector Arm::inverse_dynamics(const JointVector& ddq) {
  mj_fwdPosition(model_, data_);  // a step leaves these at its last stage
  mj_fwdVelocity(model_, data_);
  JointVector tau;
  mj_mulM(model_, data_, tau.data(), ddq.data());
  return tau + Eigen::Map<const JointVector>(data_->qfrc_bias) -
         Eigen::Map<const JointVector>(data_->qfrc_passive);
}

JointVector Arm::gravity() {
  const JointVector dq = this->dq();
  Eigen::Map<JointVector>(data_->qvel).setZero();
  mj_fwdPosition(model_, data_);
  mj_fwdVelocity(model_, data_);
  const JointVector g = Eigen::Map<const JointVector>(data_->qfrc_bias);
  Eigen::Map<JointVector>(data_->qvel) = dq;
  return g;
}

JointVector Arm::torque_holding(const std::array<bool, kDof>& held, const JointVector& ddq,
                                const JointVector& tau) {
  // M ddq + h = tau, with the accelerations of the held joints given and those of the others not.
  Eigen::Matrix<double, kDof, kDof> M, A;
  const JointVector h = inverse_dynamics(JointVector::Zero());
  mj_fullM(model_, M.data(), data_->qM);
  A = M;
  JointVector given = JointVector::Zero(), known = tau - h;
  for (int i = 0; i < kDof; ++i)
    if (held[static_cast<std::size_t>(i)]) given[i] = ddq[i];
  known -= M * given;
  for (int i = 0; i < kDof; ++i) {
    if (!held[static_cast<std::size_t>(i)]) continue;
    A.row(i).setZero();
    A.col(i).setZero();
    A(i, i) = 1.0;
    known[i] = ddq[i];
  }
  const JointVector all = A.ldlt().solve(known);
  JointVector torque = M * all + h;
  for (int i = 0; i < kDof; ++i)
    if (!held[static_cast<std::size_t>(i)]) torque[i] = tau[i];
  return torque;
}

JointVector Arm::contact_torque() const {
  JointVector tau = JointVector::Zero();
  contact_.add_torque(model_, data_, tau.data());
  return tau;
}

bool Arm::diverged() const {
  for (const mjWarningStat& warning : data_->warning)
    if (warning.number > 0) return true;
  return !q().allFinite() || !dq().allFinite();
}

Vector3 Arm::base_gravity() const {
  return Eigen::Map<const Vector3>(model_->opt.gravity);
}

JointVector Arm::q() const {
  return Eigen::Map<const JointVector>(data_->qpos);
}

JointVector Arm::dq() const {
  return Eigen::Map<const JointVector>(data_->qvel);
}

double Arm::energy() const {
  mj_kinematics(model_, data_);  // a step leaves these at its last stage
  mj_comPos(model_, data_);
  mj_crb(model_, data_);
  mj_energyPos(model_, data_);  // these two need the flag energy="enable" of the model
  mj_energyVel(model_, data_);
  return data_->energy[0] + data_->energy[1] + contact_.energy();
}

}  // namespace tactus
