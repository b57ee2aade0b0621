/// Page of a hand-made bed.

#include <gtest/gtest.h>

#include <regex>

#include "base/errors.h"
#include "exports/page/page_data.h"
#include "exports/writers.h"
#include "runs/analysis_run.h"
#include "support/exit_code.h"
#include "support/has.h"
#include "support/temporary_folder.h"
#include "unit/exports/unpacked.h"
#include "unit/view/example_bed.h"

namespace talus::exports {
namespace {

using Frames = std::vector<std::size_t>;

class RunPage : public testing::Test {
 protected:
  void SetUp() override { write(22.0); }
  void write(double theta_c) {
    path_ = folder_.path("bed.h5");
    example::write_bed_run(path_, theta_c);
    file_.emplace(io::RunFile::open(path_));
    analysis_ = runs::analyse_run(*file_, {}, 1, {});
  }
  std::string page(const Frames& frames) { return run_page(*file_, path_, analysis_, frames, {}); }
  /// Returns the text of an element of the page.
  static std::string element(const std::string& page, const std::string& id) {
    const auto begin = page.find('>', page.find("id=\"" + id + "\"")) + 1;
    return page.substr(begin, page.find("</script>", begin) - begin);
  }
  std::vector<std::uint32_t> table(const std::string& page, const std::string& name, std::size_t rows,
                                   std::size_t columns, int bytes = 2) {
    return test::unpacked(element(page, "table-" + name), rows, columns, bytes);
  }

