/// The quantities of single grains: as talus export has them, as docs/view.md lists them, and as conditions
/// find them.

#include "view/grain_quantities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "core/trigonometry.h"
#include "export/fields.h"
#include "io/run_schema.h"
#include "pictures/overload_rule.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "unit/view/example_bed.h"
#include "unit/view/opened_view.h"

namespace talus {
namespace {

class GrainQuantities : public testing::Test {
 protected:
  GrainQuantities() {
    frame_.image[3] = 1;
    frame_.vx[4] = 3.0;
    frame_.vy[4] = -4.0;
    frame_.contacts.status[0] = ContactStatus::sliding;
    clusters_ = overloaded_clusters({frame_, statics_}, rule_);
  }
  GrainSource source() {
    const double threshold = threshold_of(rule_);
    return {frame_,   frame_,    &first_,
            statics_, clusters_, {threshold, threshold, 0.0, length_cut(statics_, 0.0)}};
  }
  std::vector<Index> where(const std::string& condition) {
    return grains_where(parse_condition(condition, grain_names()), source());
  }

  RunStatics statics_ = example::bed_statics();
  Frame first_ = example::bed_frame(0.0, 0), frame_ = example::bed_frame(10.0, 2);
  OverloadRule rule_{.theta_c = radians(20.0), .l_min = 0.0};
  Clusters clusters_;
};

TEST_F(GrainQuantities, a_condition_finds_free_grains) {
  EXPECT_EQ(where("gamma > 0.7"), (std::vector<Index>{0, 10}));
  EXPECT_EQ(where("gamma > 0.7 && y > 1"), (std::vector<Index>{10}));
  EXPECT_EQ(where("overloaded || speed == 5"), (std::vector<Index>{0, 4, 10}));
  EXPECT_EQ(where("displacement_x == 10"), (std::vector<Index>{3})) << "once around";
  EXPECT_EQ(where("sliding == 1"), (std::vector<Index>{0}));
  EXPECT_EQ(where("y > -100").size(), static_cast<std::size_t>(statics_.free_count)) << "no floor";
  EXPECT_TRUE(where("y > 100").empty());
}

TEST_F(GrainQuantities, all_have_a_value_for_each_grain) {
  for (const GrainQuantity& quantity : grain_quantities())
    EXPECT_EQ(quantity.values(source()).size(), frame_.x.size()) << quantity.name;
}

TEST_F(GrainQuantities, without_a_first_frame_nothing_is_said_of_displacements) {
  const GrainSource of = {frame_, frame_, nullptr, statics_, clusters_, {}};
  EXPECT_TRUE(std::isnan(grain_quantity("displacement_x").values(of)[3]));
  EXPECT_TRUE(std::isnan(grain_quantity("displacement_y").values(of)[3]));
}

TEST(GrainQuantitiesOfARun, are_those_that_export_writes) {
  const test::TemporaryFolder folder;
  example::write_bed_run(folder.path("run.h5"), 20.0);
  const RunFile file = RunFile::open(folder.path("run.h5"));
  AnalysisParameters parameters;
  parameters.l_min = 0.0;
  parameters.threshold_factors = {1.0};
  const ExportedRun run = exported_run(file, parameters);
  const ExportedFrame exported = exported_frame(file, run, 2);
  ViewModel model = example::opened(folder.path("run.h5"));
  model.go_to(2);
  int compared = 0;
  for (const FieldColumn& column : grain_columns(exported)) {
    if (column.field.name == "type" || column.field.name == "image") continue;  // of no use to conditions
    const std::vector<std::string> parts = component_names({column.field, "", {}});
    for (std::size_t part = 0; part < parts.size(); ++part, ++compared) {
      const GrainQuantity& quantity = grain_quantity(parts[part]);
      const double unit = column.field.unit == "m" ? 1.0 : column.field.unit == "rad" ? degrees(1.0) : 1.0;
      EXPECT_EQ(quantity.unit, column.field.unit == "m"     ? "D"
                               : column.field.unit == "rad" ? "deg"
                                                            : column.field.unit);
      const std::vector<double>& values = model.grain_values(quantity);
      const auto free = static_cast<std::size_t>(run.statics.free_count);
      for (std::size_t i = 0; i < free; ++i) {
        const double value = column.values[i * parts.size() + part] * unit;
        EXPECT_TRUE(std::isnan(value) ? std::isnan(values[i])
                                      : std::abs(values[i] - value) <= 1e-6 * std::abs(value))
            << parts[part] << " of grain " << i << ": " << values[i] << ", not " << value;
      }
    }
  }
  EXPECT_GE(compared, 19);
}

/// What the window says in SI units has the unit of the attribute of its data set: per metre of thickness.
TEST(GrainQuantitiesOfARun, have_the_units_of_the_run_file) {
  const std::pair<const char*, const char*> same[] = {
      {"mass", "/particles/grains/mass"},
      {"velocity_x", "/particles/grains/velocity/value"},
      {"velocity_y", "/particles/grains/velocity/value"},
      {"angular_velocity", "/particles/grains/angular_velocity/value"},
      {"internal_moment_xx", "/particles/grains/internal_moment/value"},
      {"internal_moment_yx", "/particles/grains/internal_moment/value"},
      {"pressure", "/observables/sigma_n"}};
  for (const auto& [name, data_set] : same)
    EXPECT_EQ(std::string(grain_quantity(name).unit), field_of(data_set).unit) << name;
  const std::pair<const char*, const char*> per_metre[] = {{"/contacts/force", "N/m"},
                                                           {"/observables/kinetic_energy", "J/m"},
                                                           {"/particles/grains/internal_moment/value", "J/m"},
                                                           {"/particles/grains/mass", "kg/m"},
                                                           {"/checkpoint/contact_force", "N/m"},
                                                           {"/branch/contact_force", "N/m"},
                                                           {"/branch/mass", "kg/m"}};
  for (const auto& [data_set, unit] : per_metre) EXPECT_EQ(field_of(data_set).unit, unit) << data_set;
}

TEST(GrainQuantitiesOfARun, are_listed_in_the_document) {
  std::ifstream file(test::source_folder() + "/docs/view.md");
  std::stringstream page;
  page << file.rdbuf();
  for (const GrainQuantity& quantity : grain_quantities()) {
    const std::string row = std::string("| `")
                                .append(quantity.name)
                                .append("` | ")
                                .append(quantity.unit)
                                .append(" | ")
                                .append(quantity.definition)
                                .append(" |\n");
    EXPECT_NE(page.str().find(row), std::string::npos) << row;
  }
}

}  // namespace
}  // namespace talus
