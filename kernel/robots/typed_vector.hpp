// Three-vectors in which a zero is a type. A robot's table is full of zeros, but the rules of
// floating point forbid a compiler to drop 0*x or 0+x. With a zero type the source is the plain
// vector formula, and only the remaining arithmetic is compiled.
#pragma once

namespace tactus {

/// The number zero, known at compile time.
struct Zero {
  constexpr operator double() const { return 0.0; }
  friend constexpr Zero operator-(Zero) { return {}; }
  friend constexpr Zero operator+(Zero, Zero) { return {}; }
  friend constexpr Zero operator-(Zero, Zero) { return {}; }
  friend constexpr Zero operator*(Zero, Zero) { return {}; }
  friend constexpr Zero operator*(Zero, double) { return {}; }
  friend constexpr Zero operator*(double, Zero) { return {}; }
  friend constexpr double operator+(Zero, double b) { return b; }
  friend constexpr double operator+(double a, Zero) { return a; }
  friend constexpr double operator-(Zero, double b) { return -b; }
  friend constexpr double operator-(double a, Zero) { return a; }
};

/// Returns the constant of a captureless lambda, as Zero if it is zero. [any]
template <class Constant>
constexpr auto typed(Constant constant) {
  if constexpr (constant() == 0.0) {
    return Zero{};
  } else {
    return constant();
  }
}

/// A vector whose components are each a double or Zero. It is copied component by component: a
/// block copy goes through memory and doubles the time of the inverse dynamics.
template <class X, class Y, class Z>
struct TypedVector {
  X x;
  Y y;
  Z z;
  constexpr TypedVector(X v_x, Y v_y, Z v_z) : x(v_x), y(v_y), z(v_z) {}
  constexpr TypedVector(const TypedVector& v) : x(v.x), y(v.y), z(v.z) {}
};

template <class A, class B, class C>
constexpr auto operator-(const TypedVector<A, B, C>& v) {
  return TypedVector{-v.x, -v.y, -v.z};
}

template <class A, class B, class C, class D, class E, class F>
constexpr auto operator+(const TypedVector<A, B, C>& u, const TypedVector<D, E, F>& v) {
  return TypedVector{u.x + v.x, u.y + v.y, u.z + v.z};
}

template <class A, class B, class C, class D, class E, class F>
constexpr auto operator-(const TypedVector<A, B, C>& u, const TypedVector<D, E, F>& v) {
  return TypedVector{u.x - v.x, u.y - v.y, u.z - v.z};
}

template <class S, class A, class B, class C>
constexpr auto operator*(S scale, const TypedVector<A, B, C>& v) {
  return TypedVector{scale * v.x, scale * v.y, scale * v.z};
}

template <class A, class B, class C, class D, class E, class F>
constexpr auto cross(const TypedVector<A, B, C>& u, const TypedVector<D, E, F>& v) {
  return TypedVector{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

}  // namespace tactus
