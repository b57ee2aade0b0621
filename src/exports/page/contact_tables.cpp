#include "exports/page/contact_tables.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pictures/layers.h"

namespace talus::exports {
namespace {

constexpr double steps = 254.0;

}  // namespace

double force_of(std::uint32_t code) {
  const double share = (code - 1.0) / steps;
  return pictures::force_lines.widest * share * share;
}

std::uint32_t force_code(double force_over_mean) {
  const double share = std::sqrt(std::clamp(force_over_mean / pictures::force_lines.widest, 0.0, 1.0));
  return 1U + static_cast<std::uint32_t>(std::lround(steps * share));
}

void ContactCollector::add(const PageFrame& frame) {
  const FrameContacts& contacts = frame.frame.contacts;
  const double mean = std::accumulate(contacts.fn.begin(), contacts.fn.end(), 0.0) / contacts.count();
  for (Index c = 0; c < contacts.count(); ++c) {
    pairs_[{contacts.a[c], contacts.b[c], contacts.shift[c]}].push_back(
        {static_cast<std::uint32_t>(frame.column),
         static_cast<std::uint8_t>(force_code(contacts.fn[c] / mean)),
         contacts.status[c] == ContactStatus::sliding});
    if (contacts.b[c] >= frame.frame.grain_count())
      planes_[contacts.b[c]] = {contacts.b[c], contacts.nx[c], contacts.ny[c]};
  }
}

ContactTables ContactCollector::tables() const {
  const std::size_t rows = pairs_.size(), columns = run_.frames.size();
  ContactTables tables = {code_table(rows, 1, 4),       code_table(rows, 1, 4),       code_table(rows, 1, 1),
                          code_table(rows, columns, 1), code_table(rows, columns, 1), {}};
  std::size_t row = 0;
  for (const auto& [key, entries] : pairs_) {
    tables.a.at(row, 0) = static_cast<std::uint32_t>(std::get<0>(key));
    tables.b.at(row, 0) = static_cast<std::uint32_t>(std::get<1>(key));
    tables.shift.at(row, 0) = static_cast<std::uint8_t>(std::get<2>(key));
    for (const Entry& entry : entries) {
      tables.force.at(row, entry.column) = entry.force;
      tables.sliding.at(row, entry.column) = entry.sliding ? 1 : 0;
    }
    ++row;
  }
  for (const auto& [id, plane] : planes_) tables.planes.push_back(plane);
  return tables;
}

}  // namespace talus::exports
