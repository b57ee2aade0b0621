#include <gtest/gtest.h>

#include <set>
#include <string>

#include "base/errors.h"
#include "pictures/map_kind.h"
#include "pictures/traces.h"
#include "support/exit_code.h"

namespace talus::render {
namespace {

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
  try {
    pictures::map_layers("gama");
    FAIL();
  } catch (const Error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("'gama'"), std::string::npos) << message;
    for (const pictures::MapKind kind : pictures::map_kinds())
      EXPECT_NE(message.find(pictures::map_name(kind)), std::string::npos) << message;
  }
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
