#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <mpi.h>
#include <nlohmann/json_fwd.hpp>

#include "io/file_seal.h"
#include "model/model.h"
#include "output/checkpoint.h"
#include "scene/command_line.h"
#include "scene/scene.h"

namespace pounding {

/// A file that a run read, as it was when the run began.
struct InputFile {
  std::string option;  ///< that names it, or "included" of a file that Gmsh opened for another
  std::string path;
  FileDigest digest;
};

/// Whence the results of a run are, for a report that is filed.
struct Provenance {
  std::string started;                ///< local time with its offset, ISO 8601
  std::vector<std::string> machines;  ///< of the ranks, each once
  std::string processor;              ///< of rank 0
  std::string folder;                 ///< in which the program runs
  std::vector<InputFile> inputs;
  std::vector<std::pair<std::string, std::string>> overrides;  ///< see SceneOrigin
};

/// Notes of the beginning of a run: time, machines, and every file that its options name, with its
/// hash: options files and files that they include, geometries, meshes, matrices, records, targets,
/// a checkpoint. `resolved`: the options in force. Files that are not there are left to their
/// readers. Rank 0 reads; the result is on rank 0. Throws UserError on every rank alike.
/// Collective.
Provenance note_provenance(MPI_Comm comm, const SceneOrigin& origin, const OptionValues& resolved);

/// Notes of the built model: the files that Gmsh opened for the meshes, and the modal bases that
/// are kept in files, as they were taken up or written. Rank 0 reads. Throws UserError on every
/// rank alike. Collective.
void note_model(MPI_Comm comm, const Scene& scene, std::span<const Building> buildings,
                Provenance& provenance);

/// Comment lines for the end of `resolved.yaml`, there before the first step: the program, when
/// and where the run began, and of every input a line that `sha256sum --check` understands behind
/// its `# `. So a run that a signal stopped, or that was killed, has them too.
std::string provenance_comment(const Provenance& provenance);

/// Adds it to summary.json: `started`, `ended` (now), `machine`, `inputs`, `overrides`, `versions`.
void add_provenance(const Provenance& provenance, nlohmann::ordered_json& summary);

/// The options that a continued run has in common with the run before; `resolved`: those in force.
/// On rank 0 also the contents of matrices brought in. Throws UserError on every rank alike.
/// Collective.
std::map<std::string, std::string> lasting_options(MPI_Comm comm, const OptionValues& resolved);

/// Identity of a run, with which a checkpoint is compared. Collective.
RunIdentity identity_of(MPI_Comm comm, const OptionValues& resolved, const Model& model);

/// The folder of results before the work: whether it can be used, and its content.

/// Tries that the folder can be made and written, and leaves everything as it was. Throws
/// UserError. Rank 0.
void try_folder(const std::string& option, const std::string& folder);

/// One line where the folder holds results of other structures, meshes or motions than `resolved`
/// tells, which this run replaces; none where a run is continued. Rank 0.
std::vector<std::string> replaced_results(const Scene& scene, const OptionValues& resolved);

}  // namespace pounding
