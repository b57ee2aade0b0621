/// Traces, and the names of maps and traces.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "base/errors.h"
#include "pictures/map_kind.h"
#include "pictures/traces.h"
#include "render/map_bed.h"
#include "support/exit_code.h"

namespace talus::render {
namespace {

using test::settings_of;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<std::string> labels_of(const std::vector<AxisTick>& ticks) {
  std::vector<std::string> labels;
  for (const AxisTick& tick : ticks) labels.push_back(tick.label);
  return labels;
}

Trace trace_of(const std::vector<double>& tilts, const std::vector<double>& values, double theta_c = nan,
               pictures::TraceKind kind = pictures::TraceKind::overloaded) {
  pictures::MapSettings settings;
  settings.theta_c = theta_c;
  return pictures::make_trace(kind, tilts, values, settings, tilts.empty() ? 0.0 : tilts.back());
}

TEST(Trace, IsTheCurveInDegreesWithRoundTicks) {
  const Trace trace = trace_of({0.0, radians(5.0), radians(12.0)}, {0.31, 0.42, 0.58}, radians(11.0));
  EXPECT_EQ(trace.x.size(), 3u);
  EXPECT_NEAR(trace.x[2], 12.0, 1e-12);
  EXPECT_EQ(trace.y, (std::vector<double>{0.31, 0.42, 0.58}));
  EXPECT_NEAR(trace.y_min, 0.3, 1e-12);
  EXPECT_NEAR(trace.y_max, 0.6, 1e-12);
  EXPECT_EQ(labels_of(trace.y_ticks), (std::vector<std::string>{"0.3", "0.4", "0.5", "0.6"}));
  EXPECT_EQ(trace.x_min, 0.0);
  EXPECT_NEAR(trace.x_max, 12.0, 1e-12);
  EXPECT_EQ(labels_of(trace.x_ticks), (std::vector<std::string>{"0", "2", "4", "6", "8", "10", "12"}));
  EXPECT_NEAR(trace.mark, 12.0, 1e-12);
  EXPECT_NEAR(trace.event, 11.0, 1e-12);
  EXPECT_EQ(trace.event_label, "θ_c");
  EXPECT_EQ(trace.title, "p_o, share of overloaded grains, l = 3 D");
  EXPECT_EQ(trace.x_title, "θ (°)");
}

TEST(Trace, ShowsFailureOnlyWhereItIsKnownAndInTheRange) {
  EXPECT_TRUE(std::isnan(trace_of({0.0, 0.2}, {0.3, 0.4}).event));
  EXPECT_TRUE(std::isnan(trace_of({0.0, 0.2}, {0.3, 0.4}, 0.3).event));
  EXPECT_FALSE(std::isnan(trace_of({0.0, 0.2}, {0.3, 0.4}, 0.1).event));
}

TEST(Trace, OfOverloadedGrainsSaysWhoseGammaItGoesBy) {
  const pictures::MapSettings settings = settings_of("gamma");  // single grains
  EXPECT_EQ(pictures::make_trace(pictures::TraceKind::overloaded, {}, {}, settings, 0.0).title,
            "p_o, share of overloaded grains, single grains");
  EXPECT_EQ(pictures::make_trace(pictures::TraceKind::volume_strain, {}, {}, settings, 0.0).title,
            "Volume strain ΔV/V (%)");
}

TEST(Trace, VolumeStrainIsInPercent) {
  const Trace trace = trace_of({0.0, 0.1}, {-0.004, 0.001}, nan, pictures::TraceKind::volume_strain);
  EXPECT_DOUBLE_EQ(trace.y[0], -0.4);
  EXPECT_EQ(trace.title, "Volume strain ΔV/V (%)");
  EXPECT_EQ(labels_of(trace.y_ticks), (std::vector<std::string>{"−0.4", "−0.2", "0.0", "0.2"}));
}

/// Expects ranges that can be drawn, with ticks inside them.
void expect_drawable(const Trace& trace) {
  EXPECT_LT(trace.x_min, trace.x_max);
  EXPECT_LT(trace.y_min, trace.y_max);
  EXPECT_GE(trace.x_ticks.size(), 2u);
  EXPECT_GE(trace.y_ticks.size(), 2u);
  for (const AxisTick& tick : trace.y_ticks) {
    EXPECT_GE(tick.value, trace.y_min - 1e-9);
    EXPECT_LE(tick.value, trace.y_max + 1e-9);
  }
  for (const double y : trace.y)
    if (!std::isnan(y)) {
      EXPECT_GE(y, trace.y_min);
      EXPECT_LE(y, trace.y_max);
    }
}

TEST(Trace, OfFewOrEqualOrMissingValuesCanBeDrawn) {
  expect_drawable(trace_of({}, {}));
  expect_drawable(trace_of({0.1}, {0.3}));
  expect_drawable(trace_of({0.0, 0.1, 0.2}, {0.3, 0.3, 0.3}));
  expect_drawable(trace_of({0.0, 0.1, 0.2}, {nan, nan, nan}));
  const Trace gap = trace_of({0.0, 0.1, 0.2}, {0.1, nan, 0.3});
  expect_drawable(gap);
  EXPECT_TRUE(std::isnan(gap.y[1]));
  expect_drawable(trace_of({0.0, 0.1}, {0.0, 0.0}, nan, pictures::TraceKind::volume_strain));
  expect_drawable(trace_of({0.0, 0.1}, {0.123456, 0.1234561}));
}

TEST(TraceValue, OfAFrameGoesByTheThreshold) {
  test::Packing packing = test::row_of_grains({0.9, 0.9, 0.6, nan, 0.1});
  test::add_contact(packing, 0, 1, 1.0);
  pictures::MapSettings settings = settings_of("overloaded");
  const auto value = [&](pictures::TraceKind kind) {
    return pictures::frame_value(kind, {packing.frame, packing.statics}, settings);
  };
  EXPECT_DOUBLE_EQ(value(pictures::TraceKind::overloaded), 0.75);
  EXPECT_DOUBLE_EQ(value(pictures::TraceKind::largest_cluster), 2.0 / 3.0);
  settings.threshold_factor = 1.5;
  EXPECT_DOUBLE_EQ(value(pictures::TraceKind::overloaded), 0.5);
  EXPECT_DOUBLE_EQ(value(pictures::TraceKind::largest_cluster), 1.0);
  settings.threshold_factor = 2.0;
  EXPECT_TRUE(std::isnan(value(pictures::TraceKind::largest_cluster)));
  EXPECT_THROW(value(pictures::TraceKind::stress_ratio), Error);
}

TEST(TraceValue, ComesFromFramesOrFromAColumn) {
  EXPECT_EQ(pictures::trace_column(pictures::TraceKind::stress_ratio), Observable::stress_ratio);
  EXPECT_EQ(pictures::trace_column(pictures::TraceKind::volume_strain), Observable::volume_strain);
  for (const pictures::TraceKind kind : pictures::trace_kinds())
    if (pictures::trace_from_frames(kind)) {
      EXPECT_THROW(pictures::trace_column(kind), Error);
      EXPECT_TRUE(pictures::needs_theta_c(kind));
    }
}

TEST(MapKinds, HaveNamesOfTheirOwnThatAreFoundAgain) {
  std::set<std::string_view> names;
  for (const pictures::MapKind kind : pictures::map_kinds()) {
    names.insert(pictures::map_name(kind));
    EXPECT_EQ(pictures::map_layers(pictures::map_name(kind)), pictures::MapLayers{kind});
    EXPECT_FALSE(pictures::map_help(kind).empty());
  }
  EXPECT_EQ(names.size(), 24u);
  EXPECT_EQ(pictures::map_name(pictures::MapKind::forces), "forces");
}

TEST(MapKinds, SayWhatTheyNeed) {
  std::string scaled, measured, averaged;
  for (const pictures::MapKind kind : pictures::map_kinds()) {
    if (pictures::needs_theta_c(kind)) scaled.append(" ").append(pictures::map_name(kind));
    if (pictures::is_coarse(kind)) averaged.append(" ").append(pictures::map_name(kind));
    if (pictures::needs_reference(kind)) measured.append(" ").append(pictures::map_name(kind));
  }
  EXPECT_EQ(scaled, " gamma overloaded clusters coarse");
  EXPECT_EQ(measured, " displacement rotation nonaffine shear dilation vorticity");
  EXPECT_EQ(averaged, " coarse density stress shear_rate temperature");
}

TEST(MapLayers, AreOneOrTwoDifferentMaps) {
  EXPECT_EQ(pictures::map_layers("gamma+forces"),
            (pictures::MapLayers{pictures::MapKind::gamma, pictures::MapKind::forces}));
  EXPECT_EQ(pictures::layers_name({pictures::MapKind::pressure, pictures::MapKind::critical}),
            "pressure+critical");
  for (const char* name :
       {"", "Gamma", "gamma+", "+gamma", "gamma+forces+critical", "forces+forces", "gamma,forces"})
    EXPECT_EQ(test::exit_code_of([&] { pictures::map_layers(name); }), ExitCode::usage) << name;
}

TEST(MapLayers, UnknownNamesAreAnsweredWithThoseThereAre) {
  const std::string message = test::refusal_of([] { pictures::map_layers("gama"); }).message;
  EXPECT_TRUE(test::has(message, "'gama'"));
  for (const pictures::MapKind kind : pictures::map_kinds())
    EXPECT_TRUE(test::has(message, std::string(pictures::map_name(kind))));
}

TEST(TraceKinds, HaveNamesThatAreFoundAgain) {
  for (const pictures::TraceKind kind : pictures::trace_kinds()) {
    EXPECT_EQ(pictures::trace_kinds(pictures::trace_name(kind)), std::vector<pictures::TraceKind>{kind});
    EXPECT_FALSE(pictures::trace_quantity(kind).display.title.empty());
  }
  EXPECT_EQ(
      pictures::trace_kinds("stress_ratio,overloaded"),
      (std::vector<pictures::TraceKind>{pictures::TraceKind::stress_ratio, pictures::TraceKind::overloaded}));
  EXPECT_EQ(pictures::trace_kinds("overloaded+volume_strain").size(), 2u);
  for (const char* name : {"", "p_o", "overloaded,", "overloaded,overloaded"})
    EXPECT_EQ(test::exit_code_of([&] { pictures::trace_kinds(name); }), ExitCode::usage) << name;
}

}  // namespace
}  // namespace talus::render
