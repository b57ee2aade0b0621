#include "exports/fields.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "io/run_schema.h"
#include "unit/exports/example_frame.h"

namespace talus::test {
namespace {

using Values = std::vector<double>;

class Fields : public testing::Test {
 protected:
  Values grain(const std::string& name) { return values(exports::grain_columns(frame_), name); }
  Values contact(const std::string& name) { return values(exports::contact_columns(frame_), name); }
  static Values values(const std::vector<exports::FieldColumn>& columns, const std::string& name) {
    for (const exports::FieldColumn& column : columns)
      if (column.name() == name) return column.values;
    ADD_FAILURE() << "no field " << name;
    return {};
  }

  ExampleFrame example_ = example_frame();
  analysis::GrainSource frame_ = example_.source();
};

TEST_F(Fields, of_grains_are_those_of_the_frame_and_its_run) {
  EXPECT_EQ(grain("id"), (Values{0, 1, 2}));
  EXPECT_EQ(grain("type"), (Values{1, 1, 2}));
  EXPECT_EQ(grain("radius"), example_.statics.radius);
  EXPECT_EQ(grain("image"), (Values{-1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(grain("velocity"), (Values{0.5, -1.0, -0.25, 0.0, 0.0, 0.0}));
  EXPECT_EQ(grain("internal_moment"), (Values{3.0, 0.5, 0.25, 1.0, 1.0, 0, 0, 1.0, 0, 0, 0, 0}));
  EXPECT_DOUBLE_EQ(grain("speed")[0], std::hypot(0.5, 1.0));
  EXPECT_EQ(grain("coordination"), (Values{1, 3, 1}));
  EXPECT_EQ(grain("sliding"), (Values{0, 1, 1}));
  EXPECT_EQ(grain("gamma_neighbourhood")[0], 0.5);
  EXPECT_DOUBLE_EQ(grain("pressure")[0], 4.0 / (std::numbers::pi * 0.05 * 0.05));
}

TEST_F(Fields, of_displacements_follow_a_grain_through_the_edge) {
  const Values moved = grain("displacement");
  EXPECT_DOUBLE_EQ(moved[0], 0.9375 - 1.0 - 0.1);
  EXPECT_DOUBLE_EQ(moved[1], 0.1875 - 0.2);
  EXPECT_DOUBLE_EQ(moved[2], 0.03125 - 0.9);
}

TEST_F(Fields, of_thresholds_are_there_for_each_of_them) {
  EXPECT_EQ(grain("overloaded_1"), (Values{1, 0, 0}));
  EXPECT_EQ(grain("overloaded_1_5"), (Values{0, 0, 0}));
  EXPECT_EQ(grain("cluster_1"), (Values{0, -1, -1}));
  EXPECT_EQ(grain("lc_1")[0], 0.5);
  frame_.thresholds = {};
  for (const exports::FieldColumn& column : exports::grain_columns(frame_))
    EXPECT_NE(column.field.need, analysis::FrameNeed::threshold);
}

TEST_F(Fields, of_contacts_are_those_of_the_frame) {
  EXPECT_EQ(contact("b"), (Values{1, 2, 3}));
  EXPECT_EQ(contact("point"), (Values{1.0, 0.125, 0.25, 0.0, 0.03125, 0.0}));
  EXPECT_EQ(contact("mobilisation"), (Values{0.5, 1.0, 0.0}));
  EXPECT_EQ(contact("status"), (Values{1, 2, 1}));
  EXPECT_EQ(contact("strong"), (Values{1, 0, 0}));
}

TEST_F(Fields, have_as_many_values_as_components_and_names_of_their_own) {
  for (const auto& [columns, rows] :
       {std::pair(exports::grain_columns(frame_), 3U), std::pair(exports::contact_columns(frame_), 3U)}) {
    std::set<std::string> names;
    for (const exports::FieldColumn& column : columns) {
      EXPECT_EQ(column.values.size(), rows * analysis::components(column.field)) << column.name();
      EXPECT_EQ(exports::component_names(column).size(), analysis::components(column.field)) << column.name();
      for (const std::string& name : exports::component_names(column))
        EXPECT_TRUE(names.insert(name).second) << name;
    }
  }
}

/// SI values have the unit in the attribute of their data set: per metre of thickness.
TEST_F(Fields, have_the_units_of_the_run_file) {
  const std::pair<const char*, const char*> same[] = {
      {"mass", "/particles/grains/mass"},
      {"velocity", "/particles/grains/velocity/value"},
      {"angular_velocity", "/particles/grains/angular_velocity/value"},
      {"internal_moment", "/particles/grains/internal_moment/value"},
      {"pressure", "/observables/sigma_n"}};
  for (const auto& [name, data_set] : same)
    EXPECT_EQ(std::ranges::find(analysis::grain_quantities(), name, &analysis::FrameQuantity::name)->unit,
              io::field_of(data_set).unit)
        << name;
  const std::pair<const char*, const char*> per_metre[] = {{"/contacts/force", "N/m"},
                                                           {"/observables/kinetic_energy", "J/m"},
                                                           {"/particles/grains/internal_moment/value", "J/m"},
                                                           {"/particles/grains/mass", "kg/m"},
                                                           {"/checkpoint/contact_force", "N/m"},
                                                           {"/branch/contact_force", "N/m"},
                                                           {"/branch/mass", "kg/m"}};
  for (const auto& [data_set, unit] : per_metre) EXPECT_EQ(io::field_of(data_set).unit, unit) << data_set;
}

}  // namespace
}  // namespace talus::test
