/// The quantities that scripts have stored with a packed run, in the group /own.

#include <algorithm>
#include <array>

#include "io/run_records.h"

namespace talus::io {
namespace {

/// Names of OwnQuantity::Kind, in its order.
constexpr std::array<std::string_view, 3> kind_names = {"number", "flag", "cluster"};

Range range_of(OwnQuantity::Kind kind) {
  constexpr double largest_label = 2147483647.0;
  if (kind == OwnQuantity::Kind::number) return hdf5::any_number;
  return kind == OwnQuantity::Kind::flag ? Range{0.0, 1.0} : Range{-largest_label, largest_label};
}

/// Whether it has up to 40 lower-case letters, digits, _ and -, the first a letter.
bool is_own_name(std::string_view name) {
  constexpr std::string_view signs = "abcdefghijklmnopqrstuvwxyz0123456789_-";
  return !name.empty() && name.size() <= 40 && signs.find(name[0]) < 26 &&
         name.find_first_not_of(signs) == std::string_view::npos;
}

/// Refuses texts that could not be the head of a column in all exports.
void check_texts(const RecordCheck& record, const OwnQuantity& own) {
  if (!is_own_name(own.name)) record.refuse(path_of(own), "has a name that a quantity cannot have");
  if (own.unit.find_first_of(",;\"'<>&\r\n\t") != std::string::npos)
    record.refuse(path_of(own), "has a unit with one of the signs , ; \" ' < > & or the end of a line");
}

}  // namespace

std::string path_of(const OwnQuantity& own) {
  return (own.of_grains ? "/own/grains/" : "/own/contacts/") + own.name;
}

std::vector<std::string> own_data_sets(const Reader& reader) {
  std::vector<std::string> paths;
  for (const std::string group : {"/own/grains", "/own/contacts"})
    if (reader.has(group))
      for (const std::string& name : reader.names(group)) paths.push_back(group + "/" + name);
  return paths;
}

OwnQuantity read_own_head(Reader& reader, const std::string& path) {
  const std::string name = path.substr(path.rfind('/') + 1), kind = reader.attribute(path, "kind");
  const auto* const known = std::ranges::find(kind_names, kind);
  if (known == kind_names.end()) reader.refuse(path, "has a kind that Talus does not write");
  reader.row_count(path);  // compares its shape
  OwnQuantity own{{},
                  static_cast<OwnQuantity::Kind>(known - kind_names.begin()),
                  reader.attribute(path, "label"),
                  reader.attribute(path, "unit"),
                  name,
                  path.starts_with("/own/grains/")};
  check_texts(reader, own);
  return own;
}

std::vector<double> read_own_values(Reader& reader, const OwnQuantity& own, std::optional<hdf5::Rows> rows) {
  return reader.read<double>(path_of(own), range_of(own.kind), rows);
}

void write_own(Writer& writer, const OwnQuantity& own) {
  DataSetField field = field_of(path_of(own));
  field.unit = own.unit;
  check_texts({}, own);
  RecordCheck().check(field.path, own.values, range_of(own.kind));
  writer.write(field, own.values);
  writer.set_attribute(field.path, "label", own.label);
  writer.set_attribute(field.path, "kind", std::string(kind_names.at(static_cast<std::size_t>(own.kind))));
}

}  // namespace talus::io
