#include "scene/options_database.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <set>
#include <yaml.h>

#include "common/byte_texts.h"
#include "common/error.h"
#include "common/parallel.h"
#include "scene/option_values.h"

namespace pounding {
namespace {

constexpr std::uintmax_t largest_file = 10'000'000;  // bytes

std::string read_text(const std::string& option, const std::string& file) {
  const std::string what = "option -" + option + " " + file + ": ";
  std::error_code failure;
  refuse_if(!std::filesystem::is_regular_file(file, failure),
            what +
                "no such file (paths are relative to the folder in which the program runs, in a "
                "file of options first to the folder of that file)");
  refuse_if(std::filesystem::file_size(file, failure) > largest_file,
            what + "above 10 MB, that is no options file");
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream), {});
  if (!stream || stream.bad()) throw UserError(what + "it cannot be read; look at its permissions");
  return text;
}

/// A path in a file of that folder: relative to the folder if there is something there, else as it
/// is, relative to where the program runs.
std::string found_path(const std::filesystem::path& folder, const std::string& path) {
  const std::filesystem::path beside = folder / path;  // an absolute path stays
  std::error_code failure;
  const bool there = !path.empty() && std::filesystem::exists(beside, failure);
  return there ? beside.lexically_normal().string() : path;
}

/// Whether the value of an option is the path of something that the program reads.
bool names_input(std::string_view option) {
  return std::ranges::any_of(option_table(), [option](const OptionRow& row) {
    if (row.unit != "file" && !row.form.starts_with("a folder with")) return false;
    const std::size_t last = row.pattern.rfind('>');
    return last == std::string_view::npos ? option == row.pattern
                                          : option.ends_with(row.pattern.substr(last + 1));
  });
}

/// A file of options to be read.
struct Waiting {
  std::string option;  ///< that names it
  std::string file;
  std::filesystem::path folder;  ///< of the file that includes it
};

constexpr int deepest = 16;                   // mappings inside each other
constexpr std::size_t most_options = 100000;  // anchors of anchors grow without bound
constexpr std::size_t most_visits = 1000000;  // of lines, again through each anchor
constexpr int deepest_brackets = 64;

struct Entry {
  std::string value;
  std::size_t line = 0;
};
using Entries = std::map<std::string, Entry>;

[[noreturn]] void refuse(const std::string& file, std::size_t line, std::size_t column,
                         const std::string& why) {
  throw UserError(file + ", line " + std::to_string(line) + ", column " + std::to_string(column) +
                  ": " + why);
}

/// Marks count from 0.
[[noreturn]] void refuse(const std::string& file, const yaml_mark_t& mark, const std::string& why) {
  refuse(file, mark.line + 1, mark.column + 1, why);
}

void refuse_mark_if(bool wrong, const std::string& file, const yaml_mark_t& mark,
                    const std::string& why) {
  if (wrong) refuse(file, mark, why);
}

/// Whether a tab precedes the first word of a line (counted from 0).
bool indented_by_tab(std::string_view text, std::size_t line) {
  for (; line > 0; --line) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find_first_not_of(" \t")).find('\t') != std::string_view::npos;
}

/// Complaint of the parser of YAML, and its place.
[[noreturn]] void refuse_text(const std::string& text, const std::string& file,
                              const yaml_parser_t& parser) {
  std::string why = "not YAML: " + std::string(parser.problem != nullptr ? parser.problem : "?");
  if (parser.error == YAML_READER_ERROR) {
    const std::size_t offset = std::min(parser.problem_offset, text.size());
    const std::string_view before = std::string_view(text).substr(0, offset);
    const auto line = static_cast<std::size_t>(std::ranges::count(before, '\n')) + 1;
    const std::size_t last_end = before.rfind('\n');
    refuse(file, line, offset - (last_end == std::string_view::npos ? 0 : last_end + 1) + 1,
           why + "; is it an options file?");
  }
  if (indented_by_tab(text, parser.problem_mark.line)) {
    why = "not YAML: a tab at the beginning of the line; indent with blanks";
  } else if (parser.context != nullptr) {
    why += " (" + std::string(parser.context) + ", line " +
           std::to_string(parser.context_mark.line + 1) + ")";
  }
  refuse(file, parser.problem_mark, why);
}

/// Parser and document of a text, freed with the object.
class Yaml {
 public:
  Yaml(const std::string& text, const std::string& file) : text_(text), file_(file) {
    if (yaml_parser_initialize(&parser_) == 0) throw std::bad_alloc();
    yaml_parser_set_input_string(&parser_, reinterpret_cast<const unsigned char*>(text.data()),
                                 text.size());
  }
  Yaml(const Yaml&) = delete;
  Yaml& operator=(const Yaml&) = delete;
  ~Yaml() {
    forget();
    yaml_parser_delete(&parser_);
  }

