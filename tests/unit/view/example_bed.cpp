#include "unit/view/example_bed.h"

#include <cmath>
#include <utility>

#include "core/trigonometry.h"
#include "stress/stress.h"

namespace talus::example {

RunStatics bed_statics() {
  RunStatics statics;
  statics.free_count = columns * rows;
  statics.radius.assign(statics.free_count + columns, 0.5);
  statics.mass.assign(statics.free_count + columns, 2.0);
  statics.periodic = true;
  statics.length = columns;
  statics.depth = rows;
  statics.mean_diameter = 1.0;
  statics.gravity = 10.0;
  return statics;
}

Frame bed_frame(double tilt, Index overloaded) {
  const RunStatics statics = bed_statics();
  Frame frame;
  frame.tilt = radians(tilt);
  frame.step = std::lround(1000.0 * tilt);
  frame.time = 0.1 * tilt;
  frame.friction = {0.5, 0.5};
  for (Index i = 0; i < columns * (rows + 1); ++i) {
    const bool floor = i >= statics.free_count;
    const Index column = i % columns, row = floor ? -1 : i / columns;
    const bool over = column == 0 && row < overloaded;
    frame.x.push_back(column + 0.5);
    frame.y.push_back(row + 0.5);
    frame.internal_moment.push_back(floor ? Tensor2{} : Tensor2{1.0, 0.0, 0.0, over ? 0.0 : 1.0});
    frame.gamma.push_back(stress::stress_state(frame.internal_moment.back()).ratio);
  }
  frame.angle = frame.vx = frame.vy = frame.omega = std::vector(frame.x.size(), 0.0);
  frame.image.assign(frame.x.size(), 0);
  FrameContacts& c = frame.contacts;
  for (Index i = 0; i < statics.free_count; ++i) {
    const bool lowest = i < columns;
    c.a.push_back(lowest ? i : i - columns);
    c.b.push_back(lowest ? statics.free_count + i : i);
    c.shift.push_back(0);
    c.nx.push_back(0.0);
    c.ny.push_back(lowest ? -1.0 : 1.0);
    c.px.push_back(frame.x[i]);
    c.py.push_back(frame.y[i] - 0.5);
    c.fn.push_back(1.0);
    c.ft.push_back(0.0);
    c.status.push_back(ContactStatus::sticking);
  }
  return frame;
}

void write_run(const std::string& path, double theta_c, std::vector<Frame> frames) {
  io::RunHeader header;
  header.statics = bed_statics();
  header.seed = 7;
  io::Segment segment;
  segment.frames = std::move(frames);
  for (int i = 0; i <= 50; ++i) {
    ObservableRow row{};
    at(row, Observable::tilt) = radians(0.5 * i);
    at(row, Observable::time) = 0.05 * i;
    segment.observables.push_back(row);
    StepRow step{};
    at(step, StepField::step) = 500.0 * i;
    at(step, StepField::phase) = 1.0;
    at(step, StepField::iterations) = i;
    at(step, StepField::converged) = i % 10 == 7 ? 0.0 : 1.0;
    segment.steps.push_back(step);
  }
  io::Checkpoint checkpoint;
  checkpoint.world.boundary = {true, header.statics.length, {}};
  for (std::size_t i = 0; i < header.statics.radius.size(); ++i)
    add_disk(checkpoint.world.grains, {static_cast<double>(i), 0.0}, 0.5, 1.0,
             i >= static_cast<std::size_t>(header.statics.free_count));
  checkpoint.results = {{"theta_c", radians(theta_c)}};
  constexpr std::int64_t last_of_tilt = 25000;
  checkpoint.world.step = segment.frames.empty() ? 0 : segment.frames.back().step;
  if (checkpoint.world.step > last_of_tilt)
    checkpoint.integers = {{"flow_steps", checkpoint.world.step - last_of_tilt}};
  io::RunStore store = io::RunStore::create(path, header, true);
  store.commit(segment, checkpoint);
  store.pack();
}

void write_bed_run(const std::string& path, double theta_c) {
  std::vector<Frame> frames;
  for (std::size_t k = 0; k < overloaded_of_frames.size(); ++k)
    frames.push_back(bed_frame(5.0 * static_cast<double>(k), overloaded_of_frames[k]));
  frames[2].y[39] += 1.0;
  for (const double tilt : {24.0, 23.0}) {
    frames.push_back(bed_frame(tilt, 1));
    frames.back().step = 30000 + std::lround(100.0 * (25.0 - tilt));
    frames.back().time = 3.0 + 0.1 * (25.0 - tilt);
  }
  write_run(path, theta_c, std::move(frames));
}

}  // namespace talus::example