  test::TemporaryFolder folder_;
  std::string path_;
  std::optional<io::RunFile> file_;
  analysis::Analysis analysis_;
};

TEST_F(RunPage, holds_the_frames_that_are_asked_for) {
  const std::string some = page({0, 3, 6});
  EXPECT_TRUE(test::has(some, "\"numbers\":[0,3,6]"));
  EXPECT_TRUE(test::has(some, "\"of_tilt\":2")) << "frame 6 belongs to the flow";
  EXPECT_TRUE(test::has(some, "\"tilts\":[0.0,15.0,24.0]"));
  const std::size_t grains = file_->header().statics.radius.size();
  EXPECT_EQ(table(some, "x", grains, 3).size(), 3 * grains);
}

TEST_F(RunPage, holds_places_within_half_a_quantum) {
  const Frames frames = {1, 2, 5};
  const std::string text = page(frames);
  const RunStatics& statics = file_->header().statics;
  const auto x = table(text, "x", statics.radius.size(), 3), y = table(text, "y", statics.radius.size(), 3);
  ASSERT_FALSE(x.empty());
  const PageRun run = begin_page(*file_, analysis_, frames);
  const Quantum across = places_of_period(statics.length),
                up = places_of_box(run.extent.y_min, run.extent.y_max);
  for (std::size_t column = 0; column < frames.size(); ++column) {
    const Frame frame = file_->frame(frames[column]);
    for (std::size_t i = 0; i < statics.radius.size(); ++i) {
      const double off = frame.x[i] - across.step * x[3 * i + column];
      EXPECT_NEAR(off - statics.length * std::round(off / statics.length), 0.0, 0.5001 * across.step);
      EXPECT_NEAR(up.low + up.step * y[3 * i + column], frame.y[i], 0.5001 * up.step);
    }
  }
}

TEST_F(RunPage, holds_clusters_and_values_of_grains) {
  const Frames frames = {3};
  const std::string text = page(frames);
  const auto free_grains = static_cast<std::size_t>(file_->header().statics.free_count);
  const auto clusters = table(text, "cluster", free_grains, 1);
  const analysis::FrameThreshold& at = analysis_.frames[3].thresholds.front();
  ASSERT_EQ(clusters.size(), free_grains);
  for (std::size_t i = 0; i < free_grains; ++i)
    EXPECT_EQ(clusters[i], at.cluster[i] < 0 ? no_code : static_cast<std::uint32_t>(at.cluster[i])) << i;
  const auto lengths = table(text, "lc", free_grains, 1);
  for (std::size_t i = 0; i < free_grains; ++i) {
    if (at.cluster[i] < 0) {
      EXPECT_EQ(lengths[i], no_code);
    } else {
      EXPECT_NEAR(lengths[i] / 100.0, static_cast<double>(at.lc[i]), 0.00501);
    }
  }
}

TEST_F(RunPage, says_what_the_pictures_say) {
  const Frames frames = {2, 3};
  const std::string text = std::regex_replace(page(frames), std::regex(R"(\\u003c)"), "<");
  const PageRun run = begin_page(*file_, analysis_, frames);
  std::size_t maps = 0;
  for_each_frame(
      run, {},
      [&](const analysis::GrainSource& frame, const pictures::SeenFrames& seen, const auto&, const auto&) {
        std::vector<pictures::MapKind> kinds = filling_maps(run);
        kinds.insert(kinds.end(), {pictures::MapKind::forces, pictures::MapKind::critical});
        for (const pictures::MapKind kind : kinds) {
          pictures::MapSettings settings = run.settings;
          settings.layers = {kind};
          const render::FrameView view = pictures::make_map(frame, settings, run.extent, &seen);
          EXPECT_TRUE(test::has(text, "\"" + view.title + "\"")) << view.title;
          EXPECT_TRUE(test::has(text, "\"" + view.caption + "\"")) << view.caption;
          for (const render::Bar& bar : view.legends[0].bars)
            for (const render::BarTick& tick : bar.ticks)
              EXPECT_TRUE(test::has(text, "\"label\":\"" + tick.label + "\"")) << tick.label;
          for (const render::Swatch& swatch : view.legends[0].swatches)
            EXPECT_TRUE(test::has(text, "\"label\":\"" + swatch.label + "\"")) << swatch.label;
          ++maps;
        }
      });
  EXPECT_GE(maps, 14U);
}

TEST_F(RunPage, needs_nothing_but_itself) {
  const std::string text = page({0});
  EXPECT_TRUE(test::has(text, "default-src 'none'"));
  const std::regex address(R"(https?:|//[a-z]+\.[a-z]|url\(|src=|@import|<link)");
  std::string rest = text;
  const std::string names = "http://www.w3.org/2000/svg";  // the name of a namespace, which is never fetched
  for (auto at = rest.find(names); at != std::string::npos; at = rest.find(names))
    rest.erase(at, names.size());
  const std::smatch found = [&] {
    std::smatch match;
    std::regex_search(rest, match, address);
    return match;
  }();
  EXPECT_TRUE(found.empty()) << found.str();
  EXPECT_EQ(test::count_of(text, "{{"), 0U) << "the template is filled completely";
  EXPECT_EQ(test::count_of(text, "<script"), test::count_of(text, "</script>"));
  EXPECT_EQ(element(text, "data").find('<'), std::string::npos) << "no text of the run closes its element";
}

TEST_F(RunPage, is_small) {
  // Subtracting one or two bytes per value of a grain leaves the page itself.
  const std::size_t frames = file_->all_frame_tilts().size();
  Frames all(frames);
  for (std::size_t k = 0; k < frames; ++k) all[k] = k;
  EXPECT_LT(page(all).size(), 150'000U);
}

TEST_F(RunPage, is_the_same_each_time) { EXPECT_EQ(page({0, 3}), page({0, 3})); }

TEST_F(RunPage, of_a_run_that_stands_has_no_clusters) {
  write(std::nan(""));
  const std::string text = page({0, 5});
  EXPECT_FALSE(test::has(text, "\"name\":\"clusters\""));
  EXPECT_FALSE(test::has(text, "table-cluster\""));
  EXPECT_TRUE(test::has_all(text, {"(assumed)", "the slope has not failed", "\"theta_c\":null"}));
}

TEST_F(RunPage, names_events_that_lie_among_its_frames) {
  EXPECT_TRUE(test::has(page({0, 1, 2, 3, 4}), "\"name\":\"theta_c\""));
  EXPECT_FALSE(test::has(page({0, 1}), "\"name\":\"theta_c\"")) << "5 deg is far from the failure";
}

TEST_F(RunPage, of_a_tilt_that_is_held_and_lowered_is_in_time) {
  EXPECT_TRUE(test::has_all(page({0, 1}), {"\"by_time\":false", "\"places\":[0.0,5.0]", "D per degree"}));
  std::vector<Frame> frames;
  for (const double tilt : {0.0, 10.0, 10.0, 4.0, 20.0}) {
    frames.push_back(example::bed_frame(tilt, 1));
    frames.back().step = 1000 * std::ssize(frames);
    frames.back().time = 0.5 * static_cast<double>(frames.size());
  }
  example::write_run(path_, 22.0, std::move(frames));
  file_.emplace(io::RunFile::open(path_));
  analysis_ = runs::analyse_run(*file_, {}, 1, {});
  const std::string text = page({0, 1, 2, 3, 4});
  EXPECT_TRUE(test::has_all(
      text, {"\"by_time\":true", "\"places\":[0.0,0.5,1.0,1.5,2.0]", "\"tilts\":[0.0,10.0,10.0,4.0,20.0]"}));
  // The rows reach 22 deg after 2.2 s, which is 1.7 s after the first frame.
  EXPECT_TRUE(test::has(text, "\"tilt\":22.0,\"at\":1.7,\"place\":3.4"));
  EXPECT_FALSE(test::has(text, "D per degree")) << "values of frames are comparable only as totals";
}

TEST_F(RunPage, stops_when_asked) {
  const Watch watch{{}, [] { return true; }};
  EXPECT_EQ(test::exit_code_of([&] { run_page(*file_, path_, analysis_, {0}, watch); }), ExitCode::stopped);
}

TEST_F(RunPage, of_a_bed_that_fails_at_a_tiny_angle_is_written) {
  write(0.3);
  EXPECT_GT(page({0}).size(), 10'000u) << "2 Gamma_c = 0.01, below the usual white";
}

}  // namespace
}  // namespace talus::exports
