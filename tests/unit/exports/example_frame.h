#pragma once
/// Two free grains and a floor grain in a periodic bed: the free grains touch each other across the edge, and
/// the floor.

#include <cmath>

#include "analysis/frame_quantities.h"

namespace talus::test {

/// Data to which a GrainSource points.
struct ExampleFrame {
  RunStatics statics;
  Frame first, frame;
  std::vector<double> gamma, factors;
  std::vector<analysis::FrameThreshold> thresholds;

  analysis::GrainSource source() const {
    return {{frame, statics}, nullptr, true, 7, gamma, &first, factors, thresholds};
  }
};

inline ExampleFrame example_frame() {
  ExampleFrame sample;
  sample.statics = {.free_count = 2,
                    .radius = {0.05, 0.06, 0.05},
                    .mass = {1.0, 1.5, 1.0},
                    .periodic = true,
                    .length = 1.0,
                    .depth = 0.2,
                    .mean_diameter = 0.125,
                    .gravity = 9.81};
  sample.factors = {1.0, 1.5};
  sample.first.x = {0.1, 0.9, 0.5};
  sample.first.y = {0.2, 0.1, -0.05};
  sample.first.image = {0, 0, 0};
  sample.frame.step = 1200;
  sample.frame.time = 0.1;
  sample.frame.tilt = 0.25;
  sample.frame.friction = {0.5, 0.0};
  sample.frame.x = {0.9375, 0.03125, 0.5};
  sample.frame.y = {0.1875, 0.125, -0.0625};
  sample.frame.angle = {0.0, static_cast<double>(0.1F), 0.0};
  sample.frame.vx = {0.5, -0.25, 0.0};
  sample.frame.vy = {-1.0, 0.0, 0.0};
  sample.frame.omega = {2.0, 0.0, 0.0};
  sample.frame.image = {-1, 0, 0};
  sample.frame.internal_moment = {{3.0, 0.5, 0.25, 1.0}, {1.0, 0.0, 0.0, 1.0}, {}};
  sample.frame.gamma = {static_cast<double>(0.6F), 0.0, std::nan("")};
  sample.frame.contacts = {
      .a = {0, 1, 1},
      .b = {1, 2, 3},
      .shift = {1, 0, 0},
      .nx = {1.0, 0.0, 0.0},
      .ny = {0.0, -1.0, -1.0},
      .px = {1.0, 0.25, 0.03125},
      .py = {0.125, 0.0, 0.0},
      .fn = {4.0, 1.0, 1.0},
      .ft = {-1.0, 0.5, 0.0},
      .status = {ContactStatus::sticking, ContactStatus::sliding, ContactStatus::sticking}};
  sample.gamma = {0.5, 0.25, std::nan("")};
  const float none = std::nanf("");
  sample.thresholds = {{.lc = {0.5F, none, none}, .cluster = {0, -1, -1}},
                       {.lc = {none, none, none}, .cluster = {-1, -1, -1}}};
  return sample;
}

}  // namespace talus::test
