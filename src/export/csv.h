#pragma once
/// Frames and observables as tables. The first line names columns, with their units in brackets: "time (s)".
/// A number that is none is an empty field.

#include <span>
#include <string>

#include "analysis/frame_quantities.h"
#include "core/observables.h"

namespace talus {

/// Rows of a frame, and what they are called.
struct CsvRows {
  std::string head, rows;
};

/// A row for the frame: its number, step, time and tilt.
CsvRows frame_csv(const GrainSource& frame);
/// A row for each grain, and for each contact; the first column is the number of the frame.
CsvRows grains_csv(const GrainSource& frame);
CsvRows contacts_csv(const GrainSource& frame);

/// All of a series.
std::string observables_csv(std::span<const ObservableRow> rows);

}  // namespace talus
