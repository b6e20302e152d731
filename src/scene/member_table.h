#pragma once

#include <string>
#include <vector>

#include <mpi.h>

#include "scene/option_table.h"
#include "scene/scene.h"

namespace pounding {

/// The runs of an ensemble as a table: options of the scene that differ, and their values in each
/// run.
struct MemberTable {
  std::string file;
  std::vector<std::string> columns;  ///< names of options
  std::vector<int> lines;            ///< of the file, per member
  std::vector<std::string> values;   ///< shape (members, columns); empty: as in the scene

  std::size_t members() const { return lines.size(); }
  const std::string& value(std::size_t member, std::size_t column) const {
    return values[member * columns.size() + column];
  }
  /// "members.csv, line 3 (member 2): "
  std::string place(std::size_t member) const;
};

/// A table of names in its first line and of values in others, as that of members; of every line
/// as many values as names. `option`: "option -name", for messages. Throws UserError. Serial.
MemberTable read_table(const std::string& option, const std::string& file);

/// Reads a table: the first line names options, every other one is a run. Fields are separated by
/// commas, or by semicolons if there is one in the first line, and may be in double quotes. Rank 0
/// reads; paths of input files are relative to the folder of the table if something of that name is
/// there. `scene`: the ensemble's. Throws UserError on every rank alike: a line of another length,
/// an option that no run may have of its own. Collective.
MemberTable read_member_table(MPI_Comm comm, const std::string& file, const Scene& scene);

/// The options of a scene with those of a member in their places.
OptionsDatabase member_options(const OptionsDatabase& scene, const MemberTable& table,
                               std::size_t member);

}  // namespace pounding
