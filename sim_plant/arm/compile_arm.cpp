#include "sim_plant/arm/compile_arm.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cstring>
#include <string>

#include "sim_plant/arm/robot_mjcf.hpp"

namespace tactus {
namespace {

/// What every arm has around its bodies: the payload at the flange, and a motor for each joint.
constexpr const char* kBegin = R"(
<mujoco model="arm">
  <compiler angle="degree" inertiafromgeom="false" balanceinertia="false"/>
  <option timestep="0.001" gravity="0 0 -9.81" integrator="RK4">
    <flag constraint="disable" contact="disable" energy="enable"/>
  </option>
  <size nuser_body="6" nuser_jnt="3"/>
  <default><joint user="0 1 0"/></default>
  <worldbody>
)";
constexpr const char* kPayload = R"(
    <body name="payload"><inertial mass="0" pos="0 0 0" diaginertia="0 0 0"/></body>
)";

std::string arm_text() {
  std::string text = std::string(kBegin) + robot_mjcf().bodies + kPayload;
  for (int body = 0; body <= kDof; ++body) text += "</body>";  // the links and the flange
  text += "</worldbody><actuator>";
  for (int joint = 1; joint <= kDof; ++joint)
    text += "<motor joint=\"joint" + std::to_string(joint) + "\"/>";
  return text + "</actuator></mujoco>";
}

/// Replaces the unit inertia of each link by its published tensor. MuJoCo's attribute fullinertia
/// is not used: version 2.2.2 ends its search for the principal axes so early that the tensor of
/// the FER's link 1 is wrong by 5e-7 kg m^2.
void set_inertia(mjModel* model, mjData* scratch) {
  for (int body = 1; body <= model->njnt; ++body) {  // the moving bodies, one per joint
    const double* t = model->body_user + body * model->nuser_body;
    Eigen::Matrix3d tensor;
    tensor << t[0], t[3], t[4],  //
        t[3], t[1], t[5],        //
        t[4], t[5], t[2];
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(tensor);
    Eigen::Matrix3d axes = principal.eigenvectors();
    if (axes.determinant() < 0.0) axes.col(0) = -axes.col(0);
    const Eigen::Quaterniond turn(axes);
    Eigen::Map<Eigen::Vector3d>(model->body_inertia + 3 * body) = principal.eigenvalues();
    Eigen::Map<Eigen::Vector4d>(model->body_iquat + 4 * body) << turn.w(), turn.vec();
    model->body_sameframe[body] = 0;  // set where the centre of mass is the origin: iquat is unread
  }
  mj_setConst(model, scratch);
}

}  // namespace

mjModel* compile_arm() {
  const std::string text = arm_text();
  const int size = static_cast<int>(text.size());
  static mjVFS files;  // 2 MB, too large for a stack
  mj_defaultVFS(&files);
  if (mj_makeEmptyFileVFS(&files, "arm.xml", size) != 0) return nullptr;
  std::memcpy(files.filedata[0], text.data(), text.size());
  char error[256] = "";
  mjModel* model = mj_loadXML("arm.xml", &files, error, sizeof(error));
  mj_deleteVFS(&files);
  if (model == nullptr) return nullptr;
  mjData* scratch = mj_makeData(model);
  set_inertia(model, scratch);
  mj_deleteData(scratch);
  return model;
}

}  // namespace tactus
