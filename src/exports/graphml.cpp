#include <algorithm>
#include <fmt/core.h>
#include <set>
#include <string_view>
#include <vector>

#include "base/text.h"
#include "base/version.h"
#include "exports/fields.h"
#include "exports/writers.h"

namespace talus::exports {
namespace {

struct Key {
  std::string_view owner;  ///< graph, node or edge
  std::string name;
  std::string_view type;
  std::string_view unit, definition;
};

/// Returns the XML of a key. Its id consists of owner and name: "node.radius".
std::string key_text(const Key& key) {
  const std::string unit = key.unit == "1" || key.unit.empty() ? "" : fmt::format(", {}", key.unit);
  return fmt::format(
      "<key id=\"{0}.{1}\" for=\"{0}\" attr.name=\"{1}\" attr.type=\"{2}\"><desc>{3}{4}</desc></key>\n",
      key.owner, key.name, key.type, xml_text(key.definition), unit);
}

std::string keys_text(std::string_view owner, const std::vector<FieldColumn>& columns) {
  std::string text;
  for (const FieldColumn& column : columns)
    for (const std::string& name : component_names(column))
      text += key_text({owner, name, column.field.number == analysis::FieldNumber::integer ? "int" : "double",
                        column.field.unit, column.field.definition});
  return text;
}

void append_datum(std::string& text, std::string_view key, double value, analysis::FieldNumber number) {
  text += fmt::format("<data key=\"{}\">", key);
  analysis::append_number(text, value, number, "NaN");
  text += "</data>";
}

/// A column, and the keys of its components.
struct KeyedColumn {
  const FieldColumn& column;
  std::vector<std::string> keys;
};

std::vector<KeyedColumn> keyed(std::string_view owner, const std::vector<FieldColumn>& columns) {
  std::vector<KeyedColumn> found;
  for (const FieldColumn& column : columns) {
    std::vector<std::string> keys = component_names(column);
    for (std::string& key : keys) key = fmt::format("{}.{}", owner, key);
    found.push_back({column, std::move(keys)});
  }
  return found;
}

void append_row(std::string& text, const std::vector<KeyedColumn>& columns, std::size_t row) {
  for (const KeyedColumn& entry : columns)
    for (std::size_t c = 0; c < entry.keys.size(); ++c)
      append_datum(text, entry.keys[c], entry.column.values[row * entry.keys.size() + c],
                   entry.column.field.number);
}

void append_grains(std::string& text, const analysis::GrainSource& source,
                   const std::vector<FieldColumn>& columns) {
  const std::vector<KeyedColumn> keys = keyed("node", columns);
  for (std::size_t i = 0; i < source.frame.x.size(); ++i) {
    text += fmt::format("<node id=\"{}\"><data key=\"node.kind\">{}</data>", i,
                        i < static_cast<std::size_t>(source.statics.free_count) ? "free" : "floor");
    append_datum(text, "node.x", source.frame.x[i], analysis::FieldNumber::single);
    append_datum(text, "node.y", source.frame.y[i], analysis::FieldNumber::single);
    append_row(text, keys, i);
    text += "</node>\n";
  }
}

void append_planes(std::string& text, const analysis::GrainSource& source) {
  std::set<Index> planes;
  for (const Index b : source.frame.contacts.b)
    if (b >= source.frame.grain_count()) planes.insert(b);
  for (const Index plane : planes)
    text += fmt::format("<node id=\"{}\"><data key=\"node.kind\">plane</data></node>\n", plane);
}

void append_contacts(std::string& text, const analysis::GrainSource& source,
                     const std::vector<FieldColumn>& columns) {
  const std::vector<KeyedColumn> keys = keyed("edge", columns);
  for (std::size_t c = 0; c < source.frame.contacts.a.size(); ++c) {
    text += fmt::format("<edge id=\"{}\" source=\"{}\" target=\"{}\">", c, source.frame.contacts.a[c],
                        source.frame.contacts.b[c]);
    append_row(text, keys, c);
    text += "</edge>\n";
  }
}

}  // namespace

std::string graphml_text(const analysis::GrainSource& source) {
  const std::vector<FieldColumn> grains = grain_columns(source), contacts = contact_columns(source);
  const auto graph_datum = [](std::string_view name, const auto& value) {
    return fmt::format("<data key=\"graph.{}\">{}</data>\n", name, value);
  };
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!-- talus {}: SI units; masses, forces and moments are per metre of thickness. -->\n"
      "<graphml xmlns=\"http://graphml.graphdrawing.org/xmlns\">\n",
      version);
  for (const Key& key : {Key{"graph", "frame", "int", "1", "number of the frame in the run, from 0"},
                         Key{"graph", "step", "long", "1", "steps taken since the beginning of the run"},
                         Key{"graph", "time", "double", "s", "simulated time"},
                         Key{"graph", "tilt", "double", "rad", "angle of the bed to the horizontal"},
                         Key{"graph", "period", "double", "m", "L of a periodic bed; 0 between walls"},
                         Key{"node", "kind", "string", "1", "free, floor (glued to it) or plane"},
                         Key{"node", "x", "double", "m", "centre, along the bed"},
                         Key{"node", "y", "double", "m", "centre, away from the floor"}})
    text += key_text(key);
  text.append(keys_text("node", grains)).append(keys_text("edge", contacts));
  text.append("<graph edgedefault=\"undirected\">\n")
      .append(graph_datum("frame", source.number))
      .append(graph_datum("step", source.frame.step))
      .append(graph_datum("time", source.frame.time))
      .append(graph_datum("tilt", source.frame.tilt))
      .append(graph_datum("period", source.statics.periodic ? source.statics.length : 0.0));
  append_grains(text, source, grains);
  append_planes(text, source);
  append_contacts(text, source, contacts);
  return text + "</graph>\n</graphml>\n";
}

}  // namespace talus::exports
