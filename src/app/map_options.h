#pragma once
/// What `talus render` and `talus animate` share: the run, the map, the angle of repose, the size.

#include <CLI/CLI.hpp>
#include <string>

#include "io/run_file.h"
#include "maps/maps.h"

namespace talus {

struct MapOptions {
  std::string run;
  int width = 1600;       ///< px
  double theta_c = -1.0;  ///< deg; below 0: that of the run
  bool overwrite = false;
};
void add_map_options(CLI::App& command, MapOptions& options);

/// A run opened to be drawn.
struct MappedRun {
  RunFile file;
  MapExtent extent;      ///< of all frames
  double theta_c = 0.0;  ///< rad; NaN where neither the run nor the options say it
};
/// Throws Error(missing_input) or Error(bad_data), also where the run has no frames.
MappedRun open_mapped_run(const MapOptions& options);

/// The map of frame k. Throws Error(bad_data) where theta_c is not known: both maps are scaled by it.
FrameView map_of_frame(const MappedRun& run, std::size_t k, MapKind kind);

/// Throws Error(cannot_create) where a file exists, unless `overwrite`.
void refuse_existing(const std::string& path, bool overwrite);

/// `label k/count` on a terminal, rewritten in place; nothing in a log. The last call ends the line.
void show_frame_progress(const char* label, std::size_t k, std::size_t count);

}  // namespace talus
