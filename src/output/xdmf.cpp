#include "output/xdmf.h"

#include <cstdio>
#include <map>
#include <stdexcept>

#include "common/byte_texts.h"

namespace pounding {
namespace {

std::string numbers(const std::vector<std::size_t>& values) {
  std::string text;
  for (const std::size_t value : values) {
    text += (text.empty() ? "" : " ") + std::to_string(value);
  }
  return text;
}

std::string escaped(const std::string& text) {
  static const std::map<char, std::string> names{
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string safe;
  for (const char letter : one_line(readable(text))) {
    const auto name = names.find(letter);
    safe += name == names.end() ? std::string(1, letter) : name->second;
  }
  return safe;
}

std::string data_item(const std::string& file, const XdmfArray& array) {
  const std::string kind =
      array.whole ? "NumberType=\"Int\" Precision=\"4\"" : "NumberType=\"Float\" Precision=\"8\"";
  return "<DataItem Format=\"HDF\" " + kind + " Dimensions=\"" + numbers(array.shape) + "\">" +
         file + ":/" + escaped(array.path) + "</DataItem>";
}

std::string attribute(const std::string& file, const XdmfArray& array, const char* centre) {
  const std::vector<std::size_t>& shape = array.shape;
  const char* const type = shape.size() == 1 ? "Scalar" : "Vector";
  if (shape.size() > 1 && shape[1] != 3) {
    throw std::logic_error("XDMF: " + array.name + " is neither a number nor a vector");
  }
  return "      <Attribute Name=\"" + escaped(array.name) + "\" AttributeType=\"" + type +
         "\" Center=\"" + centre + "\">" + data_item(file, array) + "</Attribute>\n";
}

}  // namespace

std::string xdmf_grid(const std::string& file, const XdmfGrid& grid) {
  std::string text = "    <Grid Name=\"" + escaped(grid.name) + "\" GridType=\"Uniform\">\n";
  for (const auto& [name, value] : grid.notes) {
    text +=
        "      <Information Name=\"" + escaped(name) + "\" Value=\"" + escaped(value) + "\"/>\n";
  }
  text += "      <Topology TopologyType=\"Mixed\" NumberOfElements=\"" +
          std::to_string(grid.cells) + "\">" + data_item(file, grid.topology) + "</Topology>\n";
  text +=
      "      <Geometry GeometryType=\"XYZ\">" + data_item(file, grid.geometry) + "</Geometry>\n";
  for (const XdmfArray& array : grid.node_values) text += attribute(file, array, "Node");
  for (const XdmfArray& array : grid.cell_values) text += attribute(file, array, "Cell");
  return text + "    </Grid>\n";
}

std::string xdmf_side_by_side(const std::string& name, std::optional<double> time,
                              const std::string& grids) {
  std::string text = "  <Grid Name=\"" + escaped(name) +
                     "\" GridType=\"Collection\" CollectionType=\"Spatial\">\n";
  if (time) {
    char value[40];
    std::snprintf(value, sizeof value, "%.17g", *time);
    text += "    <Time Value=\"" + std::string(value) + "\"/>\n";
  }
  return text + grids + "  </Grid>\n";
}

std::string xdmf_in_time(const std::string& name, const std::string& grids) {
  return "<Grid Name=\"" + escaped(name) +
         "\" GridType=\"Collection\" CollectionType=\"Temporal\">\n" + grids + "</Grid>\n";
}

std::string xdmf_document(const std::string& grids) {
  return "<?xml version=\"1.0\" ?>\n<Xdmf Version=\"3.0\">\n<Domain>\n" + grids +
         "</Domain>\n</Xdmf>\n";
}

}  // namespace pounding
