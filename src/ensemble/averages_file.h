#pragma once
/// Output files with the averages of an ensemble: ensemble.h5, which contains all of them, and averages.csv
/// (docs/ensembles.md).

#include <string>
#include <vector>

#include "ensemble/averages.h"
#include "ensemble/list_averages.h"

namespace talus::ensemble {

/// The averages of a variant, with its name and scenario.
struct NamedAverages {
  std::string name;      ///< name of the variant; empty if there is only one
  std::string scenario;  ///< TOML with every key
  Averages averages;
  ListAverages lists = {};
};

/// Writes ensemble.h5. Frees the values of `variants` while it writes, because they may be large. Throws the
/// errors of write_durably.
void write_averages(const std::string& path, std::vector<NamedAverages> variants, const std::string& version);

/// Returns a CSV row for each scalar quantity at each angle: variant, grid, angle, quantity, unit, n, mean,
/// standard deviation, standard error, 95 % interval of the mean, quartiles.
std::string averages_csv(const std::vector<NamedAverages>& variants);

}  // namespace talus::ensemble
