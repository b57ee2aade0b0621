#pragma once
/// Sine, cosine and arctangent with the same bits on every machine, for gravity and recorded data. Those of
/// glibc differ between processors with and without fused multiply-add.

namespace talus {

inline constexpr double pi = 3.14159265358979323846;

constexpr double radians(double degrees) { return degrees * (pi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / pi); }

/// Returns an angle in degrees without the rounding errors of a sum of steps: a multiple of 1e-9, never -0.
double rounded_degrees(double radians);

/// Returns the sine of an angle in radians, |angle| <= pi/2; error below 2 units in the last place.
double sine(double angle);
/// Returns the cosine of an angle in radians, |angle| <= pi/2; error below 2 units in the last place near 1.
double cosine(double angle);
/// Returns the arctangent in radians, |slope| <= 1e100; error below 6 units in the last place.
double arctangent(double slope);

}  // namespace talus
