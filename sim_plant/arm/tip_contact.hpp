// TipContact: the forces on the arm from contacts between the ball at the tool's tip and the boxes
// of the scene.
//
// The force is a function of the joint positions and velocities, evaluated in every stage of the
// Runge-Kutta method, so that spring and bristle are integrated at its order. The slip of the
// bristles is not such a function and is kept from one inner step to the next: begin() updates it
// for the step that has ended, by the implicit Euler method.
//
// Within a step a contact acts at the point of the ball that was nearest to the box at the
// beginning of the step, with the velocity of that point, so that force times velocity is the power
// on the arm.
#pragma once

#include <array>

#include "sim_plant/arm/scene.hpp"

struct mjModel_;
struct mjData_;

namespace tactus {

/// Linear velocity of a point = J dq; row-major, as MuJoCo writes it.
using PointJacobian = Eigen::Matrix<double, 3, kDof, Eigen::RowMajor>;

class TipContact {
 public:
  /// Takes a ball in the frame of `body`: centre, m, and radius, m. No contact exists yet. [init]
  void load(const Scene& scene, const Material& material, int body, const Vector3& centre,
            double radius);
  /// Stores a pointer to this object in the user data of `data`, where MuJoCo's callback finds it;
  /// nuserdata of the model must be at least 1. [init]
  void attach(mjData_* data) const;
  /// The callback: adds the joint torques of the attached object, if any, to the passive ones. The
  /// poses in `data` must be up to date. [cyclic]
  static void add_attached(const mjModel_* model, mjData_* data);
  /// True if the scene has no boxes. [any]
  bool none() const { return scene_.count == 0; }

  /// Begins an inner step at the state in `data`; the last step took `h_s`, 0 if there was none.
  /// Brings the poses in `data` up to date. [cyclic]
  void begin(const mjModel_* model, mjData_* data, double h_s);

  /// Returns the wrench of the scene on the ball, about the origin of the body and in the base
  /// frame, N and N m, at a state within the step; the poses in `data` must be up to date. [cyclic]
  Vector6 wrench(const mjModel_* model, const mjData_* data) const;

  /// Adds the joint torques of the scene to `tau`, N m, at such a state. [cyclic]
  void add_torque(const mjModel_* model, const mjData_* data, double* tau) const;

  /// Returns the energy stored in the contacts at the last call of begin(), J. [any]
  double energy() const;

 private:
  /// The contact of the ball with one box.
  struct Contact {
    Vector3 point = Vector3::Zero();    // the ball's nearest point, m, in the body's frame
    Vector3 place = Vector3::Zero();    // its place at the beginning of the step, m, base frame
    Vector3 bristle = Vector3::Zero();  // m, base frame
    double depth = 0.0;                 // m
  };
  /// The force of one box at some state.
  struct Force {
    Vector3 at = Vector3::Zero(), force = Vector3::Zero();  // m, N; base frame
    PointJacobian jacobian = PointJacobian::Zero();         // of the point `at`
  };

  Force find_force(const mjModel_* model, const mjData_* data, int i) const;
  void slip(const Touch& touch, const Force& force, double h_s, Contact& contact) const;

  Scene scene_;
  Material material_;
  int body_ = 0;
  Vector3 centre_ = Vector3::Zero();
  double radius_ = 0.0;
  std::array<Contact, kMaxBoxes> contacts_;
};

}  // namespace tactus
