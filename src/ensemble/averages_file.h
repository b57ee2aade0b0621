#pragma once
/// The averages of an ensemble as files: ensemble.h5, which has all of them, and averages.csv
/// (docs/ensembles.md).

#include <string>
#include <vector>

#include "ensemble/averages.h"
#include "ensemble/list_averages.h"

namespace talus::ensemble {

/// The averages of a variant, and what it is.
struct NamedAverages {
  std::string name;      ///< of the variant; empty for the only one
  std::string scenario;  ///< its text, every key written out
  Averages averages;
  ListAverages lists = {};
};

/// Takes the values out of `variants` as it goes, since there may be many. Throws as write_durably does.
void write_averages(const std::string& path, std::vector<NamedAverages> variants, const std::string& version);

/// A row for each quantity with one number at each angle: variant, grid, angle, quantity, unit, n, mean,
/// standard deviation, standard error, interval of 95 % for the mean, quartiles.
std::string averages_csv(const std::vector<NamedAverages>& variants);

}  // namespace talus::ensemble
