#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "pictures/cluster_colours.h"
#include "render/map_bed.h"

namespace talus::render {
namespace {

using test::map_of;
using test::Packing;
using test::settings_of;

/// Returns grains in a row, one letter each; equal letters form a cluster, and dots are in none.
analysis::Clusters clusters_of(const std::string& letters) {
  std::vector<std::pair<Index, char>> sizes;
  for (const char letter : std::set<char>(letters.begin(), letters.end()))
    if (letter != '.') sizes.emplace_back(-static_cast<Index>(std::ranges::count(letters, letter)), letter);
  std::ranges::sort(sizes);
  analysis::Clusters clusters;
  std::map<char, Index> label = {{'.', -1}};
  for (const auto& [size, letter] : sizes) {
    label[letter] = clusters.count();
    clusters.size.push_back(-size);
    clusters.members += -size;
  }
  for (const char letter : letters) clusters.label.push_back(label[letter]);
  return clusters;
}

std::string times(int count, char letter) { return std::string(static_cast<std::size_t>(count), letter); }

TEST(ClusterColours, KeepTheirsWhileClustersGrowAndShrink) {
  pictures::ClusterColours colours;
  const auto first = colours.next(clusters_of(times(20, 'a') + times(15, 'b') + times(15, '.')));
  ASSERT_EQ(first.size(), 2u);
  EXPECT_NE(first[0].palette_index, first[1].palette_index);
  // Now b is the larger one.
  const auto second = colours.next(clusters_of(times(12, 'a') + times(8, '.') + times(30, 'b')));
  EXPECT_EQ(second[0].track, first[1].track);
  EXPECT_EQ(second[0].palette_index, first[1].palette_index);
  EXPECT_EQ(second[1].track, first[0].track);
  EXPECT_EQ(second[1].palette_index, first[0].palette_index);
}

TEST(ClusterColours, AMergerTakesTheColourOfTheLarger) {
  pictures::ClusterColours colours;
  const auto parts = colours.next(clusters_of(times(15, 'a') + "." + times(20, 'b')));
  const auto whole = colours.next(clusters_of(times(36, 'c')));
  EXPECT_EQ(whole[0].track, parts[0].track);
  EXPECT_EQ(whole[0].palette_index, parts[0].palette_index);
}

TEST(ClusterColours, TheLargestPieceOfASplitKeepsTheColour) {
  pictures::ClusterColours colours;
  const auto whole = colours.next(clusters_of(times(40, 'a')));
  // The second piece is now the larger cluster, but contains less of the old one.
  const auto pieces = colours.next(clusters_of(times(22, 'a') + "." + times(17, 'b') + times(20, 'b')));
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[1].track, whole[0].track);
  EXPECT_NE(pieces[0].track, whole[0].track);
  EXPECT_NE(pieces[0].palette_index, whole[0].palette_index);
}

TEST(ClusterColours, SmallClustersHaveNoneUntilTheyGrow) {
  pictures::ClusterColours colours;
  const auto small = colours.next(clusters_of(times(9, 'a')));
  EXPECT_EQ(small[0].palette_index, -1);
  EXPECT_EQ(small[0].track, 0);
  const auto grown = colours.next(clusters_of(times(10, 'a')));
  EXPECT_EQ(grown[0].track, 0);
  EXPECT_GE(grown[0].palette_index, 0);
  const auto shrunk = colours.next(clusters_of(times(3, 'a')));
  EXPECT_EQ(shrunk[0].palette_index, -1) << "gray, as in the legend";
  const auto again = colours.next(clusters_of(times(12, 'a')));
  EXPECT_EQ(again[0].palette_index, grown[0].palette_index) << "a colour, once given, is kept";
}

TEST(ClusterColours, ANewClusterTakesTheColourThatTheFewestGrainsWear) {
  pictures::ClusterColours colours;
  std::string letters;
  const auto palette = static_cast<int>(pictures::cluster_palette().size()) - 1;  // without the spanning one
  for (int k = 0; k < palette; ++k) letters += times(10 + k, static_cast<char>('a' + k));
  const auto first = colours.next(clusters_of(letters));
  std::set<int> used;
  for (const pictures::ClusterColour& colour : first) used.insert(colour.palette_index);
  EXPECT_EQ(used.size(), static_cast<std::size_t>(palette)) << "all colours are used before any repeats";
  const int least = first.back().palette_index;  // colour of the smallest cluster
  const auto second = colours.next(clusters_of(letters + times(10, 'z')));
  EXPECT_EQ(second.back().palette_index, least);
}

TEST(ClusterColours, AVanishedClusterDoesNotComeBack) {
  pictures::ClusterColours colours;
  const auto before = colours.next(clusters_of(times(12, 'a')));
  EXPECT_TRUE(colours.next(clusters_of(times(12, '.'))).empty());
  EXPECT_NE(colours.next(clusters_of(times(12, 'a')))[0].track, before[0].track);
}

TEST(ClusterPalette, IsDarkerThanWhiteAndOfDifferentColours) {
  const std::vector<Colour> palette = pictures::cluster_palette();
  EXPECT_GE(palette.size(), 12u);
  for (std::size_t k = 0; k < palette.size(); ++k) {
    EXPECT_LT(luma(palette[k]), 205.0);
    for (std::size_t other = 0; other < k; ++other)
      EXPECT_GT(std::abs(palette[k].red - palette[other].red) +
                    std::abs(palette[k].green - palette[other].green) +
                    std::abs(palette[k].blue - palette[other].blue),
                60);
  }
}

/// Returns L* of CIELAB, 0 ... 100, of an sRGB colour.
double lightness(const Colour& colour) {
  const auto linear = [](double channel) {
    const double c = channel / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 116.0 * std::cbrt(0.2126 * linear(colour.red) + 0.7152 * linear(colour.green) +
                           0.0722 * linear(colour.blue)) -
         16.0;
}

TEST(ClusterPalette, OfContrastIsToldApartInGrayPrint) {
  std::vector<Colour> all = pictures::cluster_palette(pictures::ClusterPalette::contrast);
  all.push_back(gray(0.4));  // colour of small clusters
  all.push_back(white);
  std::ranges::sort(all, {}, lightness);
  for (std::size_t k = 1; k < all.size(); ++k)
    EXPECT_GT(lightness(all[k]), lightness(all[k - 1]) + 10.0) << k;
}

/// Returns a column of three overloaded grains from floor to surface with a force between them, twelve more
/// in a row at the bottom, joined by forces, three grains next to it that are not overloaded, and some above
/// the row, so that it does not reach the surface.
Packing bed_with_clusters() {
  Packing packing = test::empty_packing(20.0, false);
  for (int k = 0; k < 12; ++k) test::add_grain(packing, 4.5 + k, 0.5);
  for (int k = 0; k < 3; ++k) test::add_grain(packing, 2.5, 0.5 + k);
  for (int k = 0; k < 3; ++k) test::add_grain(packing, 18.5, 0.5 + k);
  for (Index i = 0; i < 11; ++i) test::add_contact(packing, i, i + 1, 1.0);
  for (Index i : {12, 13}) test::add_contact(packing, i, i + 1, 1.0);
  test::add_grain(packing, 10.0, 3.0);
  for (int k = 0; k < 14; ++k) test::add_grain(packing, 4.0 + k, 3.0);
  packing.frame.gamma.assign(15, 0.9);
  packing.frame.gamma.resize(packing.frame.x.size(), 0.1);
  test::complete(packing);
  return packing;
}

TEST(ClustersMap, ColoursClustersAndMarksThoseThatSpan) {
  const FrameView view = map_of(bed_with_clusters(), "clusters");
  const std::vector<Colour> palette = pictures::cluster_palette();
  EXPECT_EQ(view.discs[0].fill, palette[1]);
  EXPECT_NE(view.discs[0].rim, black);
  EXPECT_EQ(view.discs[12].fill, palette[0]) << "three grains have no colour of their own, but they span";
  EXPECT_EQ(view.discs[12].rim, black);
  EXPECT_EQ(view.discs[15].fill, white);
  EXPECT_EQ(view.title, "Clusters of overloaded grains, single grains, 2 clusters, largest 80 %");
  EXPECT_EQ(view.legends[0].swatches[0].label, "spans the bed");
  EXPECT_EQ(view.legends[0].swatches[0].fill, palette[0]);
}

TEST(ClustersMap, HasTheSameLegendWhichever) {
  Packing packing = bed_with_clusters();
  const std::vector<Swatch> with = map_of(packing, "clusters").legends[0].swatches;
  packing.frame.gamma.assign(packing.frame.gamma.size(), 0.1);
  const FrameView view = map_of(packing, "clusters");
  EXPECT_EQ(view.title, "Clusters of overloaded grains, single grains, no cluster");
  ASSERT_EQ(view.legends[0].swatches.size(), with.size()) << "entries keep their places in a movie";
  for (std::size_t k = 0; k < with.size(); ++k) EXPECT_EQ(view.legends[0].swatches[k].label, with[k].label);
}

TEST(ClustersMap, TakesTheColoursThatAreGiven) {
  const Packing packing = bed_with_clusters();
  pictures::SeenFrames seen;
  seen.rule = settings_of("clusters");
  seen.instants = {{packing.frame.step}};
  seen.cluster_colours = {{{7, 5}, {8, -1}}};
  const FrameView view = pictures::make_map({{packing.frame, packing.statics}}, settings_of("clusters"),
                                            test::extent_of(packing), &seen);
  EXPECT_EQ(view.discs[0].fill, pictures::cluster_palette()[6]);
  EXPECT_EQ(view.discs[12].fill, pictures::cluster_palette()[0]) << "it spans, whatever it had before";
}

TEST(ClustersMap, OfAnotherPaletteRepeatsAllButTheColourOfSpanningClusters) {
  const Packing packing = bed_with_clusters();
  pictures::SeenFrames seen;
  seen.rule = settings_of("clusters");
  seen.instants = {{packing.frame.step}};
  seen.cluster_colours = {{{7, 4}, {8, -1}}};
  pictures::MapSettings settings = settings_of("clusters");
  settings.palette = pictures::ClusterPalette::contrast;
  const FrameView view =
      pictures::make_map({{packing.frame, packing.statics}}, settings, test::extent_of(packing), &seen);
  EXPECT_EQ(view.discs[0].fill, pictures::cluster_palette(settings.palette).at(1));
}

TEST(OverloadedClusters, AreJoinedByForcesOrByNeighbours) {
  Packing packing = test::row_of_grains({0.9, 0.9, 0.4, 0.9});
  pictures::MapSettings settings = settings_of("clusters");
  EXPECT_EQ(pictures::overloaded_clusters({packing.frame, packing.statics}, settings).count(), 3)
      << "no force";
  settings.joined_by_neighbours = true;
  EXPECT_EQ(pictures::overloaded_clusters({packing.frame, packing.statics}, settings).count(), 2);
  settings.threshold_factor = 0.5;
  EXPECT_EQ(pictures::overloaded_clusters({packing.frame, packing.statics}, settings).count(), 1);
  settings.threshold_factor = 2.0;
  EXPECT_EQ(pictures::overloaded_clusters({packing.frame, packing.statics}, settings).count(), 0);
}

}  // namespace
}  // namespace talus::render
