#pragma once
/// Our own sine, cosine and arctangent, so that gravity and what a run records have the same bits on every
/// machine: those of glibc differ between processors with and without fused multiply-add.

namespace talus {

inline constexpr double pi = 3.14159265358979323846;

constexpr double radians(double degrees) { return degrees * (pi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / pi); }

/// Sine of an angle in radians, |angle| <= pi/2; error below 2 units in the last place.
double sine(double angle);
/// Cosine of an angle in radians, |angle| <= pi/2; error below 2 units in the last place near 1.
double cosine(double angle);
/// Arctangent in radians, |slope| <= 1e100; error below 6 units in the last place.
double arctangent(double slope);

}  // namespace talus
