#include "report/provenance.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string_view>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "common/error.h"
#include "common/hash.h"
#include "common/parallel.h"
#include "common/version.h"
#include "output/result_folder.h"
#include "scene/option_table.h"
#include "scene/option_values.h"
#include "scene/options_database.h"
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
  std::vector<std::string> names;
  for_each_rank(comm, std::string(own.data()), [&](int /*rank*/, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  });
  return names;
}

/// Whether an option names a file that every run reads: not a table of members, nor a basis,
/// which a run may write.
bool is_read_by_a_run(const std::string& name) {
  if (name == "restart" || name == "motion_incoherent") return true;
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

std::vector<InputFile> input_files(const SceneOrigin& origin, const OptionValues& resolved) {
  Inputs inputs;
  for (const std::string& file : origin.files) inputs.add("options_file", file);
  for (const auto& [name, value] : resolved) inputs.add_option(name, value);
  return std::move(inputs.files);
}

std::string hash_of(const GroundMotion& motion, const SupportMotion* supports,
                    const LoadHistories* loads) {
  Hash hash;
  const auto add = [&hash](const Accelerogram& motion_of_one) {
    hash.add(motion_of_one.time_step);
    hash.add(motion_of_one.start);
    hash.add(motion_of_one.acceleration);
  };
  for (int direction = 0; direction < 3; ++direction) {
    add(motion.component(direction));
    if (!motion.incident(direction).acceleration.empty()) add(motion.incident(direction));
  }
  for (const Accelerogram& shape : motion.incident().subspan(3)) add(shape);
  for (std::size_t c = 0; supports != nullptr && c < supports->columns().size(); ++c) {
    add(supports->own(c));
  }
  for (std::size_t l = 0; loads != nullptr && l < loads->size(); ++l) {
    hash.add(loads->function(l).times);
    hash.add(loads->function(l).values);
  }
  return hash.text();
}

/// Contents of the files of an option, as options of their own.
void add_matrices(const std::string& option, const std::string& folder,
                  std::map<std::string, std::string>& options) {
  for (const char* matrix : {"stiffness", "mass", "damping"}) {
    const std::string path = matrix_file(folder, matrix);
    if (!path.empty()) options[option + " (its " + matrix + ")"] = digest_of_file(path).sha256;
  }
}

namespace fs = std::filesystem;

[[noreturn]] void refuse_folder(const std::string& option, const std::string& folder,
                                const std::string& why) {
  throw UserError("option -" + option + " " + folder +
                  ": the folder cannot be created or written (" + why + "); give another one");
}

void try_writing(const std::string& option, const std::string& folder) {
  std::string trial = folder + "/.trial-XXXXXX";
  const int file = mkstemp(trial.data());
  const bool written = file >= 0 && write(file, "trial\n", 6) == 6;
  const std::string why = std::strerror(errno);
  if (file >= 0) {
    close(file);
    unlink(trial.c_str());
  }
  if (!written) refuse_folder(option, folder, why);
}

bool tells_the_scene(const std::string& option) {
  return option == "structures" || option == "contacts" || option.ends_with("_mesh") ||
         option.ends_with("_mesh_set") || option.ends_with("_matrices") ||
         option.starts_with("motion_");
}

std::map<std::string, std::string> scene_options(const auto& resolved) {
  std::map<std::string, std::string> options;
  for (const auto& [name, value] : resolved) {
    if (tells_the_scene(name)) options[name] = value;
  }
  return options;
}

}  // namespace

Provenance note_provenance(MPI_Comm comm, const SceneOrigin& origin, const OptionValues& resolved) {
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
      if (structure.basis() != nullptr) {
        inputs.add(structure.name + "_modal_basis", structure.basis()->basis_file);
      }
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

std::map<std::string, std::string> lasting_options(MPI_Comm comm, const OptionValues& resolved) {
  std::map<std::string, std::string> options;
  for (const auto& [name, value] : resolved) {
    if (!may_differ(name, Comparison::restart)) options[name] = value;
  }
  on_rank0(comm, [&] {
    const std::map<std::string, std::string> named = options;
    for (const auto& [name, folder] : named) {
      if (name.ends_with("_matrices") && folder != "none") add_matrices(name, folder, options);
      const bool is_read = name.ends_with("_soil_table") || name.ends_with("_survey");
      if (is_read && folder != "none") {
        options[name + " (its content)"] = digest_of_file(folder).sha256;
      }
    }
  });
  return options;
}

RunIdentity identity_of(MPI_Comm comm, const OptionValues& resolved, const Model& model) {
  RunIdentity identity{lasting_options(comm, resolved), model.time_step,
                       hash_of(*model.motion, model.supports.get(), model.load_histories.get())};
  for (const Building& building : model.buildings) {
    if (!follows_spectra(*building.structure, building.beams)) continue;
    for (const Region& region : building.structure->regions) {
      identity.beam_frequency =
          std::max(identity.beam_frequency, region.resolved_frequency / (2 * std::numbers::pi));
    }
  }
  return identity;
}

void try_folder(const std::string& option, const std::string& folder) {
  std::error_code failure;
  const std::vector<fs::path> missing = missing_folders(fs::path(folder).lexically_normal());
  fs::create_directories(folder, failure);
  if (failure) refuse_folder(option, folder, failure.message());
  if (!fs::is_directory(folder, failure)) refuse_folder(option, folder, "it is a file");
  const auto restore = [&missing] {
    std::error_code ignored;
    for (const fs::path& made : missing) fs::remove(made, ignored);
  };
  try {
    try_writing(option, folder);
  } catch (const UserError&) {
    restore();
    throw;
  }
  restore();
}

std::vector<std::string> replaced_results(const Scene& scene, const OptionValues& resolved) {
  const std::string path = scene.output + "/resolved.yaml";
  require_finite_file(path);
  std::ifstream file(path);
  if (!file || !scene.restart.empty()) return {};
  OptionsDatabase written;
  try {
    written = parse_options_file({std::istreambuf_iterator<char>(file), {}}, path);
  } catch (const UserError&) {  // nobody knows of which scene it was
  }
  const auto before = scene_options(written);
  const auto now = scene_options(resolved);
  if (before.empty() || before == now) return {};
  const auto other = std::ranges::find_if(now, [&before](const auto& option) {
    const auto found = before.find(option.first);
    return found != before.end() && found->second != option.second;
  });
  const std::string what = other == now.end()
                               ? "other structures or motions"
                               : "-" + other->first + " " + shown_value(before.at(other->first)) +
                                     ", now " + shown_value(other->second);
  return {"the folder " + scene.output + " holds results of another scene (" + what +
          "); this run replaces them"};
}

}  // namespace pounding
