#include "driver/provenance.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <string_view>

#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/finite_file.h"
#include "common/library_versions.h"
#include "common/parallel.h"
#include "common/version.h"
#include "scene/option_table.h"
#include "scene/option_values.h"
#include "scene/resolved_options.h"
#include "system/matrix_system.h"

namespace pounding {
namespace {

std::string local_time() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  std::array<char, 40> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S%z", &parts);
  return text.data();
}

/// Name of the processor by Linux; empty elsewhere.
std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return trimmed(line.substr(line.find(':') + 1));
  }
  return "";
}

/// Names of the machines of all ranks, each once; on rank 0.
std::vector<std::string> machine_names(MPI_Comm comm) {
  std::array<char, MPI_MAX_PROCESSOR_NAME> own{};
  int length = 0;
  MPI_Get_processor_name(own.data(), &length);
  const auto size = static_cast<std::size_t>(rank_of(comm) == 0 ? size_of(comm) : 0);
  std::vector<char> all(size * own.size());
  MPI_Gather(own.data(), static_cast<int>(own.size()), MPI_CHAR, all.data(),
             static_cast<int>(own.size()), MPI_CHAR, 0, comm);
  std::vector<std::string> names;
  for (std::size_t rank = 0; rank < size; ++rank) {
    const std::string name(&all[rank * own.size()]);
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  }
  return names;
}

/// Whether an option names a file that every run reads: not a table of members, nor a basis,
/// which a run may write.
bool is_read_by_a_run(const std::string& name) {
  if (name == "restart") return true;
  return !name.ends_with("_modal_basis") &&
         std::ranges::any_of(option_table(), [&](const OptionRow& row) {
           const std::size_t own = row.pattern.rfind('>');  // behind the names of the user
           return row.unit == "file" && own != std::string_view::npos &&
                  name.ends_with(row.pattern.substr(own + 1));
         });
}

/// Files on rank 0, each once for an option, in the order in which they are named.
class Inputs {
 public:
  void add(const std::string& option, const std::string& path) {
    std::error_code failure;
    if (!std::filesystem::is_regular_file(path, failure)) return;
    if (!std::ifstream(path)) return;  // its reader says so
    for (const char* of : {"_record", "_target", "_table", "_capacity"}) {
      if (option.ends_with(of)) require_finite_file(path, "option -" + option + " ", largest_text);
    }
    const auto read = std::ranges::find(files, path, &InputFile::path);
    const bool named = std::ranges::any_of(
        files, [&](const InputFile& file) { return file.path == path && file.option == option; });
    if (named) return;
    files.push_back({option, path, read == files.end() ? digest_of_file(path) : read->digest});
  }

  /// Adds the file that an option in force names, if a run reads it.
  void add_option(const std::string& name, const std::string& value) {
    const auto ends = [&](std::string_view end) { return name.ends_with(end); };
    if (value.empty() || value == "none") return;
    if (ends("_matrices")) {
      add(name, value + "/dofs.csv");
      for (const char* matrix : {"stiffness", "mass", "damping"}) {
        add(name, matrix_file(value, matrix));
      }
    } else if (is_read_by_a_run(name)) {
      add(name, value);
    }
  }

  std::vector<InputFile> files;
};

std::vector<InputFile> input_files(const SceneOrigin& origin, const std::string& resolved) {
  Inputs inputs;
  for (const std::string& file : origin.files) inputs.add("options_file", file);
  const auto values = resolved_values(resolved);
  for (const auto& [name, value] : values) inputs.add_option(name, value);
  return std::move(inputs.files);
}

}  // namespace

Provenance note_provenance(MPI_Comm comm, const SceneOrigin& origin, const std::string& resolved) {
  Provenance provenance{local_time(), machine_names(comm), "", "", {}, origin.overrides};
  on_rank0(comm, [&] {
    provenance.processor = processor_name();
    std::error_code failure;
    provenance.folder = std::filesystem::current_path(failure).string();
    provenance.inputs = input_files(origin, resolved);
  });
  return provenance;
}

void note_model(MPI_Comm comm, const Scene& scene, std::span<const Building> buildings,
                Provenance& provenance) {
  on_rank0(comm, [&] {
    Inputs inputs{std::move(provenance.inputs)};
    for (const Building& building : buildings) {
      for (const std::string& file : building.findings.files.opened) inputs.add("included", file);
    }
    for (const Structure& structure : scene.structures) {
      if (structure.modal) inputs.add(structure.name + "_modal_basis", structure.modal->basis_file);
    }
    provenance.inputs = std::move(inputs.files);
  });
}

std::string provenance_comment(const Provenance& provenance) {
  std::string text = "# Begun " + provenance.started + " by pounding " + program_version() + " (" +
                     program_commit() + ") on";
  for (const std::string& machine : provenance.machines) text += " " + machine;
  text += "; hashes (SHA-256) of the inputs:\n";
  for (const InputFile& input : provenance.inputs) {
    std::string path = input.path;
    std::ranges::replace(path, '\n', ' ');  // else its rest were an option
    text += "# " + input.digest.sha256 + "  " + path + "\n";
  }
  return text;
}

void add_provenance(const Provenance& provenance, nlohmann::ordered_json& summary) {
  summary["started"] = provenance.started;
  summary["ended"] = local_time();
  summary["machine"] = {{"names", provenance.machines},
                        {"processor", provenance.processor},
                        {"folder", provenance.folder}};
  summary["overrides"] = nlohmann::ordered_json::object();
  for (const auto& [name, value] : provenance.overrides) summary["overrides"][name] = value;
  summary["inputs"] = nlohmann::ordered_json::array();
  for (const InputFile& input : provenance.inputs) {
    summary["inputs"].push_back({{"option", input.option},
                                 {"file", input.path},
                                 {"bytes", input.digest.bytes},
                                 {"sha256", input.digest.sha256}});
  }
  for (const auto& [name, version] : library_versions()) summary["versions"][name] = version;
}

}  // namespace pounding