  /// The root of the next document; null behind the last one.
  yaml_node_t* next() {
    forget();
    if (yaml_parser_load(&parser_, &document_) == 0) refuse_text(text_, file_, parser_);
    loaded_ = true;
    return yaml_document_get_root_node(&document_);
  }

  yaml_node_t* node(int number) { return yaml_document_get_node(&document_, number); }

 private:
  void forget() {
    if (loaded_) {
      yaml_document_delete(&document_);
      loaded_ = false;
    }
  }

  const std::string& text_;
  const std::string& file_;
  yaml_parser_t parser_{};
  yaml_document_t document_{};
  bool loaded_ = false;
};

/// Bytes of a scalar; YAML has letters alone.
std::string text_of(const yaml_node_t& scalar) {
  return with_plain_bytes(
      {reinterpret_cast<const char*>(scalar.data.scalar.value), scalar.data.scalar.length});
}

/// Flattens the mappings of a document.
class OptionsReader {
 public:
  OptionsReader(Yaml& yaml, const std::string& file) : yaml_(yaml), file_(file) {}

  /// Adds the options of a mapping, its own before those that it merges.
  void read(const yaml_node_t& mapping, const std::string& prefix, int depth, Entries& entries) {
    refuse_mark_if(depth > deepest, file_, mapping.start_mark,
                   "names are nested too deep (an anchor inside itself?)");
    std::map<std::string, std::size_t> lines;
    Entries merged;
    const auto& pairs = mapping.data.mapping.pairs;
    for (const yaml_node_pair_t* pair = pairs.start; pair < pairs.top; ++pair) {
      refuse_mark_if(++visits_ > most_visits, file_, mapping.start_mark,
                     "anchors hold anchors too many times over");
      const yaml_node_t& key = *yaml_.node(pair->key);
      const yaml_node_t& value = *yaml_.node(pair->value);
      refuse_mark_if(key.type != YAML_SCALAR_NODE || text_of(key).empty(), file_, key.start_mark,
                     "expected a name before the colon");
      const std::string name = text_of(key);
      const auto [first, fresh] = lines.try_emplace(name, key.start_mark.line + 1);
      if (!fresh) refuse_twice(key, prefix + name, first->second);
      if (name == "<<") {
        merge(value, prefix, depth, merged);
      } else if (!name.starts_with("$$")) {
        read_value(key, value, prefix + name, depth, entries);
      }
    }
    entries.merge(merged);
  }

 private:
  [[noreturn]] void refuse_twice(const yaml_node_t& key, const std::string& option,
                                 std::size_t line) const {
    refuse(file_, key.start_mark,
           shown_value(option) + " is in line " + std::to_string(line) +
               " already; leave one of them out");
  }

  void read_value(const yaml_node_t& key, const yaml_node_t& value, const std::string& option,
                  int depth, Entries& entries) {
    if (value.type == YAML_MAPPING_NODE) {
      read(value, option + "_", depth + 1, entries);
      return;
    }
    const std::string text = value.type == YAML_SCALAR_NODE ? text_of(value) : joined(value);
    refuse_mark_if(text.find('\0') != std::string::npos, file_, value.start_mark,
                   shown_value(option) + " holds a zero character");
    const auto [entry, fresh] = entries.try_emplace(option, Entry{text, key.start_mark.line + 1});
    if (!fresh) refuse_twice(key, option, entry->second.line);
    refuse_mark_if(entries.size() > most_options, file_, key.start_mark,
                   "more than " + std::to_string(most_options) + " options");
  }

  std::string joined(const yaml_node_t& sequence) {
    std::string text;
    const auto& items = sequence.data.sequence.items;
    for (const yaml_node_item_t* item = items.start; item < items.top; ++item) {
      const yaml_node_t& value = *yaml_.node(*item);
      refuse_mark_if(value.type != YAML_SCALAR_NODE, file_, value.start_mark,
                     "an item of a list is one plain value");
      const std::string word = text_of(value);
      text += (text.empty() || word.empty() ? "" : ",") + word;
    }
    return text;
  }

  void merge(const yaml_node_t& value, const std::string& prefix, int depth, Entries& merged) {
    if (value.type == YAML_MAPPING_NODE) {
      Entries entries;
      read(value, prefix, depth + 1, entries);
      merged.merge(entries);
      return;
    }
    refuse_mark_if(value.type != YAML_SEQUENCE_NODE, file_, value.start_mark,
                   "<< takes an anchor: <<: *name");
    const auto& items = value.data.sequence.items;
    for (const yaml_node_item_t* item = items.start; item < items.top; ++item) {
      const yaml_node_t& each = *yaml_.node(*item);
      refuse_mark_if(each.type != YAML_MAPPING_NODE, file_, each.start_mark,
                     "<< takes anchors of mappings");
      merge(each, prefix, depth, merged);
    }
  }

