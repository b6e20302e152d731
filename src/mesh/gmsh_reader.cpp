#include "mesh/gmsh_reader.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <set>

#include "common/error.h"
#include "mesh/element_checks.h"
#include "mesh/geometry_file.h"
#include "mesh/gmsh_process.h"
#include "mesh/mesh_builder.h"
#include "mesh/split_mesh.h"

namespace pounding {
namespace {

std::string mesh_option(const Structure& structure) {
  return "-" + structure.name + "_mesh " + structure.mesh;
}

/// Gmsh takes any parameter in silence: refuse one that the geometry never mentions.
void check_parameters(const Structure& structure, const RawMesh& raw) {
  const std::set<std::string> words = geometry_words(raw.files);
  for (const auto& [name, value] : structure.mesh_set) {
    if (words.contains(name)) continue;
    throw UserError("option -" + structure.name + "_mesh_set: " + structure.mesh +
                    " has no parameter '" + name + "' (value " + value +
                    "); remove it or correct its name");
  }
}

/// Gmsh on its way to the mesh of a structure.
std::unique_ptr<GmshRun> begin_raw_mesh(const Structure& structure, double time_limit) {
  MeshRequest request;
  request.option = mesh_option(structure);
  request.time_limit = time_limit;
  request.file = std::filesystem::absolute(structure.mesh).string();
  request.make = is_geometry(structure.mesh);
  request.parameters = structure.mesh_set;
  check_mesh_file(request.option, structure.mesh);
  refuse_if(!request.make && !structure.mesh_set.empty(),
            "option -" + structure.name + "_mesh_set: " + structure.mesh +
                " is a mesh, parameters apply to .geo files only");
  return std::make_unique<GmshRun>(std::move(request));
}

RawAnswer finish_raw_mesh(const Structure& structure, GmshRun& run) {
  RawAnswer answer = run.answer();
  check_opened_files(mesh_option(structure), answer.mesh.files);
  check_parameters(structure, answer.mesh);
  return answer;
}

/// The files but the mesh itself, by paths from the working folder where they lie in it.
std::vector<std::string> files_beside(const std::string& mesh,
                                      std::span<const std::string> opened) {
  const std::string own = std::filesystem::absolute(mesh).string();
  const std::string folder = std::filesystem::current_path().string() + "/";
  std::vector<std::string> files;
  for (const std::string& file : opened) {
    if (file == own) continue;
    files.push_back(file.starts_with(folder) ? file.substr(folder.size()) : file);
  }
  return files;
}

/// Doubts about the options and files of the mesh, one line each.
std::vector<std::string> doubts_of(const Structure& structure, const RawAnswer& answer) {
  std::vector<std::string> doubts;
  for (const ChangedParameter& parameter : answer.mesh.changed) {
    const auto given = std::ranges::find(structure.mesh_set, parameter.name,
                                         &std::pair<std::string, std::string>::first);
    doubts.push_back("option -" + structure.name + "_mesh_set: " + given->first + " was given as " +
                     given->second + ", and the geometry gives it another value" +
                     (parameter.value.empty() ? "" : ", " + parameter.value) +
                     "; let it set its own only where none is given (DefineConstant)");
  }
  return doubts;
}

}  // namespace

/// A mesh being read; the error of its beginning, if there is one, belongs to its end.
class MeshReader::Reading {
 public:
  Reading(const Structure& structure, double time_limit, int splits, KeptInputs* kept)
      : structure_(structure), kept_(kept), splits_(structure.matrices.empty() ? splits : 0) {
    try {
      if (!is_kept()) run_ = begin_raw_mesh(structure, time_limit);
    } catch (...) {
      failure_ = std::current_exception();
    }
  }

  MeshRead finish() {
    if (failure_) std::rethrow_exception(failure_);
    RawAnswer answer =
        run_ ? finish_raw_mesh(structure_, *run_) : kept_->meshes.at(structure_.name);
    if (kept_ != nullptr && run_) kept_->meshes[structure_.name] = answer;
    merge_shared_elements(answer.mesh);
    const std::vector<std::string> doubts = doubts_of(structure_, answer);
    for (int i = 0; i < splits_; ++i) split_mesh(structure_, answer.mesh);
    const std::vector<DividedLines> divided = divide_beams(structure_, answer.mesh, splits_);
    MeshFiles files{files_beside(structure_.mesh, answer.mesh.files), answer.landlock};
    MeshRead read{build_mesh(structure_, std::move(answer.mesh)), std::move(files), divided};
    read.mesh.doubts.insert(read.mesh.doubts.begin(), doubts.begin(), doubts.end());
    return read;
  }

 private:
  bool is_kept() const { return kept_ != nullptr && kept_->meshes.contains(structure_.name); }

  const Structure& structure_;
  KeptInputs* kept_;
  int splits_;
  std::unique_ptr<GmshRun> run_;
  std::exception_ptr failure_;
};

MeshReader::MeshReader(std::vector<const Structure*> structures, double time_limit, int splits,
                       std::shared_ptr<KeptInputs> kept)
    : structures_(std::move(structures)),
      time_limit_(time_limit),
      splits_(splits),
      kept_(std::move(kept)) {}

MeshReader::~MeshReader() = default;

std::unique_ptr<MeshReader::Reading> MeshReader::begin(std::size_t s) const {
  if (s >= structures_.size()) return nullptr;
  return std::make_unique<Reading>(*structures_[s], time_limit_, splits_, kept_.get());
}

MeshRead MeshReader::next() {
  const std::unique_ptr<Reading> reading = ahead_ ? std::move(ahead_) : begin(taken_);
  ahead_ = begin(++taken_);
  return reading->finish();
}

}  // namespace pounding
