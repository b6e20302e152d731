#include "scene/member_table.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "common/error.h"
#include "common/parallel.h"
#include "scene/option_values.h"
#include "scene/options_database.h"

namespace pounding {
namespace {

/// Options that members may have of their own: those that change neither meshes nor modes.
std::vector<std::string> free_options(const Scene& scene) {
  std::vector<std::string> names{"motion_level"};
  for (const OptionRow& row : option_table()) {
    const bool of_support = row.pattern.starts_with("<support>_motion_") ||
                            row.pattern.starts_with("<support>_rotation_");
    if (row.block != OptionBlock::motion && !of_support) continue;
    for (const char* axis : {"x", "y", "z"}) {
      if (!of_support) names.push_back(option_name(row.pattern, {axis}));
      for (std::size_t s = 0; of_support && s < scene.supports.size(); ++s) {
        names.push_back(option_name(row.pattern, {scene.supports[s].name, axis}));
      }
    }
  }
  for (const Support& support : scene.supports) {
    for (const char* pattern : {"<support>_delay", "<support>_factor"}) {
      names.push_back(option_name(pattern, {support.name}));
    }
  }
  for (const Structure& structure : scene.structures) {
    for (const char* pattern : {"<structure>_damping_factor", "<structure>_stiffness_factor",
                                "<structure>_modal_damping"}) {
      names.push_back(option_name(pattern, {structure.name}));
    }
  }
  for (const Contact& contact : scene.contacts) {
    for (const char* pattern :
         {"<contact>_gap", "<contact>_gap_deviation", "<contact>_gap_length", "<contact>_gap_seed",
          "<contact>_gap_patches", "<contact>_static_closing"}) {
      names.push_back(option_name(pattern, {contact.name}));
    }
  }
  return names;
}

/// Fields of a line; quotes around a field are taken off. Nothing if a quote stays open.
std::vector<std::string> fields_of(const std::string& line, char separator) {
  std::vector<std::string> fields(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back() += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == separator && !quoted) {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  if (quoted) return {};
  for (std::string& field : fields) field = trimmed(field);
  return fields;
}

std::string read_table_text(const std::string& option, const std::string& file) {
  require_finite_file(file, option + " ");
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  refuse_if(!stream.is_open() || stream.bad(),
            option + " " + file + ": no such file, or it cannot be read");
  refuse_if(text.find('\0') != std::string::npos,
            option + " " + file + ": not a text (it holds zeros), give a table");
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  return text;
}

void check_columns(const MemberTable& table, const Scene& scene) {
  const std::vector<std::string> free = free_options(scene);
  std::set<std::string> seen;
  for (const std::string& column : table.columns) {
    if (std::ranges::find(free, column) == free.end()) {
      throw UserError(
          table.file + ": column '" + column +
          "' is no option that may differ from run to run; those are motion_..., motion_level, "
          "<support>_motion_..., _rotation_..., _delay and _factor, <contact>_gap, _gap_deviation, "
          "_gap_length, _gap_seed, _gap_patches and _static_closing, <structure>_damping_factor, "
          "_stiffness_factor and _modal_damping" +
          suggestion(column, free));
    }
    refuse_if(!seen.insert(column).second,
              table.file + ": two columns are called '" + column + "'");
  }
}

MemberTable parse_table(const std::string& file, const std::string& text) {
  MemberTable table;
  table.file = file;
  std::istringstream stream(text);
  char separator = ',';
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (trimmed(line).empty() || line.starts_with('#')) continue;
    if (table.columns.empty() && line.find(';') != std::string::npos) separator = ';';
    const std::vector<std::string> fields = fields_of(line, separator);
    refuse_if(fields.empty(), file + ", line " + std::to_string(number) +
                                  ": a double quote is opened and not closed");
    if (table.columns.empty()) {
      table.columns = fields;
      continue;
    }
    refuse_if(fields.size() != table.columns.size(),
              file + ", line " + std::to_string(number) + ": " + std::to_string(fields.size()) +
                  " values, " + std::to_string(table.columns.size()) +
                  " columns; a value that holds the separator needs double quotes");
    table.lines.push_back(number);
    table.values.insert(table.values.end(), fields.begin(), fields.end());
  }
  return table;
}

}  // namespace

std::string MemberTable::place(std::size_t member) const {
  return file + ", line " + std::to_string(lines[member]) + " (member " +
         std::to_string(member + 1) + "): ";
}

MemberTable read_table(const std::string& option, const std::string& file) {
  return parse_table(file, read_table_text(option, file));
}

MemberTable read_member_table(MPI_Comm comm, const std::string& file, const Scene& scene) {
  std::string text;
  on_rank0(comm, [&] { text = read_table_text("option -ensemble", file); });
  broadcast(comm, text);
  MemberTable table = parse_table(file, text);
  refuse_if(table.members() == 0,
            "option -ensemble " + file +
                ": no runs in it; the first line names options, every other one is a run");
  check_columns(table, scene);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::map<std::string, std::string> found;  // each path is looked for once
    for (std::size_t m = 0; m < table.members(); ++m) {
      std::string& value = table.values[m * table.columns.size() + c];
      const auto [entry, is_new] = found.try_emplace(value, value);
      if (is_new) {
        OptionsDatabase options{{table.columns[c], value}};
        find_inputs(comm, file, options);
        entry->second = options.begin()->second;
      }
      value = entry->second;
    }
  }
  return table;
}

OptionsDatabase member_options(const OptionsDatabase& scene, const MemberTable& table,
                               std::size_t member) {
  OptionsDatabase options = scene;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    if (!table.value(member, c).empty()) options[table.columns[c]] = table.value(member, c);
  }
  return options;
}

}  // namespace pounding
