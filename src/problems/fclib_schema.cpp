#include "problems/fclib_schema.h"

#include "base/errors.h"

namespace talus::problems {
namespace {

using enum io::ElementType;

std::vector<io::DataSetField> make_schema() {
  return {
      {"/fclib_local/spacedim", int32, "1", "1", "dimension of space, 2"},
      {"/fclib_local/W/nzmax", int32, "1", "1", "number of entries of W"},
      {"/fclib_local/W/m", int32, "1", "1", "rows of W, two for each contact: normal, tangent"},
      {"/fclib_local/W/n", int32, "1", "1", "columns of W, as many as rows"},
      {"/fclib_local/W/nz", int32, "1", "1",
       "form of W: -2 compressed rows, as Talus writes it; -1 compressed columns; 0 or more: the number of "
       "triplets"},
      {"/fclib_local/W/p", int32, "U+1", "1",
       "entries of row k are p[k] ... p[k+1] - 1; the same of columns in compressed columns; column of each "
       "entry in triplets"},
      {"/fclib_local/W/i", int32, "E", "1", "column of each entry; its row in the two other forms"},
      {"/fclib_local/W/x", float64, "E", "1/kg", "value of each entry"},
      {"/fclib_local/vectors/q", float64, "U", "m/s",
       "relative velocity (n, t) of each contact without impulses, gap / h and restitution included: u = W r "
       "+ q"},
      {"/fclib_local/vectors/mu", float64, "C", "1", "coefficient of friction of each contact"},
      {"/fclib_local/info/title", text, "", "1", "origin of the problem"},
      {"/fclib_local/info/description", text, "", "1", "conventions, in words"},
      {"/fclib_local/info/math_info", text, "", "1", "properties of W"},
      {"/guesses/number_of_guesses", int32, "1", "1", "number of first guesses: 1"},
      {"/guesses/1/r", float64, "U", "N s", "impulses of the step before, (n, t) of each contact"},
      {"/guesses/1/u", float64, "U", "m/s", "their relative velocities, W r + q"},
      {"/solution/r", float64, "U", "N s", "solution: impulses on the second body, (n, t) of each contact"},
      {"/solution/u", float64, "U", "m/s", "solution: relative velocities, W r + q"},
      {"/talus/bodies/vx", float64, "B", "m/s", "free velocity along the bed, gravity included"},
      {"/talus/bodies/vy", float64, "B", "m/s", "free velocity away from the floor"},
      {"/talus/bodies/omega", float64, "B", "rad/s", "rotation velocity, counter-clockwise positive"},
      {"/talus/bodies/inverse_mass", float64, "B", "1/kg",
       "inverse of the mass; 0 for a body that does not move"},
      {"/talus/bodies/inverse_inertia", float64, "B", "1/(kg m^2)",
       "inverse of the inertia; 0 for a body that does not rotate"},
      {"/talus/bodies/lever", float64, "B", "m", "distance from the centre to every contact; 0 for a plane"},
      {"/talus/bodies/column", int32, "B", "1",
       "column of a large bed that the body is in, from one end to the other"},
      {"/talus/contacts/a", int32, "C", "1", "first body; ascending"},
      {"/talus/contacts/b", int32, "C", "1", "second body, on which the impulses act"},
      {"/talus/contacts/nx", float64, "C", "1", "unit normal along the bed, from a to b"},
      {"/talus/contacts/ny", float64, "C", "1", "unit normal away from the floor"},
      {"/talus/contacts/cn", float64, "C", "m/s",
       "normal part of q that is not free velocity: gap, restitution"},
      {"/talus/contacts/ct", float64, "C", "m/s", "tangential part: restitution"},
      {"/talus/scales/time_step", float64, "1", "s", "length of the step, h"},
      {"/talus/scales/gravity", float64, "1", "m/s^2", "magnitude of gravity, g"},
      {"/talus/scales/tilt", float64, "1", "rad", "angle of the bed to the horizontal in this step"},
      {"/talus/scales/mean_diameter", float64, "1", "m", "mean diameter of the free grains, D"},
      {"/talus/scales/weight", float64, "1", "N", "weight of the free grains, per metre of thickness"},
      {"/talus/run/velocity", float64, "1", "g h",
       "rms velocity of the free grains before the step, rim velocity included"},
      {"/talus/run/tolerance", float64, "1", "1", "residual eta that the run asks of this step"},
      {"/talus/run/tolerance_at_rest", float64, "1", "1", "residual eta that the run asks of a bed at rest"},
  };
}

}  // namespace

const std::vector<io::DataSetField>& fclib_schema() {
  static const std::vector<io::DataSetField> schema = make_schema();
  return schema;
}

const io::DataSetField& fclib_field(const std::string& path) {
  for (const io::DataSetField& field : fclib_schema())
    if (field.path == path) return field;
  throw Error(ExitCode::internal, "the schema of problem files has no data set " + path);
}

}  // namespace talus::problems
