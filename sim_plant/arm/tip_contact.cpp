#include "sim_plant/arm/tip_contact.hpp"

#include <mujoco/mujoco.h>

#include <cstring>

namespace tactus {
namespace {

/// Pose of a body in the base frame.
struct BodyFrame {
  Vector3 p;
  Matrix3 r;

  BodyFrame(const mjData* data, int body)
      : p(Eigen::Map<const Vector3>(data->xpos + 3 * body)),
        r(Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(data->xmat + 9 * body)) {}
  Vector3 to_base(const Vector3& point) const { return p + r * point; }
  Vector3 from_base(const Vector3& point) const { return r.transpose() * (point - p); }
};

}  // namespace

void TipContact::load(const Scene& scene, const Material& material, int body, const Vector3& centre,
                      double radius) {
  *this = TipContact();
  scene_ = scene;
  material_ = material;
  body_ = body;
  centre_ = centre;
  radius_ = radius;
}

void TipContact::attach(mjData* data) const {
  const void* self = this;
  static_assert(sizeof self <= sizeof(mjtNum));
  std::memcpy(data->userdata, &self, sizeof self);
}

void TipContact::add_attached(const mjModel* model, mjData* data) {
  if (model->nuserdata < 1) return;
  const void* attached = nullptr;  // as after a reset of the data
  std::memcpy(&attached, data->userdata, sizeof attached);
  if (attached != nullptr)
    static_cast<const TipContact*>(attached)->add_torque(model, data, data->qfrc_passive);
}

void TipContact::begin(const mjModel* model, mjData* data, double h_s) {
  if (none()) return;
  mj_kinematics(model, data);
  mj_comPos(model, data);
  const BodyFrame frame(data, body_);
  const Vector3 centre = frame.to_base(centre_);
  for (int i = 0; i < scene_.count; ++i) {
    Contact& contact = contacts_[static_cast<std::size_t>(i)];
    const Touch touch = find_touch(scene_.boxes[static_cast<std::size_t>(i)], centre, radius_);
    if (h_s > 0.0) slip(touch, find_force(model, data, i), h_s, contact);
    contact.place = centre - radius_ * touch.normal;
    contact.point = frame.from_base(contact.place);
    contact.depth = touch.depth;
  }
}

/// Moves the bristle over the step that ended at `touch` and `force`.
void TipContact::slip(const Touch& touch, const Force& force, double h_s, Contact& contact) const {
  const Vector3 moved = tangential(force.at - contact.place, touch.normal);
  const Vector3 bristle = tangential(contact.bristle, touch.normal);
  const double normal = touch.normal.dot(force.force);
  contact.bristle = touch.depth <= 0.0 ? Vector3(Vector3::Zero())
                                       : next_bristle(material_, normal, bristle, moved, h_s);
}

TipContact::Force TipContact::find_force(const mjModel* model, const mjData* data, int i) const {
  const Contact& contact = contacts_[static_cast<std::size_t>(i)];
  const Box& box = scene_.boxes[static_cast<std::size_t>(i)];
  const BodyFrame frame(data, body_);
  const Touch touch = find_touch(box, frame.to_base(centre_), radius_);
  Force result;
  if (touch.depth <= 0.0) return result;

  result.at = frame.to_base(contact.point);
  mj_jac(model, data, result.jacobian.data(), nullptr, result.at.data(), body_);
  const Vector3 v = result.jacobian * Eigen::Map<const JointVector>(data->qvel);
  const Vector3 deflection = tangential(contact.bristle + result.at - contact.place, touch.normal);
  const double normal = normal_force(material_, touch.depth, -touch.normal.dot(v));
  result.force = touch.normal * normal +
                 friction_force(material_, normal, deflection, tangential(v, touch.normal));
  return result;
}

void TipContact::add_torque(const mjModel* model, const mjData* data, double* tau) const {
  for (int i = 0; i < scene_.count; ++i) {
    const Force contact = find_force(model, data, i);
    Eigen::Map<JointVector>(tau) += contact.jacobian.transpose() * contact.force;
  }
}

Vector6 TipContact::wrench(const mjModel* model, const mjData* data) const {
  Vector6 result = Vector6::Zero();
  for (int i = 0; i < scene_.count; ++i) {
    const Force contact = find_force(model, data, i);
    result.head<3>() += contact.force;
    result.tail<3>() += (contact.at - BodyFrame(data, body_).p).cross(contact.force);
  }
  return result;
}

double TipContact::energy() const {
  double sum = 0.0;
  for (int i = 0; i < scene_.count; ++i) {
    const Contact& contact = contacts_[static_cast<std::size_t>(i)];
    sum += stored_energy(material_, contact.depth, contact.bristle);
  }
  return sum;
}

}  // namespace tactus
