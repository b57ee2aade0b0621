/// View of a hand-made run file.

#include "view/view_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <span>

#include "base/errors.h"
#include "base/hash.h"
#include "core/trigonometry.h"
#include "io/packed_file.h"
#include "io/run_file.h"
#include "runs/analysis_parameters.h"
#include "runs/analysis_run.h"
#include "support/exit_code.h"
#include "unit/view/opened_view.h"

namespace talus::view {
namespace {

using example::wait_for_condition, example::opened, example::plot;

const std::vector<std::string> single_grains = {"l_min=0"};  // settings of an analysis

class ViewOfRun : public example::ViewOfBed {
 protected:
  using ViewOfBed::ViewOfBed;
  bool wait_for_all() {
    return wait_for_condition(*model_,
                              [this] { return plot(*model_, "overloaded").series[0].x.size() == 6; });
  }
};

class ViewOfUnfailedRun : public ViewOfRun {
 protected:
  ViewOfUnfailedRun() : ViewOfRun(std::nan("")) {}
};

TEST_F(ViewOfRun, opens_at_its_first_frame_with_the_map_of_gamma) {
  EXPECT_FALSE(model_->is_live());
  EXPECT_EQ(model_->live(), nullptr);
  EXPECT_EQ(model_->recording().seed, 7u);
  EXPECT_EQ(model_->frame_count(), 8u);
  EXPECT_EQ(model_->frame_index(), 0u);
  EXPECT_EQ(model_->state.map.layers, pictures::MapLayers{pictures::MapKind::gamma});
  EXPECT_TRUE(model_->theta_c_known());
  EXPECT_NEAR(degrees(model_->theta_c()), 20.0, 1e-6);
  const render::FrameView view = model_->first().map(2.0);
  EXPECT_FALSE(view.furniture);
  EXPECT_GE(view.discs.size(), 50u);
  const auto region = model_->first().part(2.0);
  EXPECT_NEAR((region.x_max - region.x_min) / (region.y_max - region.y_min), 2.0, 1e-12);
  EXPECT_LE(region.y_min, -1.0);
  EXPECT_GE(region.y_max, 4.0);
}

TEST_F(ViewOfRun, knows_how_the_step_of_its_frame_was_solved) {
  model_->go_to(3);
  const SolvedSteps solved = model_->solved_steps();
  EXPECT_EQ(solved.count, 51);
  EXPECT_EQ(solved.unconverged, 5);
  ASSERT_TRUE(solved.last.has_value());
  EXPECT_EQ(at(*solved.last, StepField::step), static_cast<double>(model_->frame().step));
  EXPECT_EQ(at(*solved.last, StepField::iterations), 30.0);
}

TEST_F(ViewOfRun, has_places_on_each_axis_of_its_plots) {
  ASSERT_TRUE(wait_for_all());
  model_->go_to(3);
  for (const PlotAxis axis : {PlotAxis::time, PlotAxis::angle_left, PlotAxis::tilt}) {
    model_->state.plot_options["stress"].zoomed = {1.0, 2.0};
    model_->set_plot_axis(axis);
    EXPECT_EQ(model_->plot_axis(), axis);
    EXPECT_FALSE(model_->state.plot_options["stress"].zoomed.has_value());
    const auto number = static_cast<int>(axis);
    const double shown = *model_->plot_marks().shown;
    EXPECT_EQ(shown, plot(*model_, "overloaded").series[0].x.at(3)) << number;
    model_->go_to(0);
    model_->go_to_place(shown);
    EXPECT_EQ(model_->frame_index(), 3u) << number;
    ASSERT_TRUE(model_->plot_marks().theta_c.has_value()) << number;
    const double failure = *model_->plot_marks().theta_c;
    const std::vector<double> expected = {20.0, 0.0, 2.0};
    EXPECT_NEAR(failure, expected[static_cast<std::size_t>(axis)], 1e-6);
  }
}

TEST_F(ViewOfRun, shows_any_quantity_that_it_has) {
  ASSERT_TRUE(wait_for_all());
  const auto offered = [this](const std::string& name) {
    return std::ranges::count(model_->more_quantities(), name, &analysis::Quantity::name) == 1;
  };
  EXPECT_FALSE(offered("gamma/mean")) << "it has no analysis";
  EXPECT_FALSE(offered("gamma/density")) << "no number";
  model_->set_plot_axis(PlotAxis::time);
  for (const char* name : {"overloaded/fraction_of_all", "contacts/coordination_number"}) {
    ASSERT_TRUE(offered(name));
    model_->add_plot(*std::ranges::find(analysis::quantities(), name, &analysis::Quantity::name));
    EXPECT_FALSE(offered(name));
    EXPECT_EQ(plot(*model_, name).x_title, "t (s)");
    EXPECT_FALSE(plot(*model_, name).series[0].x.empty()) << name;
  }
  EXPECT_EQ(plot(*model_, "overloaded/fraction_of_all").title, "overloaded/fraction_of_all");
  EXPECT_EQ(plot(*model_, "overloaded/fraction_of_all").note, "at 1 Γ_c");
  const std::size_t count = model_->plots().size();
  model_->remove_plot("contacts/coordination_number");
  model_->remove_plot("stress");
  EXPECT_EQ(model_->plots().size(), count - 1) << "only added plots can be removed";
}

TEST_F(ViewOfUnfailedRun, has_no_angle_left) {
  EXPECT_FALSE(model_->has_plot_axis(PlotAxis::angle_left));
  model_->set_plot_axis(PlotAxis::angle_left);
  EXPECT_EQ(model_->plot_axis(), PlotAxis::tilt);
}

TEST_F(ViewOfRun, goes_to_its_landmarks) {
  EXPECT_TRUE(model_->place_of(Landmark::theta_c));
  model_.reset();  // its thread reads the file that will be opened again
  EXPECT_FALSE(ViewModel::open(path_, {}, "", false, "talus view").place_of(Landmark::length_jump))
      << "nothing has been computed yet";
  model_.emplace(opened(path_));
  ASSERT_TRUE(wait_for_all());
  const std::pair<Landmark, std::size_t> places[] = {{Landmark::last, 7},
                                                     {Landmark::length_jump, 3},
                                                     {Landmark::theta_c, 4},
                                                     {Landmark::percolation, 3},
                                                     {Landmark::first, 0}};
  for (const auto& [landmark, frame] : places) {
    EXPECT_TRUE(model_->place_of(landmark));
    model_->go_to(landmark);
    EXPECT_EQ(model_->frame_index(), frame);
  }
}

TEST_F(ViewOfUnfailedRun, assumes_an_angle) {
  EXPECT_FALSE(model_->theta_c_known());
  EXPECT_NEAR(degrees(model_->theta_c()), 20.0, 1e-12);
  EXPECT_FALSE(model_->place_of(Landmark::theta_c));
  EXPECT_NE(model_->first().furnished_map().caption.find("assumed"), std::string::npos);
  EXPECT_NE(model_->render_command().find("--set gamma_c=0.342"), std::string::npos);
}

TEST_F(ViewOfRun, tells_when_what_is_shown_has_changed) {
  ASSERT_TRUE(wait_for_all());
  ASSERT_TRUE(wait_for_condition(*model_, [this] { return !model_->update(0.0); }));
  while (model_->update(0.0)) {
  }
  EXPECT_FALSE(model_->update(1.0));
  model_->replay()->set_speed(5.0);
  model_->play(true);
  EXPECT_FALSE(model_->update(0.5));
  EXPECT_TRUE(model_->update(0.75));
  EXPECT_EQ(model_->frame_index(), 1u);
  EXPECT_NEAR(degrees(model_->frame().tilt), 5.0, 1e-6);
}

TEST_F(ViewOfRun, works_out_curves_anew_for_another_threshold) {
  ASSERT_TRUE(wait_for_all());
  EXPECT_NEAR(plot(*model_, "overloaded").series[0].y[3], 0.1, 1e-12);
  model_->state.map.threshold_factor = 3.5;  // a threshold Q/P of 1.2, above all grains
  EXPECT_TRUE(model_->update(0.0));
  ASSERT_TRUE(wait_for_all());
  EXPECT_EQ(plot(*model_, "overloaded").series[0].y[3], 0.0);
}

TEST_F(ViewOfRun, takes_curves_from_a_stored_analysis) {
  model_.reset();
  const io::RunFile run = io::RunFile::open(path_);
  analysis::Analysis analysis = runs::analyse_run(run, runs::parse_analysis_settings(single_grains), 1, {});
  analysis.frames[3].thresholds[0].overloaded_fraction = 0.75;  // frame 3, first threshold: a distinct value
  io::store_analysis(path_, analysis, hash_text(state_hash(run.checkpoint().world)));
  model_.emplace(opened(path_));
  model_->update(0.0);  // effective immediately
  ASSERT_EQ(plot(*model_, "overloaded").series[0].y.size(), 6u);
  EXPECT_EQ(plot(*model_, "overloaded").series[0].y[3], 0.75);
  EXPECT_NEAR(plot(*model_, "lengths").series[1].y[3], std::sqrt(8.0), 1e-6);
  EXPECT_TRUE(model_->place_of(Landmark::length_jump));
  EXPECT_TRUE(model_->place_of(Landmark::percolation));
  model_->state.map.threshold_factor = 1.5;  // not in the analysis
  model_->update(0.0);
  ASSERT_TRUE(wait_for_all());
  EXPECT_NEAR(plot(*model_, "overloaded").series[0].y[3], 0.1, 1e-12);
  model_->state.map.threshold_factor = 1.0;
  model_->state.map.joined_by_neighbours = true;  // not in the analysis
  model_->update(0.0);
  ASSERT_TRUE(wait_for_all());
  EXPECT_NEAR(plot(*model_, "overloaded").series[0].y[3], 0.1, 1e-12);
}

TEST_F(ViewOfRun, takes_no_lengths_that_end_elsewhere) {
  const double theta_c = model_->theta_c();
  model_.reset();
  const io::RunFile run = io::RunFile::open(path_);
  analysis::AnalysisParameters parameters = runs::parse_analysis_settings(single_grains);
  parameters.lc_factor = 2.0;
  const analysis::Analysis analysis = runs::analyse_run(run, parameters, 1, {});
  EXPECT_FALSE(find_threshold(analysis, {theta_c, 1.0, false, 0.0}).has_value());
  EXPECT_EQ(find_threshold(analysis, {theta_c, 2.0, false, 0.0}), 1u);
  EXPECT_FALSE(find_threshold(analysis, {theta_c, 2.0, false, 3.0}).has_value()) << "of single grains";
}

TEST_F(ViewOfRun, takes_no_analysis_of_means_over_frames) {
  model_.reset();
  const io::RunFile run = io::RunFile::open(path_);
  analysis::AnalysisParameters parameters;
  parameters.averaging = 10.0;
  io::store_analysis(path_, runs::analyse_run(run, parameters, 1, {}),
                     hash_text(state_hash(run.checkpoint().world)));
  EXPECT_FALSE(read_usable_analysis(io::RunFile::open(path_)).has_value());
}

TEST_F(ViewOfRun, takes_grains_with_their_first_neighbours_unless_told_otherwise) {
  model_.reset();
  EXPECT_EQ(ViewModel::open(path_, {}, "", false, "talus view").state.map.l_min, 3.0);
  model_.emplace(opened(path_));
  model_->go_to(3);
  model_->state.selected = 10;
  EXPECT_EQ(model_->frame().gamma[10], 1.0);
  EXPECT_NE(model_->render_command().find("--set l_min=0"), std::string::npos);
  const double density = plot(*model_, "gamma").series[0].y.back();
  model_->state.map.l_min = 3.0;
  EXPECT_TRUE(model_->update(0.0));
  // Grain 10 has nine grains within 1.5 D, three of which are overloaded: Q = 3, P = 15.
  EXPECT_NEAR(model_->frame().gamma[10], 0.2, 1e-12);
  EXPECT_NEAR(model_->first().inspection()->gamma, 0.2, 1e-12);
  EXPECT_EQ(model_->first().inspection()->state.ratio, 1.0) << "the grain alone";
  EXPECT_FALSE(model_->first().inspection()->overloaded);
  EXPECT_NE(model_->first().furnished_map().title.find("l = 3 D"), std::string::npos);
  EXPECT_LT(plot(*model_, "gamma").series[0].y.back(), density);
  EXPECT_EQ(model_->render_command().find("l_min"), std::string::npos);
  model_->state.map.l_min = 0.0;
  model_->update(0.0);
  EXPECT_EQ(model_->frame().gamma[10], 1.0);
}

TEST_F(ViewOfRun, inspects_the_selected_grain) {
  EXPECT_EQ(model_->first().inspection(), nullptr);
  model_->go_to(3);
  model_->state.selected = find_grain(model_->bed(), 0.4, 1.5);
  ASSERT_TRUE(model_->state.selected.has_value());
  const Inspection* inspection = model_->first().inspection();
  ASSERT_NE(inspection, nullptr);
  EXPECT_EQ(inspection->grain, 10);
  EXPECT_EQ(inspection->cluster_size, 4);
  EXPECT_EQ(inspection->coarse_graining_length, std::sqrt(8.0));
  EXPECT_EQ(inspection, model_->first().inspection());
  model_->state.neighbourhood = 2.0;
  EXPECT_NEAR(model_->first().inspection()->neighbourhood_gamma, 3.0 / 7.0, 1e-12);
  model_->go_to(0);
  EXPECT_FALSE(model_->first().inspection()->overloaded);
  model_->go_to(1);
  model_->state.selected = 0;
  EXPECT_EQ(model_->first().inspection()->cluster_size, 1);
  model_->state.selected = 999;
  EXPECT_EQ(model_->first().inspection(), nullptr);
}

TEST_F(ViewOfRun, draws_the_selection_and_its_cluster_where_it_is_asked_for) {
  model_->go_to(3);
  const render::FrameView bare = model_->first().map(2.0);
  EXPECT_TRUE(bare.lines.empty());
  model_->state.selected = 10;
  model_->state.show_neighbourhoods = false;
  const render::FrameView selected = model_->first().map(2.0);
  ASSERT_EQ(selected.discs.size(), bare.discs.size());
  for (std::size_t k = 0; k < bare.discs.size(); ++k)
    EXPECT_TRUE(selected.discs[k].fill == bare.discs[k].fill);
  EXPECT_GE(selected.lines.size(), 2u * 64u) << "a ring on white";
  for (const render::Line& line : selected.lines)
    EXPECT_LT(std::hypot(std::remainder(line.x0 - 0.5, 10.0), line.y0 - 1.5), 0.75)
        << "nothing about the cluster";
  model_->state.highlight_cluster = true;
  EXPECT_GE(model_->first().map(2.0).lines.size(), selected.lines.size() + 8u)
      << "four grains, each with two neighbours";
  EXPECT_EQ(model_->first().map(2.0).discs.size(), bare.discs.size());
  model_->state.show_neighbourhoods = true;
  EXPECT_GT(model_->first().map(2.0).lines.size(), selected.lines.size() + 8u);
}

TEST_F(ViewOfRun, has_the_density_of_the_frame_shown) {
  const double before = plot(*model_, "gamma").series[0].y.back();
  EXPECT_EQ(before, 0.0);
  model_->go_to(3);
  EXPECT_GT(plot(*model_, "gamma").series[0].y.back(), before);
}

TEST_F(ViewOfRun, has_room_for_all_frames) {
  ASSERT_TRUE(wait_for_all());
  EXPECT_NEAR(model_->first().part(100.0).y_max, 5.0, 1e-6) << "the third frame is higher";
}

/// Two groups of twelve grains below the surface: only the right one, then both.
TEST_F(ViewOfRun, keeps_the_colours_of_clusters) {
  model_.reset();
  std::vector<Frame> frames = {example::bed_frame(0.0, 0), example::bed_frame(5.0, 0)};
  for (Index i = 0; i < 3 * example::columns; ++i) {
    const Index column = i % example::columns;
    if (column >= 5 && column < 9) frames[0].gamma[i] = frames[1].gamma[i] = 1.0;
    if (column < 4) frames[1].gamma[i] = 1.0;
  }
  example::write_run(folder_.path("two.h5"), 20.0, frames);
  ViewModel model = opened(folder_.path("two.h5"));
  model.state.map.layers = {pictures::MapKind::clusters};
  model.state.map.joined_by_neighbours = true;
  model.go_to(1);
  const auto fill_at = [&model](float x) {
    const render::FrameView view = model.first().map(2.0);
    return std::ranges::find(view.discs, x, &render::Disc::x)->fill;
  };
  const std::vector<render::Colour> palette = pictures::cluster_palette();
  // The colours follow from the previous frame once it has been processed; until then this frame is the
  // first.
  EXPECT_TRUE(wait_for_condition(model, [&] { return fill_at(6.5f) == palette[1]; }));
  EXPECT_TRUE(fill_at(1.5f) == palette[2]);
  // Joined by contacts, each column is a separate cluster, too small for a colour; colours of the other rule
  // do not count.
  model.state.map.joined_by_neighbours = false;
  EXPECT_TRUE(render::is_gray(fill_at(6.5f)));
  EXPECT_TRUE(render::is_gray(fill_at(0.5f)));
}

TEST_F(ViewOfRun, brings_the_camera_back_to_the_bed) {
  model_->first().map(1.0);
  model_->state.camera = {100.0, 100.0, 2.0};
  model_->update(0.0);
  EXPECT_NEAR(model_->state.camera.centre_x, 7.5, 1e-9);
  EXPECT_EQ(model_->state.camera.zoom, 2.0);
}

TEST_F(ViewOfRun, crops_to_the_camera) {
  model_->state.camera = {5.0, 2.0, 5.0};
  const render::FrameView view = model_->first().map(1.0);
  EXPECT_NEAR(view.x_max - view.x_min, 2.0 * 1.5, 1.01) << "not below 3 D";
  EXPECT_LT(view.discs.size(), 30u);
  EXPECT_NE(model_->render_command().find("--crop 3.5,0.5,6.5,3.5"), std::string::npos)
      << model_->render_command();
}

TEST_F(ViewOfRun, begins_at_an_angle_that_is_asked_for) {
  model_->go_to(model_->frame_at_angle("15"));
  EXPECT_NEAR(degrees(model_->frame().tilt), 15.0, 1e-6);
  model_->go_to(model_->frame_at_angle("repose"));
  EXPECT_NEAR(degrees(model_->frame().tilt), 20.0, 1e-6);
  EXPECT_THROW(model_->go_to(model_->frame_at_angle("80")), Error);
}

TEST_F(ViewOfRun, measures_displacements_from_the_frame_before_or_since_an_angle) {
  model_->state.map.layers = {pictures::MapKind::displacement};
  model_->go_to(3);
  EXPECT_NE(model_->first().furnished_map().title.find("per degree"), std::string::npos);
  model_->state.since = radians(6.0);
  EXPECT_NE(model_->first().furnished_map().title.find("since 5.00"), std::string::npos)
      << model_->first().furnished_map().title;
  EXPECT_EQ(model_->render_command(),
            "talus render " + path_ + " --map displacement --at 15 --since 6 --range 0.001,10");
}

TEST_F(ViewOfRun, says_in_the_title_why_a_map_cannot_be_drawn) {
  model_->state.map.range_low = 0.9;
  model_->state.map.range_high = 0.1;
  EXPECT_GE(model_->first().map(2.0).discs.size(), 50u);
  EXPECT_FALSE(model_->first().furnished_map().title.empty());
  EXPECT_NE(model_->first().furnished_map().title, "Stress ratio γ of single grains");
}

TEST_F(ViewOfRun, shows_the_same_frames_on_any_way) {
  const auto expect_frame = [&](std::size_t k) {
    model_->go_to(k);
    ViewModel other = opened(path_);
    other.state.map.l_min = model_->state.map.l_min;
    other.update(0.0);
    other.go_to(k);
    EXPECT_EQ(model_->frame().tilt, other.frame().tilt) << k;
    const auto free_grains = static_cast<std::size_t>(other.statics().free_count);
    EXPECT_TRUE(std::ranges::equal(std::span(model_->frame().gamma).first(free_grains),
                                   std::span(other.frame().gamma).first(free_grains)))
        << k;
  };
  for (const std::size_t k : {0u, 1u, 2u, 4u, 6u, 5u, 4u, 2u, 0u, 7u}) expect_frame(k);
  model_->go_to(1);
  model_->go_to(2);  // frames prepared from here on have other neighbourhoods
  model_->state.map.l_min = 3.0;
  model_->update(0.0);
  for (const std::size_t k : {3u, 4u, 3u}) expect_frame(k);
}

TEST_F(ViewOfRun, tells_of_a_frame_that_cannot_be_read) {
  model_.reset();
  const std::string path = folder_.path("unfinished.h5");
  {
    io::RunStore store = io::RunStore::create(path, io::RunFile::open(path_).header(), true);
    for (const double tilt : {0.0, 10.0}) {
      io::Segment segment;
      segment.frames = {example::bed_frame(tilt, 0), example::bed_frame(tilt + 5.0, 1)};
      store.commit(segment, io::RunFile::open(path_).checkpoint());
    }
  }
  ViewModel model = opened(path);
  ASSERT_TRUE(wait_for_condition(model, [&] { return plot(model, "overloaded").series[0].x.size() == 4; }));
  for (const auto& file : std::filesystem::directory_iterator(io::run_folder(path))) {
    if (file.path().filename().string().starts_with("segment_")) std::filesystem::remove(file);
  }
  model.play(true);
  model.go_to(1);
  EXPECT_FALSE(model.replay()->playing());
  EXPECT_EQ(model.frame().tilt, 0.0) << "the previous frame";
  model.update(0.0);
  EXPECT_NE(model.state.message.find("segment_"), std::string::npos) << model.state.message;
  EXPECT_FALSE(model.first().map(2.0).discs.empty());
}

TEST_F(ViewOfRun, turned_shows_all_frames_in_one_size) {
  model_->state.map.turned = true;
  const render::FrameView flat = model_->first().map(1.5);
  model_->go_to(5);
  const render::FrameView steep = model_->first().map(1.5);
  EXPECT_NEAR(degrees(flat.turn), 0.0, 1e-6);
  EXPECT_NEAR(degrees(steep.turn), 25.0, 1e-5);
  EXPECT_EQ(flat.turn_max, steep.turn_max);
  EXPECT_EQ(flat.x_min, steep.x_min);
}

TEST_F(ViewOfRun, asks_for_the_flow_where_it_shows_it) {
  model_->go_to(6);
  EXPECT_EQ(model_->render_command(), "talus render " + path_ + " --map gamma --at 25 --flow --set l_min=0");
}

TEST_F(ViewOfRun, takes_no_settings_of_a_scenario) {
  model_.reset();
  for (const auto& [settings, output] :
       {std::pair<std::vector<std::string>, std::string>{{"seed=2"}, ""}, {{}, "x.h5"}})
    EXPECT_EQ(test::exit_code_of([&, &settings = settings, &output = output] {
                ViewModel::open(path_, settings, output, false, "");
              }),
              ExitCode::usage);
}

}  // namespace
}  // namespace talus::view
