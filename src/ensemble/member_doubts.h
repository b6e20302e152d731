#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include <mpi.h>

#include "common/doubts.h"
#include "ensemble/ensemble_file.h"
#include "ensemble/member_scene.h"

/// Doubts that single runs of the members would have, each once for all members concerned.
namespace pounding {

/// Lines of doubt with the members that they are about.
class MemberDoubts {
 public:
  /// `known`: lines that the scene has given already.
  void leave_out(std::span<const std::string> known);
  void add(std::size_t member, std::span<const std::string> lines);
  /// Rank 0 gets those of all ranks. Collective.
  void gather(MPI_Comm comm);
  /// One text per line, with its members.
  std::vector<std::string> told(const MemberTable& table) const;

 private:
  std::vector<std::string> known_;
  std::map<std::string, std::vector<std::size_t>> members_;  ///< of a line, increasing
};

/// The doubt about rows of a table that are the same, in one line; none where all differ.
std::vector<std::string> repeated_members(const MemberTable& table);

/// Checks the motion of a member, without making synthetic ones: its files and its peaks. Returns
/// the shortest interval between samples of its motion [s], infinite without one. Throws UserError.
double check_motion(const MemberScene& member, Doubts doubts);

/// Checks the gaps of every member as those of a single run are. Rank 0. Throws UserError with the
/// line of the table.
void check_member_gaps(std::span<const MemberScene> members,
                       const interactions::Interface& interface, MemberDoubts& doubts);

/// Doubts about the damping of a member, whose frequencies are those of the model, scaled.
std::vector<std::string> member_damping_doubts(const MemberScene& member, const Model& model);

/// Doubts about passes that are not taken: for each contact one line, about the deepest, with the
/// members that have one. `results`: of members that are done.
void add_pass_doubts(const Scene& scene, const interactions::Interface& interface,
                     const std::map<std::size_t, MemberResult>& results, MemberDoubts& doubts);

/// Doubts about the results of a member. `model_size` [m].
std::vector<std::string> result_doubts(const MemberResult& result, double model_size);

}  // namespace pounding