  Yaml& yaml_;
  const std::string& file_;
  std::size_t visits_ = 0;
};

/// Refuses brackets inside each other of which the parser would look at each from each other.
void require_shallow(const std::string& text, const std::string& file) {
  yaml_parser_t parser{};
  if (yaml_parser_initialize(&parser) == 0) throw std::bad_alloc();
  const std::unique_ptr<yaml_parser_t, decltype(&yaml_parser_delete)> freed(&parser,
                                                                            &yaml_parser_delete);
  yaml_parser_set_input_string(&parser, reinterpret_cast<const unsigned char*>(text.data()),
                               text.size());
  yaml_event_t event{};
  for (int depth = 0; yaml_parser_parse(&parser, &event) != 0;) {
    const yaml_event_type_t type = event.type;
    const yaml_mark_t place = event.start_mark;
    yaml_event_delete(&event);
    if (type == YAML_STREAM_END_EVENT) return;
    if (type == YAML_MAPPING_START_EVENT || type == YAML_SEQUENCE_START_EVENT) ++depth;
    if (type == YAML_MAPPING_END_EVENT || type == YAML_SEQUENCE_END_EVENT) --depth;
    if (depth > deepest_brackets) refuse(file, place, "brackets are nested too deep");
  }
}

}  // namespace

void find_inputs(MPI_Comm comm, const std::string& file, OptionsDatabase& options) {
  const std::filesystem::path folder = std::filesystem::path(file).parent_path();
  for (auto& [name, value] : options) {
    const std::string path = trimmed(value);
    if (folder.empty() || !names_input(name) || path.empty() || path == "none") continue;
    std::string found;
    on_rank0(comm, [&] { found = found_path(folder, path); });
    broadcast(comm, found);
    value = found;
  }
}

OptionsDatabase read_options_database(MPI_Comm comm, const CommandLine& line,
                                      std::vector<std::string>* files) {
  OptionsDatabase database = line.options;
  std::deque<Waiting> waiting;
  for (const std::string& file : line.files) waiting.push_front({"options_file", file, {}});
  std::set<std::string> seen;
  const auto take_include = [&](OptionsDatabase& from, const std::filesystem::path& folder) {
    const auto found = from.find("include");
    if (found != from.end()) {
      waiting.push_back({"include", found->second, folder});
      from.erase(found);
    }
  };
  take_include(database, {});
  while (!waiting.empty()) {
    const Waiting next = waiting.front();
    waiting.pop_front();
    std::string file;
    std::string text;
    on_rank0(comm, [&] {
      file = found_path(next.folder, next.file);
      text = read_text(next.option, file);
    });
    broadcast(comm, file);
    refuse_if(!seen.insert(file).second,
              "option -" + next.option + " " + file + ": this file is read already");
    broadcast(comm, text);
    if (files != nullptr) files->push_back(file);
    OptionsDatabase read = parse_options_file(text, file);
    find_inputs(comm, file, read);
    take_include(read, std::filesystem::path(file).parent_path());
    database.merge(read);
  }
  return database;
}

OptionsDatabase petsc_options(const OptionsDatabase& database) {
  OptionsDatabase options;
  for (const auto& [name, value] : database) {
    if (is_petsc_option(name)) options[name] = value;
  }
  return options;
}

OptionsDatabase parse_options_file(const std::string& bytes, const std::string& file) {
  const bool is_utf16 = bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff");
  const std::string text = is_utf16 ? bytes : with_marked_bytes(bytes);
  require_shallow(text, file);
  Yaml yaml(text, file);
  const yaml_node_t* root = yaml.next();
  refuse_if(root == nullptr || (root->type == YAML_SCALAR_NODE && text_of(*root).empty()),
            file + ": holds no options; expected YAML, lines like end_time: 25");
  refuse_mark_if(root->type != YAML_MAPPING_NODE, file, root->start_mark,
                 "not YAML with options; expected lines like end_time: 25 or s1: {mesh: left.geo}");
  Entries entries;
  OptionsReader(yaml, file).read(*root, "", 1, entries);
  if (const yaml_node_t* second = yaml.next()) {
    refuse(file, second->start_mark,
           "a second document (after ---); one file holds one, leave the line --- out");
  }
  OptionsDatabase database;
  for (const auto& [name, entry] : entries) database[name] = entry.value;
  return database;
}

}  // namespace pounding
