#include <gtest/gtest.h>

#include <set>
#include <string>

#include "base/errors.h"
#include "pictures/map_kind.h"
#include "pictures/traces.h"
#include "support/exit_code.h"

namespace talus {
namespace {

TEST(MapKinds, HaveNamesOfTheirOwnThatAreFoundAgain) {
  std::set<std::string_view> names;
  for (const MapKind kind : map_kinds()) {
    names.insert(map_name(kind));
    EXPECT_EQ(map_layers(map_name(kind)), MapLayers{kind});
    EXPECT_FALSE(map_help(kind).empty());
  }
  EXPECT_EQ(names.size(), 24u);
  EXPECT_EQ(map_name(MapKind::forces), "forces");
}

TEST(MapKinds, SayWhatTheyNeed) {
  std::string scaled, measured, averaged;
  for (const MapKind kind : map_kinds()) {
    if (needs_theta_c(kind)) scaled.append(" ").append(map_name(kind));
    if (is_coarse(kind)) averaged.append(" ").append(map_name(kind));
    if (needs_reference(kind)) measured.append(" ").append(map_name(kind));
  }
  EXPECT_EQ(scaled, " gamma overloaded clusters coarse");
  EXPECT_EQ(measured, " displacement rotation nonaffine shear dilation vorticity");
  EXPECT_EQ(averaged, " coarse density stress shear_rate temperature");
}

TEST(MapLayers, AreOneOrTwoDifferentMaps) {
  EXPECT_EQ(map_layers("gamma+forces"), (MapLayers{MapKind::gamma, MapKind::forces}));
  EXPECT_EQ(layers_name({MapKind::pressure, MapKind::critical}), "pressure+critical");
  for (const char* name :
       {"", "Gamma", "gamma+", "+gamma", "gamma+forces+critical", "forces+forces", "gamma,forces"})
    EXPECT_EQ(test::exit_code_of([&] { map_layers(name); }), ExitCode::usage) << name;
}

TEST(MapLayers, UnknownNamesAreAnsweredWithThoseThereAre) {
  try {
    map_layers("gama");
    FAIL();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("'gama'"), std::string::npos) << message;
    for (const MapKind kind : map_kinds())
      EXPECT_NE(message.find(map_name(kind)), std::string::npos) << message;
  }
}

TEST(TraceKinds, HaveNamesThatAreFoundAgain) {
  for (const TraceKind kind : trace_kinds()) {
    EXPECT_EQ(trace_kinds(trace_name(kind)), std::vector<TraceKind>{kind});
    EXPECT_FALSE(trace_quantity(kind).display.title.empty());
  }
  EXPECT_EQ(trace_kinds("stress_ratio,overloaded"),
            (std::vector<TraceKind>{TraceKind::stress_ratio, TraceKind::overloaded}));
  EXPECT_EQ(trace_kinds("overloaded+volume_strain").size(), 2u);
  for (const char* name : {"", "p_o", "overloaded,", "overloaded,overloaded"})
    EXPECT_EQ(test::exit_code_of([&] { trace_kinds(name); }), ExitCode::usage) << name;
}

}  // namespace
}  // namespace talus
