// TipContact: what the ball at the tip of the tool and the boxes of the scene do to the arm.
//
// The force is a function of the joint positions and velocities, evaluated in every stage of the
// Runge-Kutta method, so that spring and bristle are integrated at its order. What is not a
// function of them, how far the bristles had slipped, is kept from one inner step to the next:
// begin() carries it over the step that has ended, by the implicit Euler method.
//
// Within a step a contact is followed at the point of the ball that was nearest to the box at its
// beginning: there the force acts, and with the velocity of that point. So force times velocity is
// the power the arm feels.
#pragma once

#include <array>

#include "sim_plant/scene.hpp"

struct mjModel_;
struct mjData_;

namespace tactus {

/// Linear velocity of a point = J dq; row by row, as MuJoCo writes it.
using PointJacobian = Eigen::Matrix<double, 3, kDof, Eigen::RowMajor>;

class TipContact {
 public:
  /// A ball in the frame of `body`: its centre, m, and radius, m. Nothing touches yet. [init]
  void load(const Scene& scene, const Material& material, int body, const Vector3& centre,
            double radius);
  /// Puts a pointer to this object into the user data of `data`, whose model has room for one
  /// number, for MuJoCo's callback to find it. [init]
  void attach(mjData_* data) const;
  /// The callback: adds the joint torques of what is attached, if anything is, to the passive ones.
  /// The poses in `data` are up to date. [cyclic]
  static void add_attached(const mjModel_* model, mjData_* data);
  /// True if there is nothing to touch. [any]
  bool none() const { return scene_.count == 0; }

  /// The state in `data` is where an inner step begins; the last one took `h_s`, 0 if there was
  /// none. Brings the poses in `data` up to date. [cyclic]
  void begin(const mjModel_* model, mjData_* data, double h_s);

  /// What the scene exerts on the ball, at the origin of the body and in the base frame, N and N m,
  /// at a state within the step; the poses in `data` are up to date. [cyclic]
  Vector6 wrench(const mjModel_* model, const mjData_* data) const;

  /// What the contacts store at the state begin() saw last, J. [any]
  double energy() const;

 private:
  /// Ball and one box.
  struct Contact {
    Vector3 point = Vector3::Zero();    // the ball's nearest point, m, in the body's frame
    Vector3 place = Vector3::Zero();    // where that was at the beginning, m, base frame
    Vector3 bristle = Vector3::Zero();  // m, base frame
    double depth = 0.0;                 // m
  };
  /// What one box exerts at some state.
  struct Force {
    Vector3 at = Vector3::Zero(), force = Vector3::Zero();  // m, N; base frame
    PointJacobian jacobian = PointJacobian::Zero();         // of that point
  };

  Force find_force(const mjModel_* model, const mjData_* data, int i) const;
  void add_torque(const mjModel_* model, const mjData_* data, double* tau) const;
  void slip(const Touch& touch, const Force& force, double h_s, Contact& contact) const;

  Scene scene_;
  Material material_;
  int body_ = 0;
  Vector3 centre_ = Vector3::Zero();
  double radius_ = 0.0;
  std::array<Contact, kMaxBoxes> contacts_;
};

}  // namespace tactus
